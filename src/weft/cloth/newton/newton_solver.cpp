#include "weft/cloth/newton/newton_solver.h"

#include <algorithm>
#include <cmath>

#include "weft/core/math.h"

namespace weft {
namespace {

/// Fraction of the tension at the guess that counts as transverse stiffness of springs, without and
/// with contacts.
constexpr float share_in_flight = 0.1F, share_in_contact = 1;
/// Number of solves for a linearisation, with the active contacts updated in between: the smaller
/// unless layers pass a contact that was not active, faster than passing_speed [m/s]. Taken back in
/// the next step, that would shake folded cloth for ever. The half-spaces of bodies are no such
/// reason: over a long step they are right near the guess alone. Seams that close need layers that
/// give way.
constexpr int min_contact_rounds = 2, max_contact_rounds = 4;
constexpr double passing_speed = 0.01;
/// While seams are being sewn panels move fast and meet folded: what few iterations leave would
/// fold them over each other, where closing seams then tear at them.
constexpr int iterations_of_sewing = 2;  // times those of the options

std::vector<const Cloth*> cloths_of(std::span<NewtonPart* const> parts) {
  std::vector<const Cloth*> cloths;
  for (const NewtonPart* part : parts) cloths.push_back(&part->cloth());
  return cloths;
}

}  // namespace

NewtonSolver::NewtonSolver(std::span<NewtonPart* const> parts)
    : parts_(parts.begin(), parts.end()),
      contacts_(cloths_of(parts)),
      sums_(static_cast<int>(parts.size())),
      forces_(parts.size()),
      apart_(parts.size() > 1 && std::all_of(parts.begin(), parts.end(), [](NewtonPart* part) {
               return part->cloth().size < min_shared_size;
             })) {
  for (const NewtonPart* part : parts_) {
    positions_.push_back(&part->position());
    steps_.push_back(&part->step());
    directions_.push_back(&part->direction());
    preconditioned_.push_back(&part->preconditioned());
  }
}

NewtonPart::Contacts NewtonSolver::contacts_of(std::size_t part) const {
  return {contacts_.active() > 0 ? &contacts_.product() : nullptr, part};
}

double NewtonSolver::drift(Worker& worker) {
  const auto flies = [&](std::size_t i) {
    return parts_[i]->cloth().pins.empty() && !contacts_.is_held(i);
  };
  bool all_fly = contacts_.is_shared(), any_flies = false;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    all_fly = all_fly && flies(i);
    any_flies = any_flies || flies(i);
  }
  if (!any_flies || (contacts_.is_shared() && !all_fly)) return 0;
  each(worker, [&](std::size_t i, Worker& own) {
    const Vec3d force = parts_[i]->force(own);
    if (own.rank() == 0) forces_[i] = force;
    own.barrier();
  });
  Vec3d sum;
  for (const Vec3d& force : forces_) sum += force;
  const double h = parts_.front()->input().time_step;
  each(worker, [&](std::size_t i, Worker& own) {
    if (all_fly)
      parts_[i]->drift(h * h / mass_ * sum, own);
    else if (flies(i))
      parts_[i]->drift(h * h / parts_[i]->mass() * forces_[i], own);
  });
  if (all_fly) return 0.5 * h * h / mass_ * squared_length(sum);
  double decrease = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (flies(i)) decrease += 0.5 * h * h / parts_[i]->mass() * squared_length(forces_[i]);
  return decrease;
}

void NewtonSolver::linearise(Worker& worker) {
  const float guessed = contacts_.empty() ? share_in_flight : share_in_contact;
  each(worker, [&](std::size_t i, Worker& own) {
    parts_[i]->clear_step(own);
    parts_[i]->linearise(guessed, own);
    if (!contacts_.empty()) contacts_.hold(i, parts_[i]->diagonal(own), own);
  });
  if (!contacts_.empty()) contacts_.place(positions_, worker);
}

/// Updates the active contacts and their friction, and their forces in the residual.
/// @param stepped  whether a step was made since the linearisation
/// @return whether any contact changed
bool NewtonSolver::choose_contacts(bool stepped, Worker& worker) {
  if (contacts_.empty()) return false;
  const ContactSystem::Fields steps = steps_;
  const bool changed = contacts_.choose(stepped ? &steps : nullptr, worker);
  if (contacts_.product().size() == 0) return changed;
  each(worker, [&](std::size_t i, Worker& own) {
    parts_[i]->add_loads({&contacts_.product(), i}, own);
  });
  return changed;
}

/// Moves along the direction to the minimum of the linearised energy.
void NewtonSolver::descend_direction(Progress& progress, Worker& worker) {
  if (contacts_.active() > 0) contacts_.product().multiply(directions_, worker);
  progress.curvature = total(
      worker, [&](std::size_t i, Worker& own) { return parts_[i]->multiply(contacts_of(i), own); });
  const double length = progress.curvature > 0 ? progress.slope / progress.curvature : 0;
  each(worker, [&](std::size_t i, Worker& own) {
    const double farthest = parts_[i]->advance(length, own);
    if (own.rank() == 0) parts_[i]->correction = farthest / parts_[i]->cloth().rest_spacing;
  });
  progress.promised += 0.5 * length * progress.slope;
  // The energy decrease, as a force on every particle over its weight.
  progress.force = std::sqrt(length * progress.slope / mass_) /
                   (parts_.front()->input().time_step * standard_gravity);
}

/// A cycle of each part, at whose finest levels all parts have the exact product of contacts.
/// @return product . the result [N m]
double NewtonSolver::precondition(bool has_product, Worker& worker) {
  const bool press = contacts_.active() > 0;
  each(worker, [&](std::size_t i, Worker& own) { parts_[i]->begin_cycle(own); });
  if (press) contacts_.product().multiply(preconditioned_, worker);
  each(worker, [&](std::size_t i, Worker& own) { parts_[i]->correct(contacts_of(i), own); });
  if (press) contacts_.product().multiply(preconditioned_, worker);
  return total(worker, [&](std::size_t i, Worker& own) {
    return parts_[i]->end_cycle(contacts_of(i), has_product, own);
  });
}

/// An iteration of conjugate gradients: the preconditioned residual, made conjugate to the last
/// direction, is the next one. The slope is measured along the result, which may be rounding alone.
void NewtonSolver::iterate(Progress& progress, Worker& worker) {
  const bool has_product = progress.curvature > 0;
  double overlap = precondition(has_product, worker);
  if (has_product) overlap /= progress.curvature;
  progress.slope = total(worker, [&](std::size_t i, Worker& own) {
    return parts_[i]->update_direction(overlap, own);
  });
  // The cycle is not symmetric: where the slope is negative, so is the step length.
  if (!std::isfinite(progress.slope)) progress.slope = 0;
  descend_direction(progress, worker);
  ++progress.iterations;
}

void NewtonSolver::solve(const NewtonOptions& options, Progress& progress, Worker& worker) {
  // The first direction is the velocity change of the last step, which moving cloth is likely to
  // repeat.
  progress.curvature = 0;
  progress.slope = total(worker, [&](std::size_t i, Worker& own) {
    return parts_[i]->start_direction(progress.first, own);
  });
  if (progress.first) descend_direction(progress, worker);
  progress.first = false;
  const int most = (sewn_ ? iterations_of_sewing : 1) * options.max_iterations;
  for (int i = 0; i < most; ++i) {
    iterate(progress, worker);
    if (progress.force < options.tolerance) break;
  }
}

void NewtonSolver::move_state(float length, Worker& worker) {
  each(worker, [&](std::size_t i, Worker& own) { parts_[i]->move_state(length, own); });
}

void NewtonSolver::advance(const NewtonOptions& options, Progress& progress, Worker& worker) {
  linearise(worker);
  choose_contacts(false, worker);
  progress.inner = inner_energy(worker);
  if (is_pulled_unlike() && !contacts_.empty())
    progress.contacts = contacts_.energy(steps_, 0, worker);
  progress.promised = drift(worker);
  for (int round = 1;; ++round) {
    each(worker, [&](std::size_t i, Worker& own) { parts_[i]->set_up(contacts_of(i), own); });
    solve(options, progress, worker);
    if (contacts_.empty() || round == (sewn_ ? min_contact_rounds : max_contact_rounds)) break;
    if (round >= min_contact_rounds && !contacts_.any_layer_passed(steps_, passing_speed, worker))
      break;
    if (!choose_contacts(true, worker)) break;
  }
  // Removes the net force that the iterations left, so that few of them lose no momentum.
  progress.promised += drift(worker);
  each(worker, [&](std::size_t i, Worker& own) { parts_[i]->clear_pins(own); });
  move_state(1, worker);
}

void NewtonSolver::run(std::span<const std::span<const Contact>> own,
                       std::span<const SharedContact> shared, const NewtonOptions& options,
                       ThreadTeam& team) {
  own_.clear();
  mass_ = lent_ = 0;
  bool first = true;
  pulled_ = sewn_ = false;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    own_.push_back({own[i], &parts_[i]->start(), &parts_[i]->history});
    mass_ += parts_[i]->mass();
    lent_ += parts_[i]->lent;
    first = first && parts_[i]->iterations == 0;
    pulled_ = pulled_ || parts_[i]->is_pulled();
    sewn_ = sewn_ || parts_[i]->cloth().apart.has_value();
  }
  carried_ = common_pin_step();
  contacts_.set_contacts(own_, shared, parts_.front()->input());
  team.run([&](Worker& worker) {
    each(worker, [&](std::size_t i, Worker& one) { parts_[i]->read_state(one); });
    Progress progress;
    progress.first = first;
    descend(options, progress, worker);
    if (!contacts_.empty()) contacts_.measure(positions_, worker);
    each(worker, [&](std::size_t i, Worker& one) {
      parts_[i]->write_state(one);
      if (one.rank() == 0) parts_[i]->iterations += progress.iterations;
    });
  });
  // One system tells for all: what parts told of when they were last solved alone is past.
  for (const auto& part : parts_) part->missed = 0;
  parts_.front()->missed = missed_;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::span<const float> forces = contacts_.forces(i);
    parts_[i]->contact_forces.assign(forces.begin(), forces.end());
    parts_[i]->history.start_step();
    contacts_.remember(i, parts_[i]->history);
  }
}

}  // namespace weft
