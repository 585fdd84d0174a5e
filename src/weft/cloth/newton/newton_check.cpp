#include <algorithm>
#include <cmath>

#include "weft/cloth/newton/newton_solver.h"
#include "weft/core/math.h"

// The check of a step's energy, and the force of the pins.
namespace weft {
namespace {

/// Energy gain of a step over its kinetic energy, up to which the gain is taken out of the
/// velocities. A larger gain leads to another linearisation.
constexpr double harmless_gain = 0.02;
/// The same over the energy that contacts lend.
constexpr double harmless_part = 0.25;
/// Energy over m g times the side length that rounding may seem to add in a step in which nothing
/// is touched: positions are rounded to 2^-24 of them. Losses by rounding are not given back: were
/// such gains taken out, small swings would be slowed, and stopped where they turn.
constexpr double rounding_part = 0x1p-24;
/// Steps are linearised again until particles end within this part of the cloth's length from where
/// the energy is least: one linearisation holds small, stiff cloth back that swings round. In steps
/// longer than long_step [s] the error is larger, and less of it is good. Where something is
/// touched, contacts that change between the linearisations err by more.
constexpr double good_part = 1e-4, good_part_if_long = 3e-5, good_part_in_contact = 8e-4,
                 long_step = 1.0 / 220;
/// Largest number of linearisations in a run, and of halvings of a step that raises the energy.
constexpr int max_linearisations = 4, max_halvings = 5;

}  // namespace

double NewtonSolver::rounding() const {
  double energy = 0;
  for (const NewtonPart* part : parts_)
    energy += rounding_part * part->total_mass() * standard_gravity * part->side_length();
  return energy;
}

double NewtonSolver::inner_energy(Worker& worker) {
  return total(worker, [&](std::size_t i, Worker& own) { return parts_[i]->step_energy(own); });
}

double NewtonSolver::energy(float length, Worker& worker) {
  return inner_energy(worker) + (contacts_.empty() ? 0 : contacts_.energy(steps_, length, worker));
}

/// Halves the last step until it lowers the energy. @return whether it had to
bool NewtonSolver::shorten_step(Worker& worker) {
  double after = energy(1, worker);
  move_state(-1, worker);
  const double before = energy(0, worker);
  float length = 1;
  move_state(length, worker);
  for (int i = 0; after > before && i < max_halvings; ++i) {
    length *= 0.5F;
    move_state(-length, worker);
    after = energy(length, worker);
  }
  each(worker, [&](std::size_t i, Worker& own) { parts_[i]->scale_step(length, own); });
  return length < 1;
}

std::optional<Vec3d> NewtonSolver::common_pin_step() const {
  if (!pulled_) return std::nullopt;
  std::optional<Vec3d> common;
  for (const NewtonPart* part : parts_) {
    if (part->cloth().pins.empty()) continue;
    if (!part->pin_step()) return std::nullopt;
    if (!common) common = part->pin_step();
    if (length(*part->pin_step() - *common) > NewtonPart::same_displacement) return std::nullopt;
  }
  return common;
}

Vec3d NewtonSolver::pin_velocity() const {
  return (1 / parts_.front()->input().time_step) * *carried_;
}

/// The energy that the cloths gained for an observer who moves with the pins: there they do no
/// work, but obstacles that stand still do.
double NewtonSolver::gained_beside_pins(double known, Worker& worker) {
  const Vec3d gravity = vec_cast<double>(parts_.front()->input().gravity);
  const double now = total(worker, [&](std::size_t i, Worker& own) {
    return parts_[i]->potential(own) + parts_[i]->kinetic_beside(pin_velocity(), own) +
           parts_[i]->total_mass() * dot(gravity, *carried_);
  });
  if (contacts_.active() == 0) return now - known;
  const double work = contacts_.work(steps_, worker);
  return now - known - work + dot(contacts_.obstacle_force(steps_, worker), *carried_);
}

/// The energy that the cloths gained, less the work of moving obstacles. The work of pins that move
/// differently is not known: with those, the shortfall of the energy decrease below that of the
/// linearisation.
double NewtonSolver::error_of(const Progress& progress, double known, Worker& worker) {
  if (is_pulled_unlike())
    return energy(1, worker) - progress.inner - progress.contacts + progress.promised;
  if (carried_) return gained_beside_pins(known, worker);
  const double now = total(worker, [&](std::size_t i, Worker& own) {
    return parts_[i]->potential(own) + parts_[i]->kinetic(own);
  });
  return now - known - (contacts_.active() > 0 ? contacts_.work(steps_, worker) : 0);
}

double NewtonSolver::good_way() const {
  double length = HUGE_VAL;
  for (const NewtonPart* part : parts_) length = std::min(length, part->side_length());
  if (!contacts_.empty()) return good_part_in_contact * length;
  const bool is_long = parts_.front()->input().time_step > long_step;
  return (is_long ? good_part_if_long : good_part) * length;
}

/// How far particles are from the end of the step, as their inertia takes the energy by which the
/// linearisation of the cloths was wrong [m]. What contacts do is linear between two choices.
double NewtonSolver::missed_way(const Progress& progress, Worker& worker) {
  const double pressed = contacts_.empty() ? 0 : contacts_.work_on_cloths(steps_, worker);
  const double missed =
      std::abs(inner_energy(worker) - progress.inner + progress.promised - pressed);
  return parts_.front()->input().time_step * std::sqrt(2 * missed / mass_);
}

/// One linearisation is enough for smooth motion. It is repeated where its energy error is large,
/// as after an impact, and where it ends far from the least energy.
void NewtonSolver::descend(const NewtonOptions& options, Progress& progress, Worker& worker) {
  const double kinetic = total(worker, [&](std::size_t i, Worker& own) {
    return carried_ ? parts_[i]->start_kinetic_beside(pin_velocity(), own)
                    : parts_[i]->start_kinetic(own);
  });
  double known = 0;
  if (!is_pulled_unlike())
    known = kinetic + total(worker, [&](std::size_t i, Worker& own) {
              return parts_[i]->start_potential(own);
            });
  const StepInput& input = parts_.front()->input();
  const double fall = input.time_step * length(input.gravity);
  const double lent = contacts_.empty() ? 0 : lent_;
  const double allowed =
      harmless_gain * (kinetic + 0.5 * mass_ * fall * fall) + harmless_part * lent;
  double error = HUGE_VAL;
  bool again = true;
  for (int i = 0; i < max_linearisations && (error > allowed || again); ++i) {
    advance(options, progress, worker);
    error = error_of(progress, known, worker);
    if (error > allowed && shorten_step(worker)) error = error_of(progress, known, worker);
    again = missed_way(progress, worker) > good_way();
  }
  double left = 0;
  if (is_pulled_unlike())
    each(worker, [&](std::size_t i, Worker& own) { parts_[i]->forget_potential(own); });
  else if (error > (contacts_.empty() ? rounding() : lent))
    left = calm(error - lent, worker);
  if (worker.rank() == 0) missed_ = error > allowed ? error : left;
}

double NewtonSolver::calm(double excess, Worker& worker) {
  const double inner =
      total(worker, [&](std::size_t i, Worker& own) { return parts_[i]->inner_kinetic(own); });
  const double left = inner > excess ? std::sqrt((inner - excess) / inner) : 0;
  each(worker, [&](std::size_t i, Worker& own) { parts_[i]->calm(left, own); });
  return std::max(0.0, excess - inner);
}

}  // namespace weft
