#include "weft/cloth/baselines/multigrid/preconditioner_level.h"

#include <algorithm>

#include "weft/cloth/baselines/mip_levels.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

// A direct solve costs less than the barriers of smoothing on levels of at most this size.
constexpr int coarsest_size = 5;

FilterLevel empty_level(const BorderMates& mates) {
  const int n = mates.size();
  FilterLevel level;
  level.mates = mates;
  for (Grid<float>* plane : {&level.own_weight, &level.own_diagonal, &level.inverse_diagonal})
    *plane = Grid<float>(n, n);
  level.zeros = Grid<float>(1, n);
  level.contacts = ContactBlocks(n);
  if (mates.class_count() > 0) level.share = level.count = Grid<float>(n, n, 1);
  for (int index = 0; index < mates.class_count(); ++index)
    for (const int s : mates.mates(index)) {
      level.count(s / n, s % n) = static_cast<float>(mates.mates(index).size());
      level.share(s / n, s % n) = 1 / level.count(s / n, s % n);
    }
  for (Planes3* planes : {&level.rhs, &level.value, &level.result}) *planes = Planes3(n);
  return level;
}

float at(const Grid<float>& plane, int row, int col) {
  const bool inside = row >= 0 && row < plane.rows() && col >= 0 && col < plane.cols();
  return inside ? plane(row, col) : 0.0F;
}

using Edges = std::array<Grid<float>, 4>;

/// Conductance of a coarse edge along a line from the fine edges around it, so that both levels
/// bound the energy of a linear field alike: a fine edge sees half of a coarse edge's difference.
/// Across the line weights are 1/2 1 1/2.
float line_edge(const Grid<float>& fine, SpringOffset offset, int row, int col) {
  const auto [down, right] = offset;
  float sum = 0;
  for (int side = -1; side <= 1; ++side) {
    const float share = side == 0 ? 1.0F : 0.5F;
    const int r = 2 * row + side * right, c = 2 * col + side * down;
    sum += share * 0.25F * (at(fine, r, c) + at(fine, r + down, c + right));
  }
  return sum;
}

/// The mean of a coarse cell's four fine diagonals; `right` -1 for those that run to the left.
float diagonal_edge(const Grid<float>& fine, int row, int col, int right) {
  const int r = 2 * row, c = 2 * col;
  return 0.25F * (at(fine, r, c) + at(fine, r + 1, c) + at(fine, r, c + right) +
                  at(fine, r + 1, c + right));
}

/// @return factor times the edges of the next coarser level
Edges coarsened(const Edges& fine, float factor) {
  const int n = (fine[0].rows() - 1) / 2 + 1;
  Edges coarse;
  for (Grid<float>& plane : coarse) plane = Grid<float>(n, n);
  for (int d = 0; d < bend_u; ++d) {
    const auto [down, right] = spring_offsets[d];
    const bool diagonal = down != 0 && right != 0;
    for (int r = 0; r + down < n; ++r)
      for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c)
        coarse[d](r, c) = factor * (diagonal ? diagonal_edge(fine[d], r, c, right)
                                             : line_edge(fine[d], spring_offsets[d], r, c));
  }
  return coarse;
}

void add_edges(const Edges& more, Edges& edges) {
  for (int d = 0; d < bend_u; ++d)
    for (int r = 0; r < edges[d].rows(); ++r)
      for (int c = 0; c < edges[d].cols(); ++c) edges[d](r, c) += more[d](r, c);
}

void add_ends(const Grid<float>& edges, SpringOffset offset, Grid<float>& diagonal) {
  const auto [down, right] = offset;
  const int n = edges.rows();
  for (int r = 0; r + down < n; ++r)
    for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c) {
      diagonal(r, c) += edges(r, c);
      diagonal(r + down, c + right) += edges(r, c);
    }
}

void set_diagonals(FilterLevel& level) {
  level.own_diagonal = level.own_weight;
  for (int d = 0; d < bend_u; ++d) add_ends(level.edge[d], spring_offsets[d], level.own_diagonal);
  level.inverse_diagonal = level.own_diagonal;
  sum_over_mates(level.mates, {&level.inverse_diagonal});
  for (int r = 0; r < level.size(); ++r)
    for (int c = 0; c < level.size(); ++c) {
      const float diagonal = level.inverse_diagonal(r, c);
      level.inverse_diagonal(r, c) = diagonal > 0 ? 1 / diagonal : 0.0F;
    }
}

/// The weights that are restricted to the next level: those of held particles include the diagonal.
Grid<float> weight_below(const FilterLevel& level, const Grid<float>* moves) {
  Grid<float> weight = level.own_weight;
  if (moves == nullptr) return weight;
  for (int r = 0; r < level.size(); ++r)
    for (int c = 0; c < level.size(); ++c)
      if ((*moves)(r, c) == 0) weight(r, c) += level.own_diagonal(r, c);
  return weight;
}

/// Upper bound, in any direction, of the stiffness of springs and their damping over h.
Grid<float> conductance(const SpringPlane& springs, double time_step) {
  Grid<float> result = springs.stiffness;
  const auto per_step = static_cast<float>(1 / time_step);
  for (int r = 0; r < result.rows(); ++r)
    for (int c = 0; c < result.cols(); ++c) result(r, c) += per_step * springs.damping(r, c);
  return result;
}

/// Second neighbours are bounded by the edges between: |a + b|^2 <= 2 |a|^2 + 2 |b|^2, which is
/// exact where a field is smooth.
void add_second_neighbours(const Grid<float>& second, SpringOffset offset, Grid<float>& edges) {
  const auto [down, right] = offset;
  const int n = edges.rows(), gap_down = down / 2, gap_right = right / 2;
  for (int r = 0; r + down < n; ++r)
    for (int c = 0; c + right < n; ++c) {
      edges(r, c) += 2 * second(r, c);
      edges(r + gap_down, c + gap_right) += 2 * second(r, c);
    }
}

Edges spring_edges(const Cloth& cloth, double time_step) {
  Edges edges;
  for (int d = 0; d < bend_u; ++d) edges[d] = conductance(cloth.springs[d], time_step);
  for (const int d : {bend_u, bend_v})
    add_second_neighbours(conductance(cloth.springs[d], time_step), spring_offsets[d],
                          edges[d - bend_u]);
  return edges;
}

Edges bending_edges(const Cloth& cloth) {
  Edges edges;
  for (int d = 0; d < bend_u; ++d) edges[d] = bending_bound(cloth, static_cast<SpringDirection>(d));
  return edges;
}

void set_masses(const Cloth& cloth, double time_step, FilterLevel& level) {
  const auto per_step = static_cast<float>(1 / (time_step * time_step));
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      const float* share = level.share_row(r);
      level.own_weight(r, c) = per_step * cloth.mass(r, c) * (share == nullptr ? 1.0F : share[c]);
    }
}

}  // namespace

OperatorRow FilterLevel::operator_row(int row) const {
  const auto above = [&](int direction) {
    return row > 0 ? edge[direction].row(row - 1) : zeros.row(0);
  };
  return {
      own_weight.row(row),    edge[stretch_u].row(row), edge[stretch_v].row(row), above(stretch_v),
      edge[shear_1].row(row), above(shear_1),           edge[shear_2].row(row),   above(shear_2)};
}

StencilRows FilterLevel::stencil_rows(int row) const {
  return {row_of(value, std::max(0, row - 1)), row_of(value, row),
          row_of(value, std::min(size() - 1, row + 1))};
}

std::vector<FilterLevel> make_filter_levels(const Cloth& cloth, double time_step) {
  std::vector<FilterLevel> levels;
  levels.push_back(empty_level(cloth.mates));
  Edges springs = spring_edges(cloth, time_step), bending = bending_edges(cloth);
  levels.back().edge = springs;
  add_edges(bending, levels.back().edge);
  set_masses(cloth, time_step, levels.back());
  while (levels.back().size() % 2 == 1 && levels.back().size() > coarsest_size) {
    const BorderMates& mates = levels.back().mates;
    const bool matched = halves(mates);
    FilterLevel coarse =
        empty_level(matched ? halved(mates) : BorderMates((mates.size() - 1) / 2 + 1, {}));
    coarse.matched = matched;
    springs = coarsened(springs, 1);
    bending = coarsened(bending, 0.25F);
    coarse.edge = springs;
    add_edges(bending, coarse.edge);
    levels.push_back(std::move(coarse));
  }
  return levels;
}

void renew_weights(std::vector<FilterLevel>& levels, const Grid<float>& moves) {
  set_diagonals(levels.front());
  std::vector<float> line(static_cast<std::size_t>(levels.front().size()));
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const Grid<float> weight = weight_below(levels[i - 1], i == 1 ? &moves : nullptr);
    FilterLevel& coarse = levels[i];
    for (int r = 0; r < coarse.size(); ++r)
      restrict_plane_row(weight, nullptr, r, line.data(), coarse.own_weight.row(r));
    set_diagonals(coarse);
  }
  FilterLevel& finest = levels.front();
  for (int r = 0; r < finest.size(); ++r)
    for (int c = 0; c < finest.size(); ++c) finest.inverse_diagonal(r, c) *= moves(r, c);
}

}  // namespace weft
