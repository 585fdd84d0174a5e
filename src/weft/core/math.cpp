#include "weft/core/math.h"

#include <cmath>

namespace weft {
namespace {

// pi/2 as two parts of 33 bits and a rest, so that k * part is exact for the first two and
// |k| < 2^20 (Cody & Waite).
constexpr double half_pi_1 = 0x1.921fb54400000p+0;
constexpr double half_pi_2 = 0x1.0b4611a600000p-34;
constexpr double half_pi_3 = 0x1.3198a2e037073p-69;

// Taylor series are enough on |t| <= pi/4: the first term left out is below 1e-17.
double sine_series(double t) {
  const double s = t * t;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = s / (k * (k - 1)) * (-1.0 - sum);
  return t + t * sum;
}

double cosine_series(double t) {
  const double s = t * t;
  double sum = 0;
  for (int k = 18; k >= 2; k -= 2) sum = s / (k * (k - 1)) * (-1.0 - sum);
  return 1.0 + sum;
}

struct Reduced {
  double angle;  // in [-pi/4, pi/4]
  int quarter;   // quarter turns subtracted, modulo 4
};

Reduced reduce(double angle) {
  // Whole turns of more than an integer holds; fmod is exact.
  if (std::fabs(angle) > 1e5) angle = std::fmod(angle, 2 * pi);
  const double turns = std::nearbyint(angle * (2.0 / pi));
  const double rest = ((angle - turns * half_pi_1) - turns * half_pi_2) - turns * half_pi_3;
  return {rest, static_cast<int>(static_cast<long long>(turns) & 3)};
}

// atan on [0, 1]: halved twice by atan(t) = 2 atan(t / (1 + sqrt(1 + t^2))), then its series.
double arc_tangent_unit(double t) {
  const double once = t / (1.0 + std::sqrt(1.0 + t * t));
  const double twice = once / (1.0 + std::sqrt(1.0 + once * once));
  const double s = twice * twice;
  double sum = 0;
  for (int k = 27; k >= 3; k -= 2) sum = s * (1.0 / k - sum);
  return 4.0 * (twice - twice * sum);
}

}  // namespace

double sine(double angle) {
  const Reduced r = reduce(angle);
  const double value = (r.quarter & 1) != 0 ? cosine_series(r.angle) : sine_series(r.angle);
  return (r.quarter & 2) != 0 ? -value : value;
}

double cosine(double angle) {
  const Reduced r = reduce(angle);
  const double value = (r.quarter & 1) != 0 ? sine_series(r.angle) : cosine_series(r.angle);
  return r.quarter == 1 || r.quarter == 2 ? -value : value;
}

double arc_tangent(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? arc_tangent_unit(ay / ax) : pi / 2 - arc_tangent_unit(ax / ay);
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

double arc_cosine(double value) {
  if (value >= 1) return 0;
  if (value <= -1) return pi;
  return arc_tangent(std::sqrt((1 - value) * (1 + value)), value);
}

}  // namespace weft
