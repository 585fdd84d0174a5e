#include "weft/cloth/baselines/filtered_integrator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/integrator.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

Moments moments_of(const std::array<double, moment_terms>& t, Vec3f about) {
  return {vec_cast<double>(about),
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
  const Vec3f about = x.at(cloth.size / 2, cloth.size / 2);
  const Range mine = worker.share(cloth.size);
  for (int r = mine.first; r < mine.last; ++r) {
    rows_[r] = {};
    kernels_.moments(cloth.size,
                     {cloth.mass.row(r),
                      cloth.owner.row(r),
                      row_of(x, r),
                      row_of(a, r),
                      {about.x, about.y, about.z}},
                     rows_[r].data());
  }
  worker.barrier();
  std::array<double, moment_terms> total{};
  for (const auto& row : rows_)
    for (int i = 0; i < moment_terms; ++i) total[i] += row[i];
  return moments_of(total, about);
}

ViscousSprings::ViscousSprings(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth), kernels_(filtering_kernels_for(team.instructions())) {
  for (int d = 0; d < spring_directions; ++d)
    stiffness[d] = viscosity[d] = Grid<float>(cloth.size, cloth.size);
}

void ViscousSprings::gather_row(int row, const ClothState& state, Planes3& force) const {
  const Row3 out = row_of(force, row);
  for (float* plane : {out.x, out.y, out.z}) std::fill(plane, plane + cloth_.size, 0.0F);
  const ConstRow3 x = row_of(state.position, row), v = row_of(state.velocity, row);
  for (const NeighbourRow& to : NeighbourRows(cloth_.size, row)) {
    const int d = to.direction, at = to.spring_row, shift = to.spring_shift;
    kernels_.viscous_springs(
        {cloth_.springs[d].rest_length.row(at) + shift, stiffness[d].row(at) + shift,
         viscosity[d].row(at) + shift, x, v,
         shifted(row_of(state.position, to.other_row), to.shift),
         shifted(row_of(state.velocity, to.other_row), to.shift), to.first, to.last},
        out);
  }
}

FilteredIntegrator::FilteredIntegrator(const Cloth& cloth, ThreadTeam& team)
    : cloth_(cloth),
      team_(team),
      kernels_(filtering_kernels_for(team.instructions())),
      springs_(cloth, team),
      acceleration_(cloth.size),
      filtered_(cloth.size),
      next_(rest_state(cloth)),
      sums_(cloth.size, team) {}

void FilteredIntegrator::begin(const StepInput& input, const ClothState& state) noexcept {
  const Stopwatch watch;
  input_ = input;
  renew();
  team_.run([&](Worker& worker) { accelerate(state, worker); });
  report_ = {};
  report_.forces_seconds = watch.seconds();
  const Stopwatch filtering;
  team_.run([&](Worker& worker) {
    filter(acceleration_, filtered_, worker);
    advance(state, worker);
  });
  set_pins(cloth_, state, input_.time_step, next_);
  report_.solve_seconds = filtering.seconds();
}

StepReport FilteredIntegrator::end(ClothState& state) noexcept {
  accept(cloth_, next_, state, team_);
  return report_;
}

std::string FilteredIntegrator::caution() const {
  if (cloth_.material.bending == 0) return {};
  return "this integrator filters springs alone: the material's bending counts for nothing, its "
         "bend_springs do";
}

FilteredIntegrator::Corrections FilteredIntegrator::corrections(const Moments& moments,
                                                                double /*time_step*/) const {
  return {momentum_correction(moments), {}};
}

void FilteredIntegrator::average(Planes3& planes, Worker& worker) const {
  if (cloth_.mates.class_count() == 0) return;
  worker.barrier();
  average_over_mates(cloth_.mates, worker, {&planes.x, &planes.y, &planes.z});
  worker.barrier();
}

void FilteredIntegrator::accelerate(const ClothState& state, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) springs_.gather_row(r, state, acceleration_);
  if (cloth_.mates.class_count() > 0) {
    worker.barrier();
    sum_over_mates(cloth_.mates, worker, {&acceleration_.x, &acceleration_.y, &acceleration_.z});
    worker.barrier();
  }
  for (int r = mine.first; r < mine.last; ++r)
    kernels_.scale(cloth_.size, cloth_.inverse_mass.row(r), row_of(acceleration_, r));
}

void FilteredIntegrator::advance(const ClothState& state, Worker& worker) {
  Corrections add;
  if (cloth_.pins.empty())
    add = corrections(sums_.sum(cloth_, state.position, filtered_, worker), input_.time_step);
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) advance_row(state, add, r);
}

void FilteredIntegrator::advance_row(const ClothState& state, const Corrections& add, int row) {
  const Vec3f centre = vec_cast<float>(add.both.centre), turn = vec_cast<float>(add.both.turn);
  const Vec3f linear = input_.gravity + vec_cast<float>(add.both.linear);
  kernels_.accelerate(cloth_.size,
                      {static_cast<float>(input_.time_step),
                       {linear.x, linear.y, linear.z},
                       {centre.x, centre.y, centre.z},
                       {turn.x, turn.y, turn.z},
                       row_of(state.position, row),
                       row_of(state.velocity, row),
                       row_of(std::as_const(filtered_), row)},
                      row_of(next_.position, row), row_of(next_.velocity, row));
  if (add.position.turn == Vec3d{}) return;
  for (int c = 0; c < cloth_.size; ++c) {
    const Vec3d moved =
        cross(vec_cast<double>(state.position.at(row, c)) - add.position.centre, add.position.turn);
    const double squared_step = input_.time_step * input_.time_step;
    next_.position.set(row, c, next_.position.at(row, c) + vec_cast<float>(squared_step * moved));
  }
}

}  // namespace weft
