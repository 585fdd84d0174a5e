#include "weft/cloth/bending.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

int used_neighbours(const BendingPlanes& bending) {
  return bending.diagonals ? bending_neighbours : straight_bending_neighbours;
}

/// Columns of a row whose neighbour at an offset is inside the image; empty if its row is outside.
Range columns_with(BendingOffset to, int row, int size) {
  if (row + to.down < 0 || row + to.down >= size) return {0, 0};
  return {to.right < 0 ? -to.right : 0, to.right > 0 ? size - to.right : size};
}

/// Adds the bounds of the border edges of one direction. Edges of negative stiffness are omitted;
/// an edge between second neighbours along the border is bounded by twice the two edges between
/// them.
void add_border_bound(const BorderBending& border, SpringDirection direction, Grid<float>& bound) {
  const auto [down, right] = spring_offsets[direction];
  for (int r = 0; r + 1 < static_cast<int>(border.starts.size()); ++r)
    for (int i = border.starts[r]; i < border.starts[r + 1]; ++i) {
      const BorderBending::Edge& edge = border.edges[i];
      const int rows_between = edge.other_row - r, cols_between = edge.other_col - edge.col;
      const float stiffness = std::max(edge.stiffness, 0.0F);
      if (rows_between == down && cols_between == right) bound(r, edge.col) += stiffness;
      if (rows_between != 2 * down || cols_between != 2 * right) continue;
      bound(r, edge.col) += 2 * stiffness;
      bound(r + down, edge.col + right) += 2 * stiffness;
    }
}

}  // namespace

BendingPass::BendingPass(const Cloth& cloth, InstructionSet instructions)
    : cloth_(cloth), kernels_(&kernels_for(instructions)), normals_(cloth) {
  if (cloth.bending.active) curved_ = Planes3(cloth.size);
}

void BendingPass::curve(const Planes3& position, Worker& worker) {
  if (!active()) return;
  gather(position, worker);
  if (cloth_.bending.curved) normals_.subtract(position, curved_, worker);
}

void BendingPass::curve_change(const Planes3& change, Worker& worker) {
  if (!active()) return;
  gather(change, worker);
  if (cloth_.bending.curved) normals_.subtract_change(change, curved_, worker);
}

void BendingPass::gather(const Planes3& field, Worker& worker) {
  if (worker.rank() == 0) field_ = &field;
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) curve_row(field, r);
  worker.barrier();
  if (cloth_.mates.class_count() == 0) return;
  sum_over_mates(cloth_.mates, worker, {&curved_.x, &curved_.y, &curved_.z});
  worker.barrier();
}

/// Weights differences instead of positions: far from the origin, sums of weighted positions would
/// lose the differences to rounding.
void BendingPass::curve_row(const Planes3& position, int row) {
  const Row3 u = row_of(curved_, row);
  clear(u, cloth_.size);
  const ConstRow3 here = row_of(position, row);
  for (int k = 0; k < used_neighbours(cloth_.bending); ++k) {
    const BendingOffset to = bending_offsets[k];
    const Range with = columns_with(to, row, cloth_.size);
    if (with.first >= with.last) continue;
    const ConstRow3 there = row_of(position, row + to.down);
    kernels_->add_differences(
        {with.first, with.last, to.right, cloth_.bending.weight[k].row(row), here, there}, u);
  }
}

void BendingPass::add_row(float factor, int row, Planes3& out) const {
  if (!active()) return;
  add_border_row(factor, row, out);
  if (cloth_.bending.curved) normals_.add_row(factor, row, out);
  const Row3 sum = row_of(out, row);
  const ConstRow3 u = row_of(curved_, row);
  for (int k = 0; k < used_neighbours(cloth_.bending); ++k) {
    // This sample is neighbour `back` of its neighbour k.
    const int back = k ^ 1;
    const BendingOffset to = bending_offsets[k];
    const Range with = columns_with(to, row, cloth_.size);
    if (with.first >= with.last) continue;
    const ConstRow3 other = row_of(curved_, row + to.down);
    kernels_->add_transposed(
        {with.first, with.last, to.right, factor, cloth_.bending.weight[k].row(row),
         cloth_.bending.weight[back].row(row + to.down), u, other},
        sum);
  }
}

void BendingPass::add_border_row(float factor, int row, Planes3& out) const {
  const BorderBending& border = cloth_.bending.border;
  if (border.starts.empty()) return;
  for (int i = border.starts[row]; i < border.starts[row + 1]; ++i) {
    const BorderBending::Edge& edge = border.edges[i];
    const float k = factor * edge.stiffness;
    const Vec3f pull = k * (field_->at(edge.other_row, edge.other_col) - field_->at(row, edge.col));
    out.set(row, edge.col, out.at(row, edge.col) + pull);
  }
}

double BendingPass::energy() const {
  double energy = 0;
  for (int r = 0; active() && r < cloth_.size; ++r) energy += row_energy(r);
  return energy;
}

double BendingPass::row_energy(int row) const {
  if (!active()) return 0;
  const ConstRow3 u = row_of(curved_, row);
  double energy = 0.5 * kernels_->dot(cloth_.size, cloth_.owner.row(row), u, u);
  const BorderBending& border = cloth_.bending.border;
  if (border.starts.empty()) return energy;
  for (int i = border.starts[row]; i < border.starts[row + 1]; ++i) {
    const BorderBending::Edge& edge = border.edges[i];
    const Vec3f displacement =
        field_->at(edge.other_row, edge.other_col) - field_->at(row, edge.col);
    energy += 0.25 * edge.stiffness * squared_length(vec_cast<double>(displacement));
  }
  return energy;
}

Grid<float> bending_bound(const Cloth& cloth, SpringDirection direction) {
  const int n = cloth.size;
  const auto [down, right] = spring_offsets[direction];
  Grid<float> bound(n, n), total(n, n);
  if (!cloth.bending.active || down > 1 || right > 1) return bound;
  for (const Grid<float>& weight : cloth.bending.weight)
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) total(r, c) += std::abs(weight(r, c));
  sum_over_mates(cloth.mates, {&total});
  const auto is_direction = [d = down, r = right](BendingOffset o) {
    return o.down == d && o.right == r;
  };
  const auto ahead = static_cast<std::size_t>(
      std::find_if(bending_offsets.begin(), bending_offsets.end(), is_direction) -
      bending_offsets.begin());
  const Grid<float>&forth = cloth.bending.weight[ahead], &back = cloth.bending.weight[ahead ^ 1U];
  for (int r = 0; r + down < n; ++r)
    for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c)
      bound(r, c) = total(r, c) * std::abs(forth(r, c)) +
                    total(r + down, c + right) * std::abs(back(r + down, c + right));
  add_border_bound(cloth.bending.border, direction, bound);
  return bound;
}

double bending_energy(const Cloth& cloth, const Planes3& position) {
  if (!cloth.bending.active) return 0;
  BendingPass pass(cloth);
  ThreadTeam alone(1);
  alone.run([&](Worker& worker) { pass.curve(position, worker); });
  return pass.energy();
}

}  // namespace weft
