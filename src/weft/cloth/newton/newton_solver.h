#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "weft/cloth/integrate/integrator.h"
#include "weft/cloth/newton/block_multigrid.h"
#include "weft/cloth/newton/contact_system.h"
#include "weft/cloth/newton/curved_bending.h"
#include "weft/cloth/newton/spring_hessian.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// One step of implicit Euler by Newton's method: the energy
///   E(x) = |x - y|^2_M / (2 h^2) + springs(x) + bending(x) + contacts(x),  y = x0 + h v0 + h^2 g,
/// is linearised at x0 + h v0, and again wherever run() is called, with the positive part of its
/// Hessian; conjugate gradients preconditioned by BlockMultigrid find the step [nocedal06]. A state
/// at rest stays at rest, whatever the number of iterations. They begin along the change of
/// velocity of the step before, which is in no ClothState: forget() makes steps depend on their
/// state alone. Where nothing drives the cloth, a run adds no energy: it linearises again where it
/// would add much, and takes what is left from the velocities, less their mean.
class NewtonSolver {
 public:
  /// @param cloth  kept by reference, as is the team
  NewtonSolver(const Cloth& cloth, ThreadTeam& team);

  /// Starts a step: next() flies on at its velocity, pins are where they shall go.
  void begin(const StepInput& input, const ClothState& state);
  /// What the cloth may gain in this step where it meets contacts [J].
  void lend(double energy) { lent_ = energy; }
  /// Says that the step's end was taken: the next solve starts along what it changed.
  void accept() { has_last_ = true; }
  /// The next solve starts from nothing.
  void forget() { has_last_ = false; }
  /// Linearises at next(), as the caller left it, and makes it the solution.
  void run(std::span<const Contact> contacts, const NewtonOptions& options);
  [[nodiscard]] ClothState& next() { return next_; }
  /// Normal forces of the contacts of the last run, in their order [N].
  [[nodiscard]] std::span<const float> contact_forces() const { return contacts_.forces(); }
  /// Conjugate gradients' iterations since begin.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// The largest correction of the last iteration over the rest spacing.
  [[nodiscard]] double correction() const { return correction_; }
  /// That of every sample. @param sizes [n x n]
  void last_corrections(Grid<float>& sizes) const;

 private:
  /// What conjugate gradients carry from one iteration to the next; every worker has its own.
  struct Progress {
    bool first = false;     ///< whether the direction is what the last step changed
    double slope = 0;       ///< residual . direction [N m]
    double curvature = 0;   ///< direction . A direction; 0: there is none yet [N m]
    double correction = 0;  ///< [m]
    double force = 0;       ///< of the last correction, over particles' weight
    double before = 0;      ///< the energy where it was linearised, where the cloth is driven [J]
    double promised = 0;    ///< how far that falls if it is what the linearisation says [J]
    int iterations = 0;
  };
  void begin_row(const ClothState& state, bool go_on, int row);
  void find_mass();
  void read_state(Worker& worker);
  void linearise(Worker& worker);
  void set_up_multigrid(Worker& worker);
  void add_contact_forces(float sign, Worker& worker);
  [[nodiscard]] bool flies() const;
  Vec3d drift(Worker& worker);
  void add_drift(Vec3d way, Worker& worker);
  bool choose_contacts(Worker& worker);
  void solve(const NewtonOptions& options, Progress& progress, Worker& worker);
  void start_direction(Progress& progress, Worker& worker);
  void iterate(Progress& progress, Worker& worker);
  void turn(Progress& progress, Worker& worker);
  void descend_direction(Progress& progress, Worker& worker);
  /// Of row_parts_, in their order.
  [[nodiscard]] double total_of_rows() const;
  /// Solves once, linearised at state_, which it moves on by step_.
  void advance(const NewtonOptions& options, Progress& progress, Worker& worker);
  /// Advances as often as linearisations miss by much, and takes out energy that was gained.
  void descend(const NewtonOptions& options, Progress& progress, Worker& worker);
  bool shorten_step(Worker& worker);
  /// What the last linearisation missed by [J].
  double error_of(const Progress& progress, double known, double kinetic_before, Worker& worker);
  /// E of state_, to which a part of step_ has led [J].
  double energy(float length, Worker& worker);
  /// state_ += length * step_.
  void move_state(float length, Worker& worker);
  void write_state(Worker& worker);
  void take_plain(const PaddedVectors& position, Worker& worker);
  [[nodiscard]] double dot(const PaddedVectors& a, const PaddedVectors& b, Worker& worker);
  /// Springs, bending and gravity [J].
  double potential(const PaddedVectors& position, Worker& worker);
  double bending_energy(const PaddedVectors& position, Worker& worker);
  double kinetic(const Planes3& velocity, Worker& worker);
  double kinetic(const PaddedVectors& velocity, Worker& worker);
  /// Takes an excess [J] out of state_'s velocities.
  void calm(double excess, Worker& worker);

  const Cloth& cloth_;
  ThreadTeam& team_;
  const NewtonKernels& kernels_;
  SpringHessian springs_;
  BlockMultigrid multigrid_;
  CurvedBending curved_;
  ContactSystem contacts_;
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
  double potential_ = HUGE_VAL;    // of state_'s positions, as the last run left them [J]
  double start_potential_ = HUGE_VAL;  // of the start's; infinite: not known yet [J]
  Vec3f known_gravity_;                // that it was for
  std::vector<float> largest_;         // [n] squared direction of each row [m^2]
  double lent_ = 0;                    // see lend [J]
  double mass_ = 0;                    // of all that moves [kg]
  double last_length_ = 0;             // of the last step along direction_
  bool driven_ = false;                // by pins or obstacles that move
  bool has_last_ = false;              // whether start_ and next_ are those of the step before
  bool first_ = false;                 // whether no run has been since begin
  int iterations_ = 0;
  double correction_ = 0;
};

}  // namespace weft
