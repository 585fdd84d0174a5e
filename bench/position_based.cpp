#include "bench/position_based.h"

#include <cmath>

#include "weft/cloth/neighbours.h"

namespace weft::bench {
namespace {

/// Coordinates, where they began and the inverse mass: what a stream holds of each particle.
constexpr int fields = 7;
constexpr float min_length = 1e-12F;

}  // namespace

/// A run of particles.
struct PositionBased::Line {
  float *x, *y, *z;
  const float *x0, *y0, *z0, *w;
};

/// A run of springs, every `stride`-th of a row.
struct PositionBased::Springs {
  const float *rest, *compliance, *lag;
  int stride;
};

namespace {

/// Springs from particle i of one line to particle i of another that shares none with it.
template <class Line, class Springs>
void project(int count, const Springs& springs, const Line& a, const Line& b) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const float rest = springs.rest[i * springs.stride];
    const float alpha = springs.compliance[i * springs.stride];
    const float lag = springs.lag[i * springs.stride];
    const float dx = b.x[i] - a.x[i], dy = b.y[i] - a.y[i], dz = b.z[i] - a.z[i];
    const float length = std::sqrt(dx * dx + dy * dy + dz * dz) + min_length;
    // How far the step has drawn the ends apart along the spring: damping takes from it.
    const float drawn = (dx * (dx - (b.x0[i] - a.x0[i])) + dy * (dy - (b.y0[i] - a.y0[i])) +
                         dz * (dz - (b.z0[i] - a.z0[i]))) /
                        length;
    const float pull =
        (length - rest + lag * drawn) / (((1 + lag) * (a.w[i] + b.w[i]) + alpha) * length);
    const float to_a = a.w[i] * pull, to_b = b.w[i] * pull;
    a.x[i] += to_a * dx;
    a.y[i] += to_a * dy;
    a.z[i] += to_a * dz;
    b.x[i] -= to_b * dx;
    b.y[i] -= to_b * dy;
    b.z[i] -= to_b * dz;
  }
}

}  // namespace

PositionBased::PositionBased(const Cloth& cloth, double step_seconds)
    : cloth_(cloth),
      h_(static_cast<float>(step_seconds)),
      start_(cloth.size),
      streams_(static_cast<std::size_t>(fields * 4),
               std::vector<float>(static_cast<std::size_t>(cloth.size))) {
  const int n = cloth.size;
  for (const SpringPlane& plane : cloth.springs) {
    compliance_.emplace_back(n, n);
    lag_.emplace_back(n, n);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        const float k = plane.stiffness(r, c);
        if (k <= 0) continue;
        compliance_.back()(r, c) = 1 / (k * h_ * h_);
        lag_.back()(r, c) = plane.damping(r, c) / (k * h_);
      }
  }
}

PositionBased::Line PositionBased::line(Planes3& position, int row, int first) const {
  return {position.x.row(row) + first,         position.y.row(row) + first,
          position.z.row(row) + first,         start_.x.row(row) + first,
          start_.y.row(row) + first,           start_.z.row(row) + first,
          cloth_.inverse_mass.row(row) + first};
}

void PositionBased::fall(Vec3f gravity, ClothState& state) {
  start_ = state.position;
  for (int r = 0; r < cloth_.size; ++r) {
    const float* w = cloth_.inverse_mass.row(r);
    const Row3 x = row_of(state.position, r), v = row_of(state.velocity, r);
#pragma omp simd
    for (int c = 0; c < cloth_.size; ++c) {
      const float free = w[c] > 0 ? h_ : 0;
      x.x[c] += free * (v.x[c] + h_ * gravity.x);
      x.y[c] += free * (v.y[c] + h_ * gravity.y);
      x.z[c] += free * (v.z[c] + h_ * gravity.z);
    }
  }
}

/// Springs to another row: those that start from every second row (or pair of rows) share nothing.
void PositionBased::project_down(int direction, Planes3& position) {
  const SpringPlane& plane = cloth_.springs[direction];
  const int n = cloth_.size, down = plane.down, right = plane.right;
  const int first = right < 0 ? -right : 0, count = n - std::abs(right);
  for (int colour = 0; colour < 2; ++colour)
    for (int r = 0; r + down < n; ++r) {
      if (r / down % 2 != colour) continue;
      const Springs springs{plane.rest_length.row(r) + first, compliance_[direction].row(r) + first,
                            lag_[direction].row(r) + first, 1};
      project(count, springs, line(position, r, first), line(position, r + down, first + right));
    }
}

/// Springs within a row: streams of every second (or fourth) column, joined to each other in turn.
void PositionBased::project_along(int direction, Planes3& position) {
  const SpringPlane& plane = cloth_.springs[direction];
  const int n = cloth_.size, reach = plane.right, count = 2 * reach;
  const auto stream = [&](int k, int first) {
    const auto at = [&](int field) { return streams_[fields * k + field].data() + first; };
    return Line{at(0), at(1), at(2), at(3), at(4), at(5), at(6)};
  };
  for (int r = 0; r < n; ++r) {
    const Line row = line(position, r, 0);
    const float* from[fields] = {row.x, row.y, row.z, row.x0, row.y0, row.z0, row.w};
    for (int field = 0; field < fields; ++field)
      for (int k = 0; k < count; ++k)
        for (int c = k, i = 0; c < n; c += count, ++i)
          streams_[fields * k + field][i] = from[field][c];
    for (int k = 0; k < count; ++k) {
      if (k + reach >= n || k >= n) continue;
      const int other = (k + reach) % count;
      const Springs springs{plane.rest_length.row(r) + k, compliance_[direction].row(r) + k,
                            lag_[direction].row(r) + k, count};
      project((n - reach - k + count - 1) / count, springs, stream(k, 0),
              stream(other, k + reach >= count ? 1 : 0));
    }
    float* to[3] = {row.x, row.y, row.z};
    for (int field = 0; field < 3; ++field)
      for (int k = 0; k < count; ++k)
        for (int c = k, i = 0; c < n; c += count, ++i)
          to[field][c] = streams_[fields * k + field][i];
  }
}

void PositionBased::turn_into_velocity(ClothState& state) const {
  const float per_step = 1 / h_;
  const auto divide = [&](const Grid<float>& now, const Grid<float>& before, Grid<float>& out) {
    for (int r = 0; r < cloth_.size; ++r)
      for (int c = 0; c < cloth_.size; ++c)
        out.row(r)[c] = per_step * (now.row(r)[c] - before.row(r)[c]);
  };
  divide(state.position.x, start_.x, state.velocity.x);
  divide(state.position.y, start_.y, state.velocity.y);
  divide(state.position.z, start_.z, state.velocity.z);
}

void PositionBased::step(Vec3f gravity, ClothState& state) {
  fall(gravity, state);
  for (int d = 0; d < spring_directions; ++d) {
    if (d >= bend_u && cloth_.material.bend_springs <= 0) continue;
    if (cloth_.springs[d].down > 0)
      project_down(d, state.position);
    else
      project_along(d, state.position);
  }
  turn_into_velocity(state);
}

}  // namespace weft::bench
