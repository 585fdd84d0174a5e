#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "weft/cloth/integrator.h"
#include "weft/cloth/newton/bending_stencil.h"
#include "weft/cloth/newton/block_multigrid.h"
#include "weft/cloth/newton/contact_history.h"
#include "weft/cloth/newton/spring_hessian.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// One cloth in a step by NewtonSolver: its state, its linearised springs and bending, the vectors
/// of conjugate gradients and its energies. Of contacts it has only the terms in its system.
class NewtonPart {
 public:
  /// @param cloth  kept by reference  @param workers  the largest number of callers
  NewtonPart(const Cloth& cloth, int workers, InstructionSet instructions);
  [[nodiscard]] const Cloth& cloth() const { return cloth_; }

  /// Starts a step: next() is extrapolated at its velocity, pins are at their targets.
  void begin(const StepInput& input, const ClothState& state, ThreadTeam& team);
  /// Accepts the end of the step: the next solve starts along its velocity change.
  void accept() {
    has_last_ = true;
    history.accept();
  }
  /// Drops the last velocity change: the next solve starts without a direction.
  void forget() { has_last_ = false; }
  [[nodiscard]] ClothState& next() { return next_; }
  /// Positions at the step's start [m].
  [[nodiscard]] const PaddedVectors& start() const { return state_.start; }
  [[nodiscard]] const StepInput& input() const { return input_; }
  /// Mass of all particles that are not pinned [kg].
  [[nodiscard]] double mass() const { return mass_; }
  /// Whether its pins move in this step.
  [[nodiscard]] bool is_pulled() const { return pulled_; }
  /// Displacements of pins in a step that differ by no more are the same, rounded [m].
  static constexpr double same_displacement = 2e-6;
  /// The displacement of all its pins in this step; none where they differ, or where seams pull,
  /// too [m].
  [[nodiscard]] const std::optional<Vec3d>& pin_step() const { return pin_step_; }
  /// Mass of all particles [kg].
  [[nodiscard]] double total_mass() const { return total_mass_; }
  /// Side of a square of the cloth's area [m].
  [[nodiscard]] double side_length() const {
    return std::sqrt(total_mass_ / cloth_.material.density);
  }
  /// Energy that may be gained from contacts in this step [J].
  double lent = 0;
  /// See Integrator::missed; of all cloths that were solved with this one [J].
  double missed = 0;
  /// History of its contacts, and of shared ones whose first cloth it is.
  ContactHistory history;
  /// Normal forces of its own contacts [N].
  std::vector<float> contact_forces;
  /// Statistics of this step's solves: iterations of conjugate gradients, and the largest
  /// correction of the last one over the rest spacing.
  int iterations = 0;
  double correction = 0;
  /// The last correction of every sample over the rest spacing. @param sizes  [n x n]
  void last_corrections(Grid<float>& sizes) const;

  // To be called by every worker; each ends with a barrier, sums are known to all.

  void read_state(Worker& worker);
  void write_state(Worker& worker);
  void clear_step(Worker& worker);
  /// Linearises springs and bending at the state. @param guessed_share  see SpringHessian
  void linearise(float guessed_share, Worker& worker);
  /// The diagonal blocks of springs and bending, summed over seam copies.
  const PlaneSet& diagonal(Worker& worker);
  /// The contacts' terms in a system, of which this cloth has some.
  struct Contacts {
    const ContactProduct* product = nullptr;  ///< null: none is active
    std::size_t cloth = 0;                    ///< this one's index
  };
  void set_up(const Contacts& contacts, Worker& worker);
  /// Adds the contacts' loads to the residual.
  void add_loads(const Contacts& contacts, Worker& worker);
  /// Net residual force on the cloth, to which internal forces add nothing [N].
  Vec3d force(Worker& worker);
  /// Moves the cloth as a whole and subtracts the inertia of that from the residual. [m]
  void drift(Vec3d displacement, Worker& worker);
  void clear_pins(Worker& worker) { multigrid_.clear_pins(step_, worker); }
  /// state += length * step.
  void move_state(float length, Worker& worker);
  void scale_step(float factor, Worker& worker);

  // Conjugate gradients.

  /// @param along_last  whether to start along the velocity change of the last step
  /// @return residual . direction [N m]
  double start_direction(bool along_last, Worker& worker);
  /// Preconditions the residual, in three parts: before the last two the contacts' loads become
  /// those of preconditioned().
  void begin_cycle(Worker& worker) { multigrid_.smooth_first(worker); }
  void correct(const Contacts& contacts, Worker& worker) {
    multigrid_.correct(exact(contacts), worker);
  }
  /// @return product . the result [N m]
  double end_cycle(const Contacts& contacts, bool has_product, Worker& worker);
  /// direction = preconditioned residual - overlap * direction.
  /// @return residual . direction [N m]
  double update_direction(double overlap, Worker& worker);
  /// product = A direction. @return direction . product [N m]
  double multiply(const Contacts& contacts, Worker& worker);
  /// Adds length * direction to the step. @return the largest displacement of a particle [m]
  double advance(double length, Worker& worker);

  // Energies [J].

  /// Energy of inertia, springs and bending at the state, which the step minimises.
  double step_energy(Worker& worker);
  /// Potential energy of springs, bending and gravity at the state, and at the step's start.
  double potential(Worker& worker);
  double start_potential(Worker& worker);
  double kinetic(Worker& worker);
  double start_kinetic(Worker& worker);
  /// Kinetic energy of the free particles relative to a velocity, at the state and at the step's
  /// start.
  double kinetic_beside(Vec3d velocity, Worker& worker);
  double start_kinetic_beside(Vec3d velocity, Worker& worker);
  /// Invalidates the last value of potential(), which is not that of the current next().
  void forget_potential(Worker& worker);
  /// Kinetic energy of the velocities relative to their mean.
  double inner_kinetic(Worker& worker);
  /// Scales the velocities relative to their mean, which inner_kinetic has computed.
  void calm(double left, Worker& worker);

  [[nodiscard]] const PaddedVectors& position() const { return state_.position; }
  [[nodiscard]] const PaddedVectors& step() const { return step_; }
  [[nodiscard]] const PaddedVectors& direction() const { return direction_; }
  [[nodiscard]] const PaddedVectors& preconditioned() const { return multigrid_.value(); }

 private:
  [[nodiscard]] static BlockMultigrid::Loads exact(const Contacts& contacts) {
    return {contacts.product, contacts.cloth};
  }
  bool begin_row(const ClothState& state, bool go_on, int row);
  void read_row(int row);
  void find_mass();
  void take_plain(const PaddedVectors& position, Worker& worker);
  [[nodiscard]] const float* shares_of(int row) const {
    return multigrid_.seams().empty() ? nullptr : share_.row(row);
  }
  void measure_pin_steps(const Planes3& start);
  template <class Velocity>
  double kinetic_of(const Velocity& row_of_velocity, Worker& worker);
  template <class Velocity>
  double kinetic_of(const Velocity& row_of_velocity, Vec3d beside, Worker& worker);
  double potential_at(const PaddedVectors& position, Worker& worker);
  double bending_energy(const PaddedVectors& position, Worker& worker);

  const Cloth& cloth_;
  const NewtonKernels& kernels_;
  SpringHessian springs_;
  BlockMultigrid multigrid_;
  CurvedBending curved_;
  StepInput input_;
  Planes3 start_velocity_;  // [m/s]
  ClothState next_;
  PaddedState state_;                         // next_ and the start's positions, in padded planes
  Planes3 plain_;                             // unpadded positions, for curved bending
  PaddedVectors step_, direction_, product_;  // [m], [m], [N]
  PaddedVectors& residual_;                   // [N]
  PaddedPlane share_;                         // 1 / number of copies
  std::vector<int> holes_;                    // samples
  Grid<float> own_mass_;                      // share of the mass [kg]
  RowSums sums_;
  std::vector<double> row_parts_;      // [n] of direction . product
  std::vector<char> known_rows_;       // [n] whether potential_ is of the start's positions
  std::vector<float> largest_;         // [n] squared direction of each row [m^2]
  double potential_ = HUGE_VAL;        // the last value of potential() [J]
  double start_potential_ = HUGE_VAL;  // infinite: not known yet [J]
  Vec3f known_gravity_;                // gravity of the last step
  Vec3d mean_velocity_;
  double mass_ = 0, total_mass_ = 0;
  std::optional<Vec3d> pin_step_;
  double last_length_ = 0;  // of the last advance along the direction
  bool pulled_ = false;
  bool has_last_ = false;  // whether start_velocity_ and next_ are those of the step before
};

}  // namespace weft
