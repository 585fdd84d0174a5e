#pragma once

#include <numbers>

namespace weft {

inline constexpr double pi = std::numbers::pi;
/// What a mass weighs where nothing else is said. [m/s^2]
inline constexpr double standard_gravity = 9.81;

// The C library picks other variants of these by processor; results must not depend on the machine,
// so these are our own: plain arithmetic, no tables. Largest error seen over the stated range is
// tested.

/// Sine and cosine of an angle [rad], |angle| <= 1e5: within 4e-16 of the exact value there for
/// small angles, growing with |angle| by rounding of the reduction only.
double sine(double angle);
double cosine(double angle);
/// The angle of (x, y) in (-pi, pi]; 0 for the zero vector. [rad]
double arc_tangent(double y, double x);
/// In [0, pi]; the argument is clamped to [-1, 1]. [rad]
double arc_cosine(double value);

}  // namespace weft
