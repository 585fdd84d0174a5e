#include "weft/garment/panel_sides.h"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/garment/check_pattern.h"

namespace weft {
namespace {

constexpr int unknown = -1;

/// Gives a side to all panels that stitches join to those that have one.
void spread_sides(const std::vector<Stitch>& stitches, std::vector<int>& side) {
  for (bool grown = true; grown;) {
    grown = false;
    for (const Stitch& s : stitches)
      for (const auto& [from, to] : {std::pair(s.a, s.b), std::pair(s.b, s.a)})
        if (side[from.panel] != unknown && side[to.panel] == unknown) {
          side[to.panel] = s.turned ? 1 - side[from.panel] : side[from.panel];
          grown = true;
        }
  }
}

[[noreturn]] void refuse(const Pattern& pattern, const Stitch& stitch, const std::string& name) {
  throw InputError(place_of(pattern, stitch.a, name),
                   fmt::format("a stitch with panel '{}', edge {} that leaves one side only",
                               pattern.panels[stitch.b.panel].name, stitch.b.edge),
                   "a garment with an inside and an outside is wanted");
}

}  // namespace

std::vector<bool> panels_turned(const Pattern& pattern, const std::string& name) {
  std::vector<int> side(pattern.panels.size(), unknown);
  for (std::size_t seed = 0; seed < side.size(); ++seed) {
    if (side[seed] != unknown) continue;
    side[seed] = 0;
    spread_sides(pattern.stitches, side);
  }
  for (const Stitch& s : pattern.stitches)
    if ((side[s.a.panel] != side[s.b.panel]) != s.turned) refuse(pattern, s, name);
  return {side.begin(), side.end()};
}

}  // namespace weft
