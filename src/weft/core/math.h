#pragma once

#include <numbers>

namespace weft {

inline constexpr double pi = std::numbers::pi;
/// Acceleration of gravity where none is given. [m/s^2]
inline constexpr double standard_gravity = 9.81;

// Results must not depend on the machine, but the C library selects variants of these functions by
// processor. These use plain arithmetic without tables. Tests bound their error over the stated
// range.

/// Sine and cosine of a finite angle [rad]: within 4e-16 of the exact value for small angles; the
/// error grows with |angle| by rounding of the reduction only, beyond 1e5 to 1e-16 |angle|.
double sine(double angle);
double cosine(double angle);
/// The angle of (x, y) in (-pi, pi]; 0 for the zero vector. [rad]
double arc_tangent(double y, double x);
/// Arc cosine in [0, pi]; the argument is clamped to [-1, 1]. [rad]
double arc_cosine(double value);

}  // namespace weft
