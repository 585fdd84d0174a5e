#pragma once

#include "weft/cloth/bending.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Bending of cloth whose rest shape is curved, exactly: the gradient and the Gauss-Newton Hessian
/// of |M x - r n(x)|^2 / 2, in which normals turn with the cloth.
class CurvedBending {
 public:
  /// @param cloth  kept by reference
  CurvedBending(const Cloth& cloth, InstructionSet instructions);
  [[nodiscard]] bool active() const { return active_; }

  // To be called by every worker; each ends with a barrier.

  /// @param position  by reference until the last change()
  void set_position(const Planes3& position, Worker& worker);
  void change(const PaddedVectors& direction, Worker& worker);
  /// The energy at the last position, by rank 0 alone [J].
  [[nodiscard]] double energy() const { return pass_.energy(); }

  /// Adds a row's own part of the gradient after set_position, of the product after change.
  void add_row(int row, PaddedVectors& out);

 private:
  const Cloth& cloth_;
  bool active_;
  BendingPass pass_;
  Planes3 direction_, force_;
};

}  // namespace weft
