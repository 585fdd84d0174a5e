#pragma once

#include "weft/core/planes.h"

namespace weft {

/// Remembers that a cloth was certainly far from meeting itself, and how far it may move before
/// that has to be asked again. What was found is that rectangles of its image which are certainly
/// unfolded hold all pairs of cells but those that are farther apart than a reach: edges may change
/// by twice the slack and every sample may leave the others' common way by the room.
class SelfClearance {
 public:
  struct Allowance {
    float slack = 0;  ///< [m]
    float room = 0;   ///< [m]
  };
  /// Takes where the cloth is. [n x n] [m]
  void keep(const Planes3& positions, const Allowance& allowance);
  void forget() { known_ = false; }
  [[nodiscard]] bool known() const { return known_; }
  /// Whether a cloth whose samples are there, or on straight ways between two such places, is as
  /// far from meeting itself still.
  [[nodiscard]] bool covers(const Planes3& positions) const noexcept;

 private:
  bool known_ = false;
  Planes3 kept_;
  Allowance allowance_;
};

}  // namespace weft
