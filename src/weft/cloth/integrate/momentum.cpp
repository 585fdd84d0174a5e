#include "weft/cloth/integrate/momentum.h"

#include <array>
#include <cmath>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

constexpr int lanes = 8;
/// Mass; first moments; force; torque; second moments.
constexpr int terms = 16;
using Lanes = std::array<std::array<float, lanes>, terms>;

struct MomentRow {
  const float *mass, *counted;
  ConstRow3 x, a;
  Vec3f about;
};

/// Adds the columns first .. first + count - 1, each to its lane.
inline void add_columns(const MomentRow& row, int first, int count, Lanes& s) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const int c = first + i;
    const float m = row.mass[c] * row.counted[c];
    const float x = row.x.x[c] - row.about.x, y = row.x.y[c] - row.about.y;
    const float z = row.x.z[c] - row.about.z;
    const float mx = m * x, my = m * y, mz = m * z;
    const float fx = m * row.a.x[c], fy = m * row.a.y[c], fz = m * row.a.z[c];
    s[0][i] += m;
    s[1][i] += mx;
    s[2][i] += my;
    s[3][i] += mz;
    s[4][i] += fx;
    s[5][i] += fy;
    s[6][i] += fz;
    s[7][i] += y * fz - z * fy;
    s[8][i] += z * fx - x * fz;
    s[9][i] += x * fy - y * fx;
    s[10][i] += mx * x;
    s[11][i] += my * y;
    s[12][i] += mz * z;
    s[13][i] += mx * y;
    s[14][i] += mx * z;
    s[15][i] += my * z;
  }
}

Moments row_moments(const MomentRow& row, int columns) {
  Lanes lane_sums{};
  int c = 0;
  for (; c + lanes <= columns; c += lanes) add_columns(row, c, lanes, lane_sums);
  add_columns(row, c, columns - c, lane_sums);
  std::array<double, terms> t{};
  for (int i = 0; i < terms; ++i)
    for (const float lane : lane_sums[i]) t[i] += lane;
  return {{},
          t[0],
          {t[1], t[2], t[3]},
          {t[4], t[5], t[6]},
          {t[7], t[8], t[9]},
          t[10],
          t[11],
          t[12],
          t[13],
          t[14],
          t[15]};
}

struct Symmetric {
  double xx, xy, xz, yy, yz, zz;
};

/// The solution of s w = b; zero when s is singular to working accuracy (all mass on one line).
Vec3d solve(const Symmetric& s, Vec3d b) {
  const Vec3d r0{s.xx, s.xy, s.xz}, r1{s.xy, s.yy, s.yz}, r2{s.xz, s.yz, s.zz};
  const Vec3d c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
  const double determinant = dot(r0, c0);
  const double trace = s.xx + s.yy + s.zz;
  if (!(std::abs(determinant) > 1e-12 * trace * trace * trace)) return {};
  return (1 / determinant) * (b.x * c0 + b.y * c1 + b.z * c2);
}

}  // namespace

Moments& operator+=(Moments& a, const Moments& b) {
  a.mass += b.mass;
  a.first += b.first;
  a.force += b.force;
  a.torque += b.torque;
  a.xx += b.xx;
  a.yy += b.yy;
  a.zz += b.zz;
  a.xy += b.xy;
  a.xz += b.xz;
  a.yz += b.yz;
  return a;
}

RigidAcceleration momentum_correction(const Moments& m) {
  const Vec3d g = (1 / m.mass) * m.first;
  const Vec3d torque = m.torque - cross(g, m.force);
  const double xx = m.xx - m.mass * g.x * g.x, yy = m.yy - m.mass * g.y * g.y;
  const double zz = m.zz - m.mass * g.z * g.z, xy = m.xy - m.mass * g.x * g.y;
  const double xz = m.xz - m.mass * g.x * g.z, yz = m.yz - m.mass * g.y * g.z;
  return {m.about + g, (-1 / m.mass) * m.force,
          solve({yy + zz, -xy, -xz, xx + zz, -yz, xx + yy}, torque)};
}

RigidAcceleration printed_correction(const Moments& m, double time_step, double mass) {
  // (x_G - x) x dT = r x -dT with dT = sum f x x = -(torque about the origin).
  const Vec3d torque = m.torque + cross(m.about, m.force);
  return {m.about + (1 / m.mass) * m.first, {}, (time_step / mass) * torque};
}

Moments MomentSums::sum(const Cloth& cloth, const Planes3& x, const Planes3& a, Worker& worker) {
  const Range mine = worker.share(cloth.size);
  const Vec3f about = x.at(cloth.size / 2, cloth.size / 2);
  for (int r = mine.first; r < mine.last; ++r)
    rows_[r] = row_moments(
        {cloth.mass.row(r), cloth.counted.row(r), row_of(x, r), row_of(a, r), about}, cloth.size);
  worker.barrier();
  Moments total;
  total.about = vec_cast<double>(about);
  for (const Moments& row : rows_) total += row;
  return total;
}

}  // namespace weft
