#include "weft/sim/stepping/scene_crossings.h"

#include <algorithm>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/sim/stepping/cloth_gaps.h"

namespace weft {
namespace {

/// Part of a cloth that may begin exactly on another one: a few rows find their way apart.
constexpr double max_part_in_one_place = 0.05;

}  // namespace

IntersectionCheck& SceneCrossings::check() {
  if (check_) return *check_;
  for (const SimulatedCloth& cloth : loaded_.cloths)
    triangles_.push_back(joined_triangles(cloth.image));
  for (const PlacedBody& body : loaded_.bodies) triangles_.push_back(joined_triangles(body.image));
  std::vector<GridTriangles> cloths, bodies;
  auto triangles = triangles_.cbegin();
  for (const SimulatedCloth& cloth : loaded_.cloths)
    cloths.push_back(
        {&cloth.state.position, &*triangles++, cloth.garment ? &cloth.garment->sewn : nullptr});
  for (const PlacedBody& body : loaded_.bodies)
    bodies.push_back({&body.positions, &*triangles++, nullptr, &body.buried});
  return check_.emplace(cloths, bodies, scene_.ground);
}

void SceneCrossings::refuse_cloths_in_one_place(const std::string& name) {
  const std::vector<SimulatedCloth>& cloths = loaded_.cloths;
  for (std::size_t j = 1; j < cloths.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const double part = std::max(check().part_lying_on(i, j), check().part_lying_on(j, i));
      if (part <= max_part_in_one_place) continue;
      const double gap = self_gap_of(*cloths[i].model) + self_gap_of(*cloths[j].model);
      throw SceneError(
          name,
          fmt::format("cloths '{}' and '{}' begin in the same place: {:.0f} % of one lies exactly "
                      "on the other, and which is above nobody can tell",
                      cloths[i].name, cloths[j].name, 100 * part),
          fmt::format("cloths that begin {:.2g} m apart, or more, are wanted", gap / 2));
    }
}

}  // namespace weft
