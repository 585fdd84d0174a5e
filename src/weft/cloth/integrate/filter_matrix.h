#pragma once

#include <array>
#include <vector>

#include "weft/cloth/cloth.h"

namespace weft {

/// W = (1 - h^2 M^-1 H)^-1 of a grid of particles joined by the springs of the twelve neighbours,
/// with H_ij = k_ij, H_ii = -sum_j k_ij [desbrun99]: rows sum to 1, M W is symmetric. Accelerations
/// are filtered by W; forces by M W M^-1. (The printed h / m has the wrong unit.)
struct FilterGrid {
  int size = 0;                  ///< samples a side
  std::vector<int> particle_of;  ///< [size^2] particle of every sample; mates share one
  std::vector<double> mass;      ///< [particles] [kg]
  std::array<Grid<double>, spring_directions>
      stiffness;         ///< [size x size] each, from (r, c) on [N/m]
  double time_step = 0;  ///< [s]
};

/// @return [particles x particles], row by row
std::vector<float> filter_matrix(const FilterGrid& grid);

}  // namespace weft
