#include "weft/cloth/newton/newton_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "weft/cloth/integrate/proposal.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Energy that a step gains, over its kinetic energy: less is taken out of velocities, more asks
/// for another linearisation.
constexpr double harmless_gain = 0.02;
/// And the part of what contacts lend that asks for one.
constexpr double harmless_part = 0.25;
/// How often a run linearises, and how often it halves a step that leads up.
constexpr int most_linearisations = 4, most_among_moving = 2, most_halvings = 5;
/// Of the tension at the guess that is stiffness across springs.
constexpr float share_in_flight = 0.1F, share_in_contact = 1;
/// How often a run finds out which contacts press.
constexpr int most_contact_rounds = 2;

bool same_row(ConstRow3 a, ConstRow3 b, int n) {
  const auto same = [n](const float* p, const float* q) {
    return std::memcmp(p, q, static_cast<std::size_t>(n) * sizeof(float)) == 0;
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

/// a + factor b
void add_row(int n, ConstRow3 a, float factor, ConstRow3 b, Row3 out) {
  for (int c = 0; c < n; ++c) {
    out.x[c] = a.x[c] + factor * b.x[c];
    out.y[c] = a.y[c] + factor * b.y[c];
    out.z[c] = a.z[c] + factor * b.z[c];
  }
}

}  // namespace

NewtonSolver::NewtonSolver(const Cloth& cloth, ThreadTeam& team)
    : cloth_(cloth),
      team_(team),
      kernels_(newton_kernels_for(team.instructions())),
      springs_(cloth, kernels_),
      multigrid_(cloth, team.size(), kernels_),
      curved_(cloth, team.instructions()),
      contacts_(cloth),
      start_(rest_state(cloth)),
      next_(rest_state(cloth)),
      state_(cloth.size),
      plain_(curved_.active() ? Planes3(cloth.size) : Planes3()),
      wanted_(cloth.size, cloth.size),
      step_(cloth.size, cloth.size),
      direction_(cloth.size, cloth.size),
      product_(cloth.size, cloth.size),
      residual_(multigrid_.rhs()),
      share_(cloth.size, cloth.size),
      own_mass_(cloth.size, cloth.size),
      contact_blocks_(cloth.size, cloth.size),
      contact_rows_(static_cast<std::size_t>(cloth.size)),
      sums_(cloth.size),
      row_parts_(static_cast<std::size_t>(cloth.size)),
      known_rows_(static_cast<std::size_t>(cloth.size)),
      largest_(static_cast<std::size_t>(cloth.size)) {
  for (int r = 0; r < cloth.size; ++r) std::fill_n(share_.row(r), cloth.size, 1.0F);
  team_.run([&](Worker& worker) {
    if (worker.rank() == 0) multigrid_.seams().share(Workers(worker, true), {&share_});
  });
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) own_mass_(r, c) = share_(r, c) * cloth.mass(r, c);
  find_mass();
}

/// Takes a row of the state at the start, and flies on from it.
void NewtonSolver::begin_row(const ClothState& state, bool go_on, int row) {
  const int n = cloth_.size;
  const auto h = static_cast<float>(input_.time_step);
  const ConstRow3 x = row_of(state.position, row), v = row_of(state.velocity, row);
  // What the last step changed is where the next begins to look.
  if (go_on)
    add_row(n, v, -1, row_of(std::as_const(start_).velocity, row), direction_.row(row));
  else
    clear_row(direction_.row(row), n);
  copy_row(x, row_of(start_.position, row), n);
  copy_row(v, row_of(start_.velocity, row), n);
  known_rows_[row] = same_row(x, std::as_const(state_.position).row(row), n) ? 1 : 0;
  add_row(n, x, h, v, row_of(next_.position, row));
  copy_row(v, row_of(next_.velocity, row), n);
  const Vec3f gained = h * input_.gravity;
  const Row3 wanted = wanted_.row(row);
  for (int c = 0; c < n; ++c) {
    wanted.x[c] = v.x[c] + gained.x;
    wanted.y[c] = v.y[c] + gained.y;
    wanted.z[c] = v.z[c] + gained.z;
  }
}

void NewtonSolver::begin(const StepInput& input, const ClothState& state) {
  input_ = input;
  iterations_ = 0;
  correction_ = lent_ = 0;
  const bool same_gravity = input.gravity == known_gravity_;
  known_gravity_ = input.gravity;
  springs_.set_time_step(input.time_step);
  if (multigrid_.renew_pins()) find_mass();
  const bool go_on = std::exchange(has_last_, false);
  first_ = true;
  team_.run([&](Worker& worker) {
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) begin_row(state, go_on, r);
  });
  // What a run left is often where the next begins: its energy is known.
  const bool known =
      same_gravity && std::find(known_rows_.begin(), known_rows_.end(), 0) == known_rows_.end();
  start_potential_ = known ? potential_ : HUGE_VAL;
  set_pins(cloth_, start_, input.time_step, next_);
  driven_ = std::any_of(cloth_.pins.begin(), cloth_.pins.end(), [&](const Pin& held) {
    return vec_cast<float>(held.target) != start_.position.at(held.sample);
  });
}

void NewtonSolver::find_mass() {
  mass_ = 0;
  for (int r = 0; r < cloth_.size; ++r)
    for (int c = 0; c < cloth_.size; ++c)
      if (cloth_.inverse_mass(r, c) > 0) mass_ += double{own_mass_(r, c)};
  if (!(mass_ > 0)) mass_ = 1;  // all is pinned
}

void NewtonSolver::read_state(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    copy_row(row_of(std::as_const(next_.position), r), state_.position.row(r), cloth_.size);
    copy_row(row_of(std::as_const(next_.velocity), r), state_.velocity.row(r), cloth_.size);
    copy_row(row_of(std::as_const(start_.position), r), state_.start.row(r), cloth_.size);
  }
  worker.barrier();
}

void NewtonSolver::linearise(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  const float guessed_share = contacts_.empty() ? share_in_flight : share_in_contact;
  for (int r = mine.first; r < mine.last; ++r) springs_.linearise_row(state_, guessed_share, r);
  worker.barrier();
  for (int r = mine.first; r < mine.last; ++r) springs_.gradient_row(state_, wanted_, r, residual_);
  if (curved_.active()) {
    take_plain(state_.position, worker);
    curved_.set_position(plain_, worker);
    for (int r = mine.first; r < mine.last; ++r) curved_.add_row(r, residual_);
  } else {
    multigrid_.add_bending_gradient(state_.position, residual_, worker);
  }
  for (int r = mine.first; r < mine.last; ++r)
    kernels_.scale_rows(whole_vectors(cloth_.size), -1, residual_.row(r));
  multigrid_.complete(residual_, worker);
}

/// With the contacts that press.
void NewtonSolver::set_up_multigrid(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  const ContactLoads& loads = contacts_.loads();
  for (int r = mine.first; r < mine.last; ++r) {
    multigrid_.fill_diagonals(springs_, r);
    const bool touched = contacts_.active() > 0 && loads.row(r);
    contact_rows_[r] = touched ? 1 : 0;
    if (!touched) continue;
    std::array<float*, 6> blocks{};
    for (int k = 0; k < 6; ++k) {
      blocks[k] = contact_blocks_.entry[k].row(r);
      std::fill_n(blocks[k], cloth_.size, 0.0F);
    }
    loads.add_blocks(r, blocks);
    BlockRow6 added{};
    std::copy(blocks.begin(), blocks.end(), added.entry);
    multigrid_.add_to_diagonals(added, r);
  }
  worker.barrier();
  multigrid_.set_up(springs_, worker);
}

void NewtonSolver::add_contact_forces(float sign, Worker& worker) {
  if (contacts_.active() == 0) return;
  contacts_.load_forces(step_, worker);
  multigrid_.add_loads(contacts_.loads(), sign, residual_, worker);
}

/// @return whether contacts are taken otherwise than before
bool NewtonSolver::choose_contacts(Worker& worker) {
  if (contacts_.empty()) return false;
  add_contact_forces(-1, worker);
  const bool changed = contacts_.choose(step_, worker);
  add_contact_forces(1, worker);
  return changed;
}

void NewtonSolver::move_state(float length, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  const auto per_step = static_cast<float>(1 / input_.time_step);
  for (int r = mine.first; r < mine.last; ++r) {
    kernels_.add_scaled(whole_vectors(cloth_.size), length, std::as_const(step_).row(r),
                        state_.position.row(r));
    kernels_.add_scaled(whole_vectors(cloth_.size), length * per_step, std::as_const(step_).row(r),
                        state_.velocity.row(r));
  }
  worker.barrier();
}

void NewtonSolver::write_state(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    copy_row(std::as_const(state_.position).row(r), row_of(next_.position, r), cloth_.size);
    copy_row(std::as_const(state_.velocity).row(r), row_of(next_.velocity, r), cloth_.size);
  }
  worker.barrier();
}

void NewtonSolver::take_plain(const PaddedVectors& position, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    copy_row(position.row(r), row_of(plain_, r), cloth_.size);
  worker.barrier();
}

/// Halves the last step until it lowers the energy. @return whether it had to
bool NewtonSolver::shorten_step(Worker& worker) {
  double after = energy(1, worker);
  move_state(-1, worker);
  const double before = energy(0, worker);
  float length = 1;
  move_state(length, worker);
  for (int i = 0; after > before && i < most_halvings; ++i) {
    length *= 0.5F;
    move_state(-length, worker);
    after = energy(length, worker);
  }
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    kernels_.scale_rows(whole_vectors(cloth_.size), length, step_.row(r));
  worker.barrier();
  return length < 1;
}

/// Solves once, linearised at state_, which it moves on.
void NewtonSolver::advance(const NewtonOptions& options, Progress& progress, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) clear_row(step_.row(r), cloth_.size);
  linearise(worker);
  if (!contacts_.empty()) {
    for (int r = mine.first; r < mine.last; ++r) multigrid_.fill_diagonals(springs_, r);
    worker.barrier();
    multigrid_.join_centres(worker);
    contacts_.place(state_.velocity, multigrid_.finest().diagonal(), worker);
  }
  choose_contacts(worker);
  progress.promised = 0;
  if (driven_) progress.before = energy(0, worker);
  if (flies()) add_drift(drift(worker), worker);
  for (int round = 0; round < most_contact_rounds; ++round) {
    set_up_multigrid(worker);
    solve(options, progress, worker);
    if (contacts_.empty() || round + 1 == most_contact_rounds) break;
    if (!choose_contacts(worker)) break;
  }
  // What iterations left of it, so that few of them lose no momentum.
  if (flies()) add_drift(drift(worker), worker);
  multigrid_.clear_pins(step_, worker);
  move_state(1, worker);
}

/// Where nothing drives the cloth, the energy that it gained; else what the energy of the step
/// falls short of what was promised.
double NewtonSolver::error_of(const Progress& progress, double known, double kinetic_before,
                              Worker& worker) {
  if (driven_) return energy(1, worker) - progress.before + progress.promised;
  const double now = potential(state_.position, worker);
  worker.barrier();
  if (worker.rank() == 0) potential_ = now;
  return now + kinetic(state_.velocity, worker) - known - kinetic_before;
}

/// One linearisation does where cloth moves on as it did; where it missed by much it does not, as
/// after an impact.
void NewtonSolver::descend(const NewtonOptions& options, Progress& progress, Worker& worker) {
  const double kinetic_before = kinetic(start_.velocity, worker);
  const double known = driven_                       ? 0
                       : start_potential_ < HUGE_VAL ? start_potential_
                                                     : potential(state_.start, worker);
  const double fall = input_.time_step * length(input_.gravity);
  const double lent = contacts_.empty() ? 0 : lent_;
  const double allowed =
      harmless_gain * (kinetic_before + 0.5 * mass_ * fall * fall) + harmless_part * lent;
  double error = HUGE_VAL;
  for (int i = 0; i < most_linearisations && error > allowed; ++i) {
    advance(options, progress, worker);
    if (driven_ && !contacts_.empty()) {
      // Its contacts move as it does: what was promised says nothing.
      if (!shorten_step(worker) || i + 1 == most_among_moving) break;
      continue;
    }
    error = error_of(progress, known, kinetic_before, worker);
    if (error > allowed && shorten_step(worker))
      error = error_of(progress, known, kinetic_before, worker);
  }
  worker.barrier();
  if (worker.rank() == 0 && driven_) potential_ = HUGE_VAL;
  if (worker.rank() == 0 && !driven_) start_potential_ = known;
  if (!driven_ && error > lent) calm(error - lent, worker);
}

void NewtonSolver::run(std::span<const Contact> contacts, const NewtonOptions& options) {
  contacts_.take(contacts, start_.position, input_);
  for (const Contact& contact : contacts) driven_ = driven_ || contact.slide != Vec3f{};
  multigrid_.set_contacts({&contact_blocks_, contact_rows_.data()});
  team_.run([&](Worker& worker) {
    read_state(worker);
    Progress progress;
    progress.first = first_;
    descend(options, progress, worker);
    if (!contacts_.empty()) contacts_.measure(step_, worker);
    write_state(worker);
    if (worker.rank() != 0) return;
    iterations_ += progress.iterations;
    correction_ = progress.correction / cloth_.rest_spacing;
  });
  first_ = false;
}

void NewtonSolver::last_corrections(Grid<float>& sizes) const {
  const auto scale = static_cast<float>(last_length_ / cloth_.rest_spacing);
  for (int r = 0; r < cloth_.size; ++r)
    for (int c = 0; c < cloth_.size; ++c)
      sizes(r, c) =
          scale * length(Vec3f{direction_.x(r, c), direction_.y(r, c), direction_.z(r, c)});
}

}  // namespace weft
