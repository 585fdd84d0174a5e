#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "weft/cloth/integrator.h"
#include "weft/cloth/newton/bending_stencil.h"
#include "weft/cloth/newton/block_multigrid.h"
#include "weft/cloth/newton/contact_history.h"
#include "weft/cloth/newton/spring_hessian.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// One cloth in a step by NewtonSolver: its state, its springs and bending linearised, the vectors
/// of conjugate gradients, and what all of them are to energy. Knows nothing of contacts but what
/// they add to its system.
class NewtonPart {
 public:
  /// @param cloth  kept by reference  @param workers  the most that will call
  NewtonPart(const Cloth& cloth, int workers, InstructionSet instructions);
  [[nodiscard]] const Cloth& cloth() const { return cloth_; }

  /// Starts a step: next() flies on at its velocity, pins are where they shall go.
  void begin(const StepInput& input, const ClothState& state, ThreadTeam& team);
  /// Says that the step's end was taken: the next solve starts along what it changed.
  void accept() {
    has_last_ = true;
    history.accept();
  }
  /// The next solve starts from nothing.
  void forget() { has_last_ = false; }
  [[nodiscard]] ClothState& next() { return next_; }
  [[nodiscard]] const Planes3& start() const { return start_.position; }
  [[nodiscard]] const StepInput& input() const { return input_; }
  /// Of all that moves [kg].
  [[nodiscard]] double mass() const { return mass_; }
  /// Whether its pins move in this step.
  [[nodiscard]] bool is_pulled() const { return pulled_; }
  /// What may be gained in this step where contacts are met [J].
  double lent = 0;
  /// See Integrator; of all cloths that were solved with it [J].
  double missed = 0;
  /// Of its contacts, and of shared ones whose first cloth it is.
  ContactHistory history;
  /// Normal forces of its own contacts [N].
  std::vector<float> contact_forces;
  /// What solves of this step came to: iterations of conjugate gradients, and the largest
  /// correction of the last over the rest spacing.
  int iterations = 0;
  double correction = 0;
  /// That of every sample. @param sizes [n x n]
  void last_corrections(Grid<float>& sizes) const;

  // To be called by every worker; each ends with a barrier, sums are known to all.

  void read_state(Worker& worker);
  void write_state(Worker& worker);
  void clear_step(Worker& worker);
  /// At the state. @param guessed_share  see SpringHessian
  void linearise(float guessed_share, Worker& worker);
  /// The diagonal blocks of springs and bending, summed over seam copies.
  const PaddedBlocks& diagonal(Worker& worker);
  /// What contacts add to a system.
  struct Contacts {
    const ContactGather& gather;
    ContactGather::Springs springs;
    std::span<const Vec3f> loads;
    bool press = false;  ///< whether any does
  };
  void set_up(const Contacts& contacts, Worker& worker);
  void add_contact_forces(const Contacts& contacts, float sign, Worker& worker);
  /// What is left of all forces on it: inner ones sum to nothing [N].
  Vec3d force(Worker& worker);
  /// Moves it as a whole, and takes what that balances off the residual. [m]
  void drift(Vec3d displacement, Worker& worker);
  void clear_pins(Worker& worker) { multigrid_.clear_pins(step_, worker); }
  /// state += length * step.
  void move_state(float length, Worker& worker);
  void scale_step(float factor, Worker& worker);

  // Conjugate gradients.

  /// @param along_last  whether the direction begins as what the last step changed
  /// @return residual . direction [N m]
  double start_direction(bool along_last, Worker& worker);
  /// Preconditions the residual. @return product . the result [N m]
  double precondition(bool has_product, Worker& worker);
  /// The direction becomes the preconditioned residual less a part of itself.
  /// @return residual . direction [N m]
  double update_direction(double overlap, Worker& worker);
  /// The direction's product. @return direction . product [N m]
  double multiply(const Contacts& contacts, Worker& worker);
  /// Goes along the direction. @return how far at most [m]
  double advance(double length, Worker& worker);

  // Energies [J].

  /// Of inertia, springs and bending at the state: what the step minimises.
  double step_energy(Worker& worker);
  /// Springs, bending and gravity at the state, and at the step's start.
  double potential(Worker& worker);
  double start_potential(Worker& worker);
  double kinetic(Worker& worker);
  double start_kinetic(Worker& worker);
  /// What potential() gave no longer belongs to next().
  void forget_potential(Worker& worker);
  /// Of the velocities less their mean.
  double inner_kinetic(Worker& worker);
  /// Scales the velocities less their mean, after inner_kinetic.
  void calm(double left, Worker& worker);

  [[nodiscard]] const PaddedVectors& position() const { return state_.position; }
  [[nodiscard]] const PaddedVectors& step() const { return step_; }
  [[nodiscard]] const PaddedVectors& direction() const { return direction_; }

 private:
  void begin_row(const ClothState& state, bool go_on, int row);
  void follow_guess(int row);
  void find_mass();
  void take_plain(const PaddedVectors& position, Worker& worker);
  [[nodiscard]] const float* shares_of(int row) const {
    return multigrid_.seams().empty() ? nullptr : share_.row(row);
  }
  template <class Velocity>
  double kinetic_of(const Velocity& row_of_velocity, Worker& worker);
  double potential_at(const PaddedVectors& position, Worker& worker);
  double bending_energy(const PaddedVectors& position, Worker& worker);

  const Cloth& cloth_;
  const NewtonKernels& kernels_;
  SpringHessian springs_;
  BlockMultigrid multigrid_;
  CurvedBending curved_;
  StepInput input_;
  ClothState start_, next_;
  PaddedState state_;                         // next_, and the start, with frames
  Planes3 plain_;                             // its positions, for curved bending
  PaddedVectors wanted_;                      // v0 + h g [m/s]
  PaddedVectors step_, direction_, product_;  // [m], [m], [N]
  PaddedVectors& residual_;                   // [N]
  PaddedPlane share_;                         // 1 / number of copies
  Grid<float> own_mass_;                      // share of the mass [kg]
  PaddedBlocks contact_blocks_;               // where contacts press [N/m]
  std::vector<char> contact_rows_;            // [n] whether any
  RowSums sums_;
  std::vector<double> row_parts_;  // [n] of a second sum
  std::vector<char> known_rows_;   // [n] whether the last potential was of the start's positions
  std::vector<float> largest_;     // [n] squared direction of each row [m^2]
  double potential_ = HUGE_VAL;    // of the state's positions, as it was last asked for [J]
  double start_potential_ = HUGE_VAL;  // infinite: not known yet [J]
  Vec3f known_gravity_;                // that it was for
  Vec3d mean_velocity_;
  double mass_ = 0;
  double last_length_ = 0;  // of the last advance along the direction
  bool pulled_ = false;
  bool has_last_ = false;  // whether start_ and next_ are those of the step before
};

}  // namespace weft
