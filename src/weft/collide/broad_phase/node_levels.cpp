#include "weft/collide/broad_phase/node_levels.h"

namespace weft {

std::vector<int> level_sides(int cells) {
  std::vector<int> sides{cells};
  while (sides.back() > 1) sides.push_back((sides.back() + 1) / 2);
  return sides;
}

}  // namespace weft
