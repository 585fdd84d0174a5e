#include "weft/cloth/bending_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "weft/cloth/bending.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

constexpr float min_squared = 1e-36F;

/// The corner between two straight edges a and b at a sample, oriented from rows to columns.
struct Corner {
  BendingOffset a, b;
};
constexpr std::array<Corner, 4> corners{
    {{{0, 1}, {1, 0}}, {{1, 0}, {0, -1}}, {{0, -1}, {-1, 0}}, {{-1, 0}, {0, 1}}}};

BendingOffset minus(BendingOffset o) { return {-o.down, -o.right}; }
BendingOffset plus(BendingOffset o, BendingOffset p) {
  return {o.down + p.down, o.right + p.right};
}

/// Columns of a part of a row whose neighbours at both offsets are in the same chart.
Range columns_with(BendingOffset a, BendingOffset b, int row, const ChartRow& part) {
  for (const BendingOffset o : {a, b})
    if (row + o.down < part.rows.first || row + o.down >= part.rows.last) return {0, 0};
  return {part.columns.first + std::max({0, -a.right, -b.right}),
          part.columns.last - std::max({0, a.right, b.right})};
}

/// A row of a field at a neighbour offset: the neighbour of column c is at column c + shift.
struct CandidateRow {
  ConstRow3 at;
  int shift = 0;
};
CandidateRow seen(const Planes3& planes, int row, BendingOffset by = {}) {
  return {row_of(planes, row + by.down), by.right};
}

struct Edge {
  CandidateRow from, to;
};

/// out += factor p x q, p and q the differences along two edges.
void add_cross(Range columns, float factor, const Edge& p, const Edge& q, Row3 out) {
  const ConstRow3 p0 = p.from.at, p1 = p.to.at, q0 = q.from.at, q1 = q.to.at;
  const int i0 = p.from.shift, i1 = p.to.shift, j0 = q.from.shift, j1 = q.to.shift;
#pragma omp simd
  for (int c = columns.first; c < columns.last; ++c) {
    const float ax = p1.x[c + i1] - p0.x[c + i0], bx = q1.x[c + j1] - q0.x[c + j0];
    const float ay = p1.y[c + i1] - p0.y[c + i0], by = q1.y[c + j1] - q0.y[c + j0];
    const float az = p1.z[c + i1] - p0.z[c + i0], bz = q1.z[c + j1] - q0.z[c + j0];
    out.x[c] += factor * (ay * bz - az * by);
    out.y[c] += factor * (az * bx - ax * bz);
    out.z[c] += factor * (ax * by - ay * bx);
  }
}

/// out += factor p x q, p the difference along an edge.
void add_cross(Range columns, float factor, const Edge& p, const CandidateRow& q, Row3 out) {
  const ConstRow3 p0 = p.from.at, p1 = p.to.at, v = q.at;
  const int i0 = p.from.shift, i1 = p.to.shift, j = q.shift;
#pragma omp simd
  for (int c = columns.first; c < columns.last; ++c) {
    const float ax = p1.x[c + i1] - p0.x[c + i0];
    const float ay = p1.y[c + i1] - p0.y[c + i0];
    const float az = p1.z[c + i1] - p0.z[c + i0];
    out.x[c] += factor * (ay * v.z[c + j] - az * v.y[c + j]);
    out.y[c] += factor * (az * v.x[c + j] - ax * v.z[c + j]);
    out.z[c] += factor * (ax * v.y[c + j] - ay * v.x[c + j]);
  }
}

}  // namespace

BendingNormals::BendingNormals(const Cloth& cloth) : cloth_(cloth) {
  if (!cloth.bending.curved) return;
  rows_ = ChartRows(cloth.mates);
  for (Planes3* planes : {&area_, &turn_, &project_}) *planes = Planes3(cloth.size);
}

/// Own parts of the area vectors of a row: sums over the corners of the cross product of an edge in
/// `first` and an edge in `second`.
void BendingNormals::area_row(const Planes3& first, const Planes3& second, int row,
                              Planes3& out) const {
  const Row3 sum = row_of(out, row);
  for (const ChartRow& part : rows_.row(row))
    for (const auto& [a, b] : corners) {
      const Range columns = columns_with(a, b, row, part);
      if (columns.first >= columns.last) continue;
      add_cross(columns, 1, Edge{seen(first, row), seen(first, row, a)},
                Edge{seen(second, row), seen(second, row, b)}, sum);
    }
}

void BendingNormals::share_areas(Planes3& areas, Worker& worker) const {
  worker.barrier();
  if (cloth_.mates.class_count() == 0) return;
  sum_over_mates(cloth_.mates, worker, {&areas.x, &areas.y, &areas.z});
  worker.barrier();
}

void BendingNormals::subtract(const Planes3& position, Planes3& u, Worker& worker) {
  if (worker.rank() == 0) position_ = &position;
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    clear(row_of(area_, r), cloth_.size);
    area_row(position, position, r, area_);
  }
  share_areas(area_, worker);
  for (int r = mine.first; r < mine.last; ++r) {
    subtract_row(r, u);
    project_row(r, u);
  }
  worker.barrier();
}

void BendingNormals::subtract_change(const Planes3& change, Planes3& u, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    clear(row_of(turn_, r), cloth_.size);
    area_row(change, *position_, r, turn_);
    area_row(*position_, change, r, turn_);
  }
  share_areas(turn_, worker);
  for (int r = mine.first; r < mine.last; ++r) {
    subtract_change_row(r, u);
    project_row(r, u);
  }
  worker.barrier();
}

void BendingNormals::subtract_row(int row, Planes3& u) {
  const ConstRow3 n = row_of(std::as_const(area_), row);
  const float* rest = cloth_.bending.rest.row(row);
  const Row3 out = row_of(u, row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    const float squared = n.x[c] * n.x[c] + n.y[c] * n.y[c] + n.z[c] * n.z[c];
    const float scale = rest[c] / std::sqrt(squared > min_squared ? squared : min_squared);
    out.x[c] -= scale * n.x[c];
    out.y[c] -= scale * n.y[c];
    out.z[c] -= scale * n.z[c];
  }
}

void BendingNormals::subtract_change_row(int row, Planes3& u) {
  const ConstRow3 n = row_of(std::as_const(area_), row), d = row_of(std::as_const(turn_), row);
  const float* rest = cloth_.bending.rest.row(row);
  const Row3 out = row_of(u, row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    const float found = n.x[c] * n.x[c] + n.y[c] * n.y[c] + n.z[c] * n.z[c];
    const float squared = found > min_squared ? found : min_squared;
    const float scale = rest[c] / std::sqrt(squared);
    const float along = (n.x[c] * d.x[c] + n.y[c] * d.y[c] + n.z[c] * d.z[c]) / squared;
    out.x[c] -= scale * (d.x[c] - along * n.x[c]);
    out.y[c] -= scale * (d.y[c] - along * n.y[c]);
    out.z[c] -= scale * (d.z[c] - along * n.z[c]);
  }
}

void BendingNormals::project_row(int row, const Planes3& u) {
  const ConstRow3 n = row_of(std::as_const(area_), row), v = row_of(u, row);
  const float* rest = cloth_.bending.rest.row(row);
  const Row3 out = row_of(project_, row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    const float found = n.x[c] * n.x[c] + n.y[c] * n.y[c] + n.z[c] * n.z[c];
    const float squared = found > min_squared ? found : min_squared;
    const float scale = rest[c] / std::sqrt(squared);
    const float along = (n.x[c] * v.x[c] + n.y[c] * v.y[c] + n.z[c] * v.z[c]) / squared;
    out.x[c] = scale * (v.x[c] - along * n.x[c]);
    out.y[c] = scale * (v.y[c] - along * n.y[c]);
    out.z[c] = scale * (v.z[c] - along * n.z[c]);
  }
}

/// For one corner of a sample i with edges a and b, q . d(a x b) is da . (b x q) - db . (a x q).
void BendingNormals::add_row(float factor, int row, Planes3& out) const {
  for (const ChartRow& part : rows_.row(row)) add_row_part(factor, row, part, out);
}

void BendingNormals::add_row_part(float factor, int row, const ChartRow& part, Planes3& out) const {
  const Planes3& x = *position_;
  const Row3 sum = row_of(out, row);
  for (const auto& [a, b] : corners) {
    // As the corner's own sample: -(b - a) x q.
    Range columns = columns_with(a, b, row, part);
    if (columns.first < columns.last)
      add_cross(columns, -factor, {seen(x, row, a), seen(x, row, b)}, seen(project_, row), sum);
    // As the end of a: b x q, seen from there.
    const BendingOffset from_a = minus(a), from_b = minus(b);
    columns = columns_with(from_a, plus(from_a, b), row, part);
    if (columns.first < columns.last)
      add_cross(columns, factor, {seen(x, row, from_a), seen(x, row, plus(from_a, b))},
                seen(project_, row, from_a), sum);
    // As the end of b: -(a x q).
    columns = columns_with(from_b, plus(from_b, a), row, part);
    if (columns.first < columns.last)
      add_cross(columns, -factor, {seen(x, row, from_b), seen(x, row, plus(from_b, a))},
                seen(project_, row, from_b), sum);
  }
}

}  // namespace weft
