#pragma once

#include <memory>
#include <span>
#include <vector>

#include "weft/param/border_relaxation.h"
#include "weft/param/disk_geometry.h"

namespace weft {

/// The projected Newton system of the stretch energy (see weft/param/stretch_newton.h): two
/// unknowns for each interior vertex, one for each freedom of the border; one pattern and one
/// symbolic factorization for all steps.
///
/// Solved by conjugate gradients, preconditioned with the Cholesky factors of the two diagonal
/// blocks (along u, along v): these have a quarter of the fill of a whole factorization, and one
/// digit of accuracy is enough for a Newton step.
class NewtonSystem {
 public:
  /// Keeps a reference to the geometry, which must outlive it.
  explicit NewtonSystem(const DiskGeometry& geometry, std::span<const BorderFreedom> freedoms = {});
  NewtonSystem(const NewtonSystem&) = delete;
  NewtonSystem& operator=(const NewtonSystem&) = delete;
  ~NewtonSystem();

  struct Step {
    std::vector<Vec2d> move;  ///< [D], zero where fixed; empty without unknowns or on a breakdown
    double slope = 0;         ///< derivative of the energy along `move`, negative
  };
  /// @param uv  [D] a valid map
  [[nodiscard]] Step solve(std::span<const Vec2d> uv);

 private:
  struct Blocks;
  std::unique_ptr<Blocks> blocks_;
};

}  // namespace weft
