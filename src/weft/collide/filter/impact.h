#pragma once

#include <array>

namespace weft {

/// One point of a side of an impact, along the normal from side b to side a.
struct ImpactPoint {
  double speed = 0;         ///< [m/s]
  double inverse_mass = 0;  ///< 0: held, goes as it does [1/kg]
};

/// Both sides of an impact. Side b without points is a body.
struct ImpactSides {
  std::array<ImpactPoint, 6> points{};  ///< side a's, then side b's
  int count_a = 0, count_b = 0;
  double body_speed = 0;  ///< of side b where it is a body [m/s]
};

/// Lets the sides strike each other without bouncing: whatever of side a goes slower along the
/// normal, and of side b faster, than one common speed goes at that. It is the one at which side a
/// gains the momentum that side b loses; before a body, and before what is held, it is theirs.
/// Nothing happens between sides that do not approach each other.
void strike(ImpactSides& sides) noexcept;

}  // namespace weft
