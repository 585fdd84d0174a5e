#include "bench/tight_solver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "weft/cloth/bending.h"
#include "weft/cloth/neighbours.h"
#include "weft/core/random.h"
#include "weft/error.h"

namespace weft::bench {
namespace {

double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weft::dot(a[i], b[i]);
  return sum;
}

/// y += factor x
void add(double factor, const Field& x, Field& y) {
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += factor * x[i];
}

double largest(const Field& field) {
  double most = 0;
  for (const Vec3d v : field) most = std::max(most, length(v));
  return most;
}

void write(const Field& field, PaddedVectors& out) {
  const int n = out.rows();
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const Vec3f v = vec_cast<float>(field[r * n + c]);
      out.x(r, c) = v.x;
      out.y(r, c) = v.y;
      out.z(r, c) = v.z;
    }
}

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
  double most = 0;
  for (const Spring& spring : springs_)
    if (spring.stretch)
      most = std::max(most,
                      length(position[spring.to] - position[spring.from]) / spring.rest_length - 1);
  return most;
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

TightSolver::TightSolver(const Cloth& cloth, const TightOptions& options)
    : cloth_(cloth),
      options_(options),
      energy_(cloth),
      kernels_(newton_kernels_for(team_.instructions())),
      springs_(cloth, kernels_),
      multigrid_(cloth, 1, kernels_),
      state_(cloth.size) {
  for (Field* field :
       {&gradient_, &step_, &residual_, &before_, &direction_, &product_, &value_, &trial_})
    field->resize(std::size_t(cloth.size) * cloth.size);
}

/// The cycle is for float: residuals are brought near 1 first.
void TightSolver::precondition(const Field& residual, Field& out) {
  const double size = std::max(largest(residual), 1e-300);
  Field scaled = residual;
  for (Vec3d& v : scaled) v = (1 / size) * v;
  write(scaled, multigrid_.rhs());
  team_.run([&](Worker& worker) { multigrid_.cycle(worker); });
  const PaddedVectors& value = multigrid_.value();
  const int n = cloth_.size;
  for (int s = 0; s < n * n; ++s) {
    const int r = s / n, c = s % n;
    out[s] = energy_.moves(s) ? size * Vec3d{value.x(r, c), value.y(r, c), value.z(r, c)} : Vec3d{};
  }
}

/// The start of the step is where it is now: then all tension counts across springs.
void TightSolver::set_up_preconditioner(const Field& position) {
  write(position, state_.position);
  write(position, state_.start);
  team_.run([&](Worker& worker) {
    for (int r = 0; r < cloth_.size; ++r) springs_.linearise_row(state_, 1, r);
    for (int r = 0; r < cloth_.size; ++r) multigrid_.fill_diagonals(springs_, r);
    multigrid_.set_up(springs_, worker);
  });
}

/// step_ = -A^-1 gradient_. The cycle rounds to float, so directions are made conjugate to the last
/// one with the residual's change. @return false where A is not positive
bool TightSolver::solve() {
  std::fill(step_.begin(), step_.end(), Vec3d{});
  std::fill(direction_.begin(), direction_.end(), Vec3d{});
  for (std::size_t s = 0; s < step_.size(); ++s) residual_[s] = -1.0 * gradient_[s];
  before_ = residual_;
  double slope = 0, first = 0;
  for (int i = 0; i < options_.max_inner; ++i) {
    precondition(residual_, value_);
    const double next = dot(residual_, value_), changed = next - dot(before_, value_);
    if (i == 0) first = next;
    if (!std::isfinite(next)) throw std::runtime_error("the cycle gives no number");
    if (!(next > options_.inner_tolerance * options_.inner_tolerance * first)) return true;
    const double beta = i > 0 ? std::max(0.0, changed / slope) : 0;
    for (std::size_t s = 0; s < step_.size(); ++s) direction_[s] = value_[s] + beta * direction_[s];
    slope = next;
    energy_.product(direction_, product_);
    const double curvature = dot(direction_, product_);
    if (!(curvature > 0)) return false;
    const double length = dot(residual_, direction_) / curvature;
    before_ = residual_;
    add(length, direction_, step_);
    add(-length, product_, residual_);
  }
  return true;
}

/// Without the exact Hessian the last moves shrink by a tenth each where springs are compressed.
void TightSolver::find_step(const Field& position, double last_move) {
  energy_.gradient(position, gradient_);
  set_up_preconditioner(position);
  if (last_move < options_.exact_below) {
    energy_.linearise(position, TightEnergy::Hessian::exact);
    if (solve()) return;
  }
  energy_.linearise(position, TightEnergy::Hessian::positive_part);
  (void)solve();
}

/// Halves step_ until it lowers the energy. @return the largest move of the whole step [m]
double TightSolver::move(Field& position) {
  const double before = energy_.step_energy(position), slope = dot(gradient_, step_);
  double length = 1;
  for (int i = 0; i < 20; ++i, length *= 0.5) {
    trial_ = position;
    add(length, step_, trial_);
    const double rounding = 1e-13 * std::abs(before);
    if (energy_.step_energy(trial_) <= before + 1e-4 * length * slope + rounding) break;
  }
  std::swap(position, trial_);
  return largest(step_);
}

bool TightSolver::step(const StepInput& input, TightState& state) {
  energy_.begin(input, state);
  springs_.set_time_step(input.time_step);
  Field position = state.position;
  add(input.time_step, state.velocity, position);
  double moved = HUGE_VAL;
  for (int i = 0; i < options_.max_newton && moved >= options_.tolerance; ++i) {
    find_step(position, moved);
    moved = move(position);
  }
  for (std::size_t s = 0; s < position.size(); ++s)
    state.velocity[s] = (1 / input.time_step) * (position[s] - state.position[s]);
  state.position = std::move(position);
  return moved < options_.tolerance;
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
