#include "weft/core/orientation.h"

#include <cmath>

#include <boost/multiprecision/cpp_int.hpp>

namespace weft {
namespace {

int exact_orientation(Vec2d a, Vec2d b, Vec2d c) {
  using Exact = boost::multiprecision::cpp_rational;
  const Exact cx(c.x), cy(c.y);
  const Exact left = (Exact(a.x) - cx) * (Exact(b.y) - cy);
  const Exact right = (Exact(a.y) - cy) * (Exact(b.x) - cx);
  return left.compare(right);
}

}  // namespace

int orientation(Vec2d a, Vec2d b, Vec2d c) {
  constexpr double epsilon = 0x1p-53;
  constexpr double error_factor = (3.0 + 16.0 * epsilon) * epsilon;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  if (std::fabs(determinant) > error_factor * (std::fabs(left) + std::fabs(right)))
    return determinant > 0 ? 1 : -1;
  const int sign = exact_orientation(a, b, c);
  return (sign > 0) - (sign < 0);
}

}  // namespace weft
