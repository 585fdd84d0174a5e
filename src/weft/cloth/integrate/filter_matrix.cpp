#include "weft/cloth/integrate/filter_matrix.h"

#include <Eigen/Dense>
#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// M - h^2 H: symmetric and positive definite.
Eigen::MatrixXd system_of(const FilterGrid& grid) {
  const auto count = static_cast<Eigen::Index>(grid.mass.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) a(i, i) = grid.mass[static_cast<std::size_t>(i)];
  const int n = grid.size;
  const double squared_step = grid.time_step * grid.time_step;
  for (int d = 0; d < spring_directions; ++d) {
    const auto [down, right] = spring_offsets[d];
    for (int r = 0; r + down < n; ++r)
      for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c) {
        const int i = grid.particle_of[r * n + c], j = grid.particle_of[(r + down) * n + c + right];
        if (i == j) continue;
        const double k = squared_step * grid.stiffness[d](r, c);
        a(i, i) += k;
        a(j, j) += k;
        a(i, j) -= k;
        a(j, i) -= k;
      }
  }
  return a;
}

}  // namespace

std::vector<float> filter_matrix(const FilterGrid& grid) {
  const auto count = static_cast<Eigen::Index>(grid.mass.size());
  const Eigen::LLT<Eigen::MatrixXd> factor(system_of(grid));
  const Eigen::Map<const Eigen::VectorXd> mass(grid.mass.data(), count);
  const Eigen::MatrixXd w = factor.solve(Eigen::MatrixXd(mass.asDiagonal()));
  std::vector<float> rows(grid.mass.size() * grid.mass.size());
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      rows[static_cast<std::size_t>(i * count + j)] = static_cast<float>(w(i, j));
  return rows;
}

}  // namespace weft
