#include "weft/core/orientation.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdint>

#include <boost/multiprecision/cpp_int.hpp>

namespace weft {
namespace {

using boost::multiprecision::cpp_int;
/// Integers of fixed size on the stack: far faster than growing ones.
using FixedInt = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    512, 512, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;

constexpr double epsilon = 0x1p-53;
/// Below this value products may have lost digits by underflow, which the error bounds ignore.
constexpr double min_trusted = 1e-200;

int sign_of(double value) { return (value > 0) - (value < 0); }
int compare(double a, double b) { return (a > b) - (a < b); }

/// The rounding error of a - b, exactly [shewchuk97].
double error_of_difference(double a, double b) {
  const double difference = a - b, subtracted = a - difference;
  return (a - (difference + subtracted)) + (subtracted - b);
}

/// The rounding error of a * b, exactly where nothing underflows [shewchuk97].
double error_of_product(double a, double b) {
  const auto upper_half = [](double value) {
    constexpr double splitter = 0x1p27 + 1;
    const double wide = splitter * value;
    return wide - (wide - value);
  };
  const double a_upper = upper_half(a), a_lower = a - a_upper;
  const double b_upper = upper_half(b), b_lower = b - b_upper;
  return a_lower * b_lower -
         (((a * b - a_upper * b_upper) - a_lower * b_upper) - a_upper * b_lower);
}

/// A double as mantissa * 2^exponent.
struct Scaled {
  std::int64_t mantissa = 0;
  int exponent = INT_MAX;  // of zero: larger than any
  explicit Scaled(double value) {
    if (value == 0) return;
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent -= 53;
  }
};

/// The sign of the determinant of the differences of points to the last one, in integer arithmetic:
/// coordinates are multiples of the smallest power of two among them.
template <class Int, std::size_t Dimension>
int sign_in(const std::array<std::array<Scaled, Dimension>, Dimension + 1>& points, int min) {
  std::array<std::array<Int, Dimension>, Dimension + 1> whole;
  for (std::size_t i = 0; i <= Dimension; ++i)
    for (std::size_t k = 0; k < Dimension; ++k) {
      whole[i][k] = points[i][k].mantissa;
      if (points[i][k].mantissa != 0) whole[i][k] *= Int(1) << (points[i][k].exponent - min);
    }
  for (std::size_t i = 0; i < Dimension; ++i)
    for (std::size_t k = 0; k < Dimension; ++k) whole[i][k] -= whole[Dimension][k];
  const auto minor = [&](int i, int j, int k, int l) -> Int {
    return whole[i][k] * whole[j][l] - whole[i][l] * whole[j][k];
  };
  if constexpr (Dimension == 2) {
    return minor(0, 1, 0, 1).sign();
  } else {
    const Int sum = whole[0][0] * minor(1, 2, 1, 2) + whole[0][1] * minor(1, 2, 2, 0) +
                    whole[0][2] * minor(1, 2, 0, 1);
    return sum.sign();
  }
}

template <std::size_t Dimension>
int exact_sign(const std::array<std::array<Scaled, Dimension>, Dimension + 1>& points) {
  int min = INT_MAX, max = INT_MIN;
  for (const auto& point : points)
    for (const Scaled& value : point)
      if (value.mantissa != 0) {
        min = std::min(min, value.exponent);
        max = std::max(max, value.exponent);
      }
  if (max == INT_MIN) return 0;  // all coordinates are zero
  // Three factors of 53 + 64 + 1 bits, and a sum of six such products, fit 512.
  constexpr int max_shift = 64;
  if (max - min <= max_shift) return sign_in<FixedInt, Dimension>(points, min);
  return sign_in<cpp_int, Dimension>(points, min);
}

std::array<Scaled, 2> scaled(Vec2d p) { return {Scaled(p.x), Scaled(p.y)}; }
std::array<Scaled, 3> scaled(Vec3d p) { return {Scaled(p.x), Scaled(p.y), Scaled(p.z)}; }

/// Coplanar cases that are frequent in meshes: two equal points, or four points in a plane
/// perpendicular to a coordinate axis.
bool plainly_flat(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  if (a == b || a == c || a == d || b == c || b == d || c == d) return true;
  const auto level = [&](double Vec3d::*axis) {
    return a.*axis == d.*axis && b.*axis == d.*axis && c.*axis == d.*axis;
  };
  return level(&Vec3d::x) || level(&Vec3d::y) || level(&Vec3d::z);
}

/// Whether no digit is lost in the differences of two points' coordinates.
bool have_exact_difference(Vec2d a, Vec2d b) {
  return error_of_difference(a.x, b.x) == 0 && error_of_difference(a.y, b.y) == 0;
}

}  // namespace

int orientation(Vec2d a, Vec2d b, Vec2d c) {
  constexpr double error_factor = (3.0 + 16.0 * epsilon) * epsilon;
  const int sign_of_left = compare(a.x, c.x) * compare(b.y, c.y);
  const int sign_of_right = compare(a.y, c.y) * compare(b.x, c.x);
  if (sign_of_left != sign_of_right) return compare(sign_of_left, sign_of_right);
  if (sign_of_left == 0) return 0;
  const Vec2d p = a - c, q = b - c;
  const double left = p.x * q.y, right = p.y * q.x;
  const double permanent = std::fabs(left) + std::fabs(right);
  if (permanent > min_trusted) {
    const double determinant = left - right;
    if (std::fabs(determinant) > error_factor * permanent) return sign_of(determinant);
    // As of points with coordinates in single precision, which often lie on one line.
    if (have_exact_difference(a, c) && have_exact_difference(b, c))
      return left != right ? compare(left, right)
                           : compare(error_of_product(p.x, q.y), error_of_product(p.y, q.x));
  }
  return exact_sign<2>({scaled(a), scaled(b), scaled(c)});
}

int orientation(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  constexpr double error_factor = (7.0 + 56.0 * epsilon) * epsilon;
  const Vec3d p = a - d, q = b - d, r = c - d;
  const double yz = q.y * r.z, zy = q.z * r.y;
  const double zx = q.z * r.x, xz = q.x * r.z;
  const double xy = q.x * r.y, yx = q.y * r.x;
  const double determinant = p.x * (yz - zy) + p.y * (zx - xz) + p.z * (xy - yx);
  const double permanent = std::fabs(p.x) * (std::fabs(yz) + std::fabs(zy)) +
                           std::fabs(p.y) * (std::fabs(zx) + std::fabs(xz)) +
                           std::fabs(p.z) * (std::fabs(xy) + std::fabs(yx));
  // The determinant of a - d, b - d, c - d is positive when d lies below the plane.
  if (permanent > min_trusted && std::fabs(determinant) > error_factor * permanent)
    return -sign_of(determinant);
  if (plainly_flat(a, b, c, d)) return 0;
  return -exact_sign<3>({scaled(a), scaled(b), scaled(c), scaled(d)});
}

}  // namespace weft
