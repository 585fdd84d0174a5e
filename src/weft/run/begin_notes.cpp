#include "weft/run/begin_notes.h"

#include <fmt/format.h>

#include "weft/methods.h"
#include "weft/run.h"
#include "weft/sim/loading/insides.h"
#include "weft/simulation.h"

namespace weft {

std::int64_t tangled_pairs(const IntersectionCounts& counts) { return counts.self + counts.cloths; }

std::string tangle_text(const IntersectionCounts& counts) {
  return fmt::format("{} pairs of triangles of cloth cross, {} of one cloth and {} of two",
                     tangled_pairs(counts), counts.self, counts.cloths);
}

std::vector<std::string> begin_notes(const Simulation& simulation, const Scene& scene,
                                     const IntersectionCounts& counts) {
  std::vector<std::string> notes;
  for (const StartInside& found : simulation.start_insides())
    notes.push_back(start_inside_text(found));
  if (counts.bodies > 0)
    notes.push_back(fmt::format(
        "at the start {} pairs of triangles of cloths and bodies cross; "
        "closed bodies push out cloth that lies in them, not cloth that they pass through",
        counts.bodies));
  if (counts.ground > 0)
    notes.push_back(
        fmt::format("at the start {} triangles of cloths are below the ground, which pushes them "
                    "out",
                    counts.ground));
  if (tangled_pairs(counts) > 0)
    notes.push_back(fmt::format("at the start {}; {}", tangle_text(counts),
                                Colliders::traits_of(scene.collider).self_collision
                                    ? "the run takes them apart"
                                    : "this collider leaves them so"));
  return notes;
}

}  // namespace weft
