#pragma once

#include <memory>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// Solves for interior vertices that are the weighted means of their neighbours, with a given
/// border. Keeps the sparsity pattern and its symbolic factorization, so that solving again with
/// other weights or another border is cheap.
class InteriorSolver {
 public:
  InteriorSolver(const DiskMesh& disk, const HalfEdges& edges);
  InteriorSolver(InteriorSolver&&) noexcept;
  InteriorSolver& operator=(InteriorSolver&&) noexcept;
  ~InteriorSolver();

  /// Factorizes for symmetric weights (weights[h] == weights[twin]): Cholesky, the symbolic part
  /// reused.
  /// @param weights  [3F] > 0, see weft/param/weights.h
  /// @return false when the factorization broke down or met a number that is not finite
  bool factorize_symmetric(std::span<const double> weights);
  /// Solves for the interior vertices with the last symmetric factorization.
  /// @param uv  [D] border given, interior overwritten
  void solve_symmetric(std::span<Vec2d> uv) const;

  /// Solves with weights that are not symmetric: sparse LU with diagonal pivots, which are stable
  /// as the matrix is a weakly diagonally dominant M-matrix, and iterative refinement.
  /// @return false when the factorization broke down; uv is then unchanged
  bool solve_general(std::span<const double> weights, std::span<Vec2d> uv) const;

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace weft
