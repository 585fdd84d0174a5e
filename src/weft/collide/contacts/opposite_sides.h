#pragma once

#include <array>

#include "weft/collide/contacts/contact_body.h"

namespace weft {

/// Looks for the sides of a body that are opposite to the closest ones of some samples, as the arm
/// is to the chest for cloth in an armpit. Made once for many samples.
class OppositeSides {
 public:
  /// @param gap  kept between cloth and body [m]
  explicit OppositeSides(double gap) : gap_(gap) {}
  /// A sample with its closest side.
  struct Near {
    Vec3f start;   ///< [m]
    Vec3f normal;  ///< of the closest side
    float gap;     ///< from there [m]
    int hint;      ///< a triangle that may be of the opposite side; -1: none
  };
  void clear() { asked_.count = 0; }
  /// Asks for a sample if it touches its closest side.
  /// @param triangle  will be one of the opposite side, where there is any
  void ask(const Near& near, int* triangle);
  /// Answers for all samples.
  void find(const BodyQuery& body);

 private:
  double gap_;
  NearestTile asked_;
  NearestPoints found_;
  std::array<Near, NearestTile::capacity> near_{};
  std::array<int*, NearestTile::capacity> answers_{};
};

}  // namespace weft
