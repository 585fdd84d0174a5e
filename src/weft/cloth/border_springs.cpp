#include "weft/cloth/border_springs.h"

namespace weft {
namespace {

void collect(const Cloth& cloth, SpringDirection direction, std::vector<BorderSpring>& springs) {
  const int n = cloth.size;
  const bool stretch = direction == stretch_u || direction == stretch_v;
  for_each_spring(cloth.mates, cloth.springs[direction], [&](int r, int c, int r2, int c2) {
    if (!on_border(cloth.mates, r, c) && !on_border(cloth.mates, r2, c2)) return;
    const int a = cloth.mates.representative(r * n + c);
    const int b = cloth.mates.representative(r2 * n + c2);
    const float rest = cloth.springs[direction].rest_length(r, c);
    springs.push_back({std::min(a, b), std::max(a, b), rest, stretch});
  });
}

/// Keeps only the first of the springs that join the same particles with the same rest length.
void drop_copies(std::vector<BorderSpring>& springs) {
  const auto key_less = [&](int i, int j) {
    const BorderSpring &a = springs[i], &b = springs[j];
    if (a.from != b.from) return a.from < b.from;
    if (a.to != b.to) return a.to < b.to;
    if (a.rest_length != b.rest_length) return a.rest_length < b.rest_length;
    return i < j;
  };
  const auto same = [&](int i, int j) {
    const BorderSpring &a = springs[i], &b = springs[j];
    return a.from == b.from && a.to == b.to && a.rest_length == b.rest_length;
  };
  std::vector<int> order(springs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::sort(order.begin(), order.end(), key_less);
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  std::sort(order.begin(), order.end());
  std::vector<BorderSpring> kept;
  kept.reserve(order.size());
  for (const int i : order) kept.push_back(springs[i]);
  springs = std::move(kept);
}

}  // namespace

std::vector<BorderSpring> find_border_springs(const Cloth& cloth) {
  std::vector<BorderSpring> springs;
  for (const SpringDirection direction : {stretch_u, stretch_v, shear_1, shear_2})
    collect(cloth, direction, springs);
  drop_copies(springs);
  return springs;
}

}  // namespace weft
