#pragma once

#include <array>

namespace weft {

/// One point of an impact; speeds are along the normal from side b to side a.
struct ImpactPoint {
  double speed = 0;         ///< [m/s]
  double inverse_mass = 0;  ///< 0: held, keeps its speed [1/kg]
};

/// Both sides of an impact. Side b without points is a body.
struct ImpactSides {
  std::array<ImpactPoint, 6> points{};  ///< side a's, then side b's
  int count_a = 0, count_b = 0;
  double body_speed = 0;  ///< of side b where it is a body [m/s]
};

/// Inelastic impact of two sides. Points of side a that are slower along the normal than a common
/// speed, and points of side b that are faster, take that speed. It is the speed at which side a
/// gains the momentum that side b loses; against a body or held points it is theirs. Sides that do
/// not approach each other keep their speeds.
void strike(ImpactSides& sides) noexcept;

}  // namespace weft
