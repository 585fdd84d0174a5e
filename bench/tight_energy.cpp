#include "bench/tight_energy.h"

#include <cmath>

#include "weft/cloth/bending.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/strain_stiffening.h"
#include "weft/core/random.h"
#include "weft/error.h"

namespace weft::bench {
namespace {

Field field_of(const Planes3& planes) {
  Field field;
  for (int s = 0; s < planes.size() * planes.size(); ++s)
    field.push_back(vec_cast<double>(planes.at(s)));
  return field;
}

}  // namespace

TightState tight_state(const ClothState& state) {
  return {field_of(state.position), field_of(state.velocity)};
}

TightEnergy::TightEnergy(const Cloth& cloth) : curved_(std::size_t(cloth.size) * cloth.size) {
  if (cloth.mates.class_count() > 0 || cloth.bending.curved)
    throw SceneError("cloth", "seams or a curved rest shape", "a flat sheet");
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    mass_.push_back(cloth.mass(s / cloth.size, s % cloth.size));
    moves_.push_back(cloth.inverse_mass(s / cloth.size, s % cloth.size) > 0 ? 1 : 0);
    total_mass_ += mass_.back();
  }
  add_springs(cloth);
  add_bending(cloth);
}

void TightEnergy::add_springs(const Cloth& cloth) {
  const int n = cloth.size;
  const double limit = cloth.material.strain_limit;
  for (int d = 0; d < spring_directions; ++d) {
    const SpringPlane& plane = cloth.springs[d];
    for (int r = 0; r + plane.down < n; ++r)
      for (int c = std::max(0, -plane.right); c + std::max(0, plane.right) < n; ++c) {
        if (plane.stiffness(r, c) == 0) continue;
        Spring spring{r * n + c, (r + plane.down) * n + c + plane.right, plane.rest_length(r, c),
                      plane.stiffness(r, c), plane.damping(r, c)};
        spring.stretch = d <= stretch_v;
        if (limit > 0 && spring.stretch) spring.limit_length = (1 + limit) * spring.rest_length;
        springs_.push_back(spring);
      }
  }
}

void TightEnergy::add_bending(const Cloth& cloth) {
  const int n = cloth.size;
  if (!cloth.bending.active) return;
  for (int k = 0; k < bending_neighbours; ++k)
    for (int s = 0; s < n * n; ++s) {
      const int r = s / n + bending_offsets[k].down, c = s % n + bending_offsets[k].right;
      const double weight = cloth.bending.weight[k](s / n, s % n);
      if (weight != 0 && r >= 0 && r < n && c >= 0 && c < n)
        curvatures_.push_back({s, r * n + c, weight});
    }
  const BorderBending& border = cloth.bending.border;
  for (int r = 0; r + 1 < static_cast<int>(border.starts.size()); ++r)
    for (int i = border.starts[r]; i < border.starts[r + 1]; ++i) {
      const BorderBending::Edge& edge = border.edges[i];
      edges_.push_back({r * n + edge.col, edge.other_row * n + edge.other_col, edge.stiffness});
    }
}

double TightEnergy::tension(const Spring& spring, double length) const {
  const double over = spring.limit_length > 0 ? std::max(0.0, length - spring.limit_length) : 0;
  return spring.stiffness * (length - spring.rest_length + strain_limit_factor * over) +
         spring.damping / step_ * (length - spring.length_before);
}

double TightEnergy::spring_energy(const Field& position, bool with_damping) const {
  double energy = 0;
  for (const Spring& spring : springs_) {
    const double l = length(position[spring.to] - position[spring.from]);
    const double elongation = l - spring.rest_length;
    const double over = spring.limit_length > 0 ? std::max(0.0, l - spring.limit_length) : 0;
    energy +=
        0.5 * spring.stiffness * (elongation * elongation + strain_limit_factor * over * over);
    const double change = l - spring.length_before;
    if (with_damping) energy += 0.5 * spring.damping / step_ * change * change;
  }
  return energy;
}

double TightEnergy::bending_energy(const Field& position) const {
  std::fill(curved_.begin(), curved_.end(), Vec3d{});
  for (const Curvature& k : curvatures_)
    curved_[k.from] += k.weight * (position[k.to] - position[k.from]);
  double energy = 0.5 * dot(curved_, curved_);
  // Every edge is there from both of its ends.
  for (const Edge& edge : edges_)
    energy += 0.25 * edge.stiffness * squared_length(position[edge.to] - position[edge.from]);
  return energy;
}

/// out += M^T M x, and what border edges add: gradient and product alike, as it is quadratic.
void TightEnergy::add_bending_product(const Field& x, Field& out) const {
  std::fill(curved_.begin(), curved_.end(), Vec3d{});
  for (const Curvature& k : curvatures_) curved_[k.from] += k.weight * (x[k.to] - x[k.from]);
  for (const Curvature& k : curvatures_) {
    const Vec3d pull = k.weight * curved_[k.from];
    out[k.to] += pull;
    out[k.from] -= pull;
  }
  for (const Edge& edge : edges_) out[edge.from] += edge.stiffness * (x[edge.from] - x[edge.to]);
}

double TightEnergy::elastic(const Field& position) const {
  return spring_energy(position, false) + bending_energy(position);
}

double TightEnergy::largest_strain(const Field& position) const {
  double max = 0;
  for (const Spring& spring : springs_)
    if (spring.stretch)
      max = std::max(max,
                     length(position[spring.to] - position[spring.from]) / spring.rest_length - 1);
  return max;
}

void TightEnergy::begin(const StepInput& input, const TightState& start) {
  step_ = input.time_step;
  wanted_ = start.position;
  const Vec3d fall = step_ * step_ * vec_cast<double>(input.gravity);
  for (std::size_t s = 0; s < wanted_.size(); ++s)
    if (moves_[s]) wanted_[s] += step_ * start.velocity[s] + fall;
  for (Spring& spring : springs_)
    spring.length_before = length(start.position[spring.to] - start.position[spring.from]);
}

double TightEnergy::step_energy(const Field& position) const {
  double inertia = 0;
  for (std::size_t s = 0; s < mass_.size(); ++s)
    inertia += mass_[s] * squared_length(position[s] - wanted_[s]);
  return inertia / (2 * step_ * step_) + spring_energy(position, true) + bending_energy(position);
}

void TightEnergy::clear_pins(Field& field) const {
  for (std::size_t s = 0; s < moves_.size(); ++s)
    if (!moves_[s]) field[s] = {};
}

void TightEnergy::gradient(const Field& position, Field& out) const {
  for (std::size_t s = 0; s < mass_.size(); ++s)
    out[s] = mass_[s] / (step_ * step_) * (position[s] - wanted_[s]);
  for (const Spring& spring : springs_) {
    const Vec3d between = position[spring.to] - position[spring.from];
    const double l = length(between);
    const Vec3d pull = tension(spring, l) / l * between;
    out[spring.from] -= pull;
    out[spring.to] += pull;
  }
  add_bending_product(position, out);
  clear_pins(out);
}

void TightEnergy::linearise(const Field& position, Hessian hessian) {
  for (Spring& spring : springs_) {
    const Vec3d between = position[spring.to] - position[spring.from];
    const double l = length(between);
    const bool over = spring.limit_length > 0 && l > spring.limit_length;
    const double axial =
        spring.stiffness * (over ? 1 + strain_limit_factor : 1) + spring.damping / step_;
    spring.across = tension(spring, l) / l;
    if (hessian == Hessian::positive_part) spring.across = std::max(0.0, spring.across);
    spring.along = std::sqrt(std::max(0.0, axial - spring.across)) / l * between;
  }
}

void TightEnergy::product(const Field& x, Field& out) const {
  for (std::size_t s = 0; s < mass_.size(); ++s) out[s] = mass_[s] / (step_ * step_) * x[s];
  for (const Spring& spring : springs_) {
    const Vec3d between = x[spring.to] - x[spring.from];
    const Vec3d pull = spring.across * between + weft::dot(spring.along, between) * spring.along;
    out[spring.from] -= pull;
    out[spring.to] += pull;
  }
  add_bending_product(x, out);
  clear_pins(out);
}

namespace {

/// A small sheet, pulled longer than its limit in one direction and shaken.
Planes3 small_sheet(int n) {
  Planes3 rest(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      rest.set(r, c, {static_cast<float>(c) / (n - 1), 0, static_cast<float>(r) / (n - 1)});
  return rest;
}

Field shaken(const Field& field, double stretch, double amount) {
  Random random(7);
  Field out;
  const auto some = [&] { return random.uniform(-amount, amount); };
  for (const Vec3d v : field) out.push_back(stretch * v + Vec3d{some(), some(), some()});
  return out;
}

/// (g(x + d) - g(x - d)) / 2, to be compared with A d.
Field gradient_change(const TightEnergy& energy, const Field& at, const Field& by) {
  Field ahead = at, behind = at, there(at.size()), back(at.size());
  add(1, by, ahead);
  add(-1, by, behind);
  energy.gradient(ahead, there);
  energy.gradient(behind, back);
  add(-1, back, there);
  for (Vec3d& v : there) v = 0.5 * v;
  return there;
}

}  // namespace

DerivativeErrors check_derivatives() {
  constexpr int n = 7;
  constexpr double h = 1.0 / 240, small = 1e-7;
  const Material material{.density = 0.2,
                          .stretch = {300, 200},
                          .shear = 50,
                          .bending = {1e-3, 5e-4},
                          .bend_springs = 3,
                          .damping = 2,
                          .strain_limit = 0.35};
  Cloth cloth = make_cloth(small_sheet(n), {n, {}}, material);
  pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
  TightEnergy energy(cloth);
  const TightState start = tight_state(rest_state(cloth, {1, 2, 3}));
  energy.begin({.time_step = h}, start);
  const Field at = shaken(start.position, 1.4, 0.01);
  Field gradient(at.size()), product(at.size());
  energy.gradient(at, gradient);
  energy.linearise(at, TightEnergy::Hessian::exact);
  DerivativeErrors errors;
  for (std::size_t s = 0; s < at.size(); ++s)
    for (double Vec3d::*part : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      Field ahead = at, behind = at;
      ahead[s].*part += 1e-5;
      behind[s].*part -= 1e-5;
      const double wanted = energy.moves(static_cast<int>(s))
                                ? (energy.step_energy(ahead) - energy.step_energy(behind)) / 2e-5
                                : 0;
      errors.gradient = std::max(errors.gradient, std::abs(gradient[s].*part - wanted));
    }
  errors.gradient /= largest(gradient);
  Field by = shaken(Field(at.size()), 1, small);
  by[0] = {};  // pinned
  energy.product(by, product);
  Field wanted = gradient_change(energy, at, by);
  const double size = largest(wanted);
  add(-1, product, wanted);
  errors.product = largest(wanted) / size;
  return errors;
}

}  // namespace weft::bench
