#pragma once

#include <array>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/row_pointers.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"
#include "weft/vec.h"

namespace weft {

/// Three vectors of one length, each coordinate contiguous and padded with zeros like a row of a
/// Grid.
class Vectors3 {
 public:
  Vectors3() = default;
  explicit Vectors3(int count) : planes_(3, count) {}
  [[nodiscard]] Row3 rows() { return {planes_.row(0), planes_.row(1), planes_.row(2)}; }
  [[nodiscard]] ConstRow3 rows() const { return {planes_.row(0), planes_.row(1), planes_.row(2)}; }
  [[nodiscard]] Vec3f at(int i) const { return {planes_(0, i), planes_(1, i), planes_(2, i)}; }
  void set(int i, Vec3f v) {
    planes_(0, i) = v.x;
    planes_(1, i) = v.y;
    planes_(2, i) = v.z;
  }

 private:
  Grid<float> planes_;
};

/// W = (1 - h^2 M^-1 H)^-1 of a grid of particles joined by the springs of the twelve neighbours,
/// with H_ij = k_ij, H_ii = -sum_j k_ij [desbrun99]: rows sum to 1, M W is symmetric. Accelerations
/// are filtered by W; forces by M W M^-1. (The printed h / m has the wrong unit.)
struct FilterGrid {
  int size = 0;                  ///< samples a side
  std::vector<int> particle_of;  ///< [size^2] particle of every sample; mates share one; -1: held
  std::vector<double> mass;      ///< [particles] [kg]
  std::array<Grid<double>, spring_directions>
      stiffness;         ///< [size x size] each, from (r, c) on [N/m]
  double time_step = 0;  ///< [s]
};

/// Computes W by a sparse Cholesky factorization of M - h^2 H, in which a held particle is a fixed
/// support, and one solve a row. Rows are shared among the team.
/// @return [particles x particles]; its padding holds zeros
Grid<float> filter_matrix(const FilterGrid& grid, ThreadTeam& team);

}  // namespace weft
