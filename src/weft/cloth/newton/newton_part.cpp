#include "weft/cloth/newton/newton_part.h"

#include <algorithm>
#include <utility>

#include "weft/cloth/integrator.h"
#include "weft/cloth/neighbours.h"

namespace weft {
NewtonPart::NewtonPart(const Cloth& cloth, int workers, InstructionSet instructions)
    : cloth_(cloth),
      kernels_(newton_kernels_for(instructions)),
      springs_(cloth, kernels_),
      multigrid_(cloth, workers, kernels_),
      curved_(cloth, instructions),
      start_velocity_(cloth.size),
      next_(rest_state(cloth)),
      state_(cloth.size),
      plain_(curved_.active() ? Planes3(cloth.size) : Planes3()),
      step_(cloth.size, cloth.size),
      direction_(cloth.size, cloth.size),
      product_(cloth.size, cloth.size),
      residual_(multigrid_.rhs()),
      share_(cloth.size, cloth.size),
      own_mass_(cloth.size, cloth.size),
      sums_(cloth.size),
      row_parts_(static_cast<std::size_t>(cloth.size)),
      known_rows_(static_cast<std::size_t>(cloth.size)),
      largest_(static_cast<std::size_t>(cloth.size)) {
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c)
      share_(r, c) = cloth.mates.is_hole(r * cloth.size + c) ? 0.0F : 1.0F;
  Worker alone = Worker::lone();
  multigrid_.seams().share(Workers(alone, true), {&share_});
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) own_mass_(r, c) = share_(r, c) * cloth.mass(r, c);
  for (int sample = 0; sample < cloth.size * cloth.size; ++sample)
    if (cloth.mates.is_hole(sample)) holes_.push_back(sample);
  find_mass();
}

/// Copies a row of the step's start and extrapolates it at its velocity. The search starts along
/// the velocity change of the last step. @return whether the last run ended at these positions
bool NewtonPart::begin_row(const ClothState& state, bool go_on, int row) {
  const Row3 start_velocity = row_of(start_velocity_, row);
  return kernels_.begin_step({cloth_.size, static_cast<float>(input_.time_step),
                              row_of(state.position, row), row_of(state.velocity, row),
                              go_on ? row_of(std::as_const(start_velocity_), row) : ConstRow3{},
                              std::as_const(state_.position).row(row)},
                             {state_.start.row(row), start_velocity, row_of(next_.position, row),
                              row_of(next_.velocity, row), direction_.row(row)});
}

void NewtonPart::begin(const StepInput& input, const ClothState& state, ThreadTeam& team) {
  input_ = input;
  iterations = 0;
  correction = lent = missed = 0;
  history.start_step();
  const bool same_gravity = input.gravity == known_gravity_;
  known_gravity_ = input.gravity;
  springs_.set_time_step(input.time_step);
  if (multigrid_.renew_pins()) find_mass();
  const bool go_on = std::exchange(has_last_, false);
  // They have no place of their own, and are where others last put them.
  for (const int hole : holes_) {
    const int r = hole / cloth_.size, c = hole % cloth_.size;
    const Vec3f there = state.position.at(hole);
    state_.position.x(r, c) = there.x;
    state_.position.y(r, c) = there.y;
    state_.position.z(r, c) = there.z;
  }
  team.run([&](Worker& worker) {
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r)
      known_rows_[r] = begin_row(state, go_on, r) ? 1 : 0;
  });
  // A step mostly starts where the last run ended, whose potential energy is known.
  const bool known =
      same_gravity && std::find(known_rows_.begin(), known_rows_.end(), 0) == known_rows_.end();
  start_potential_ = known ? potential_ : HUGE_VAL;
  set_pins(cloth_, state, input.time_step, next_);
  measure_pin_steps(state.position);
}

void NewtonPart::measure_pin_steps(const Planes3& start) {
  pulled_ = cloth_.apart.has_value();
  pin_step_.reset();
  bool alike = !pulled_;
  for (const Pin& held : cloth_.pins) {
    const Vec3f target = vec_cast<float>(held.target), from = start.at(held.sample);
    pulled_ = pulled_ || target != from;
    const Vec3d moved = vec_cast<double>(target) - vec_cast<double>(from);
    if (!pin_step_) pin_step_ = moved;
    alike = alike && length(moved - *pin_step_) <= same_displacement;
  }
  if (!alike) pin_step_.reset();
}

void NewtonPart::find_mass() {
  mass_ = total_mass_ = 0;
  for (int r = 0; r < cloth_.size; ++r)
    for (int c = 0; c < cloth_.size; ++c) {
      total_mass_ += double{own_mass_(r, c)};
      if (cloth_.inverse_mass(r, c) > 0) mass_ += double{own_mass_(r, c)};
    }
  if (!(mass_ > 0)) mass_ = 1;  // all is pinned
}

/// Where a filter moved the guess, its velocity becomes the remaining displacement over the time
/// step.
void NewtonPart::read_row(int row) {
  const ConstRow3 position = row_of(std::as_const(next_.position), row),
                  velocity = row_of(std::as_const(next_.velocity), row);
  if (iterations == 0) {
    kernels_.follow_guess({cloth_.size, static_cast<float>(input_.time_step),
                           std::as_const(state_.start).row(row), velocity, position},
                          state_.position.row(row), state_.velocity.row(row));
  } else {
    copy_row(position, state_.position.row(row), cloth_.size);
    copy_row(velocity, state_.velocity.row(row), cloth_.size);
  }
}

void NewtonPart::read_state(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) read_row(r);
  worker.barrier();
}

void NewtonPart::write_state(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    copy_row(std::as_const(state_.position).row(r), row_of(next_.position, r), cloth_.size);
    copy_row(std::as_const(state_.velocity).row(r), row_of(next_.velocity, r), cloth_.size);
  }
  worker.barrier();
}

void NewtonPart::clear_step(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) clear_row(step_.row(r), cloth_.size);
  worker.barrier();
}

void NewtonPart::linearise(float guessed_share, Worker& worker) {
  if (curved_.active()) {
    take_plain(state_.position, worker);
    curved_.set_position(plain_, worker);
  }
  const Vec3f gained = static_cast<float>(input_.time_step) * input_.gravity;
  multigrid_.linearise({state_, start_velocity_, gained, guessed_share},
                       curved_.active() ? &curved_ : nullptr, springs_, residual_, worker);
}

const PlaneSet& NewtonPart::diagonal(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) multigrid_.fill_diagonals(springs_, r);
  worker.barrier();
  return multigrid_.join_diagonals(worker);
}

/// Sets up the multigrid, with the blocks of active contacts.
void NewtonPart::set_up(const Contacts& contacts, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    multigrid_.fill_diagonals(springs_, r);
    if (contacts.product == nullptr || !contacts.product->touches(contacts.cloth, r)) continue;
    contacts.product->for_blocks(contacts.cloth, r,
                                 [&](int col, const ContactProduct::Blocks& blocks) {
                                   multigrid_.add_to_diagonals(blocks, r, col);
                                 });
  }
  worker.barrier();
  multigrid_.set_up(springs_, worker);
}

void NewtonPart::add_loads(const Contacts& contacts, Worker& worker) {
  multigrid_.add_loads(exact(contacts), residual_, worker);
}

void NewtonPart::move_state(float length, Worker& worker) {
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

void NewtonPart::scale_step(float factor, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    kernels_.scale_rows(whole_vectors(cloth_.size), factor, step_.row(r));
  worker.barrier();
}

void NewtonPart::take_plain(const PaddedVectors& position, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    copy_row(position.row(r), row_of(plain_, r), cloth_.size);
  worker.barrier();
}

void NewtonPart::last_corrections(Grid<float>& sizes) const {
  const auto scale = static_cast<float>(last_length_ / cloth_.rest_spacing);
  for (int r = 0; r < cloth_.size; ++r)
    for (int c = 0; c < cloth_.size; ++c)
      sizes(r, c) =
          scale * length(Vec3f{direction_.x(r, c), direction_.y(r, c), direction_.z(r, c)});
}

}  // namespace weft
