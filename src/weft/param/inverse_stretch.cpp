#include "weft/param/inverse_stretch.h"

#include <cmath>

namespace weft {

double inverse_weight(const SurfaceTriangle& surface) {
  constexpr double share = 0.2;
  constexpr double flattest = 0.01;  // area over square sides
  const auto& [g11, g12, g22, area] = surface;
  const double least = flattest * 2 * (g11 - g12 + g22);
  const double raised = std::sqrt(area * area + least * least);
  return raised > 0 ? share / (8 * raised) : 0;
}

}  // namespace weft
