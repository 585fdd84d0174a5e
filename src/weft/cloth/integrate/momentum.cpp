#include "weft/cloth/integrate/momentum.h"

#include <cmath>

namespace weft {
namespace {

Moments row_moments(const Cloth& cloth, const Planes3& x, const Planes3& a, int row) {
  Moments sum;
  for (int c = 0; c < cloth.size; ++c) {
    const double m = double{cloth.mass(row, c)} * cloth.counted(row, c);
    const Vec3d p = vec_cast<double>(x.at(row, c));
    const Vec3d f = m * vec_cast<double>(a.at(row, c));
    sum += {m,
            m * p,
            f,
            cross(p, f),
            m * p.x * p.x,
            m * p.y * p.y,
            m * p.z * p.z,
            m * p.x * p.y,
            m * p.x * p.z,
            m * p.y * p.z};
  }
  return sum;
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
  return {g, (-1 / m.mass) * m.force, solve({yy + zz, -xy, -xz, xx + zz, -yz, xx + yy}, torque)};
}

RigidAcceleration printed_correction(const Moments& m, double time_step, double mass) {
  // (x_G - x) x dT = r x -dT with dT = sum f x x = -(torque about the origin).
  return {(1 / m.mass) * m.first, {}, (time_step / mass) * m.torque};
}

Moments MomentSums::sum(const Cloth& cloth, const Planes3& x, const Planes3& a, Worker& worker) {
  const Range mine = worker.share(cloth.size);
  for (int r = mine.first; r < mine.last; ++r) rows_[r] = row_moments(cloth, x, a, r);
  worker.barrier();
  Moments total;
  for (const Moments& row : rows_) total += row;
  return total;
}

}  // namespace weft
