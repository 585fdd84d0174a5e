#pragma once

#include <span>
#include <vector>

#include "weft/cloth/integrator.h"
#include "weft/cloth/newton/contact_system.h"
#include "weft/cloth/newton/newton_part.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// One step of implicit Euler by Newton's method for one cloth, or for several that press on each
/// other: the energy
///   E(x) = |x - y|^2_M / (2 h^2) + springs(x) + bending(x) + contacts(x),  y = x0 + h v0 + h^2 g,
/// is linearised at x0 + h v0, and again wherever run() is called, with the positive part of its
/// Hessian; conjugate gradients preconditioned by each cloth's BlockMultigrid find the step
/// [nocedal06]. A state at rest stays at rest, whatever the number of iterations. They begin along
/// the change of velocity of the step before, which is in no ClothState: forget() makes steps
/// depend on their state alone. Where nothing drives the cloths, a run adds no energy: it
/// linearises again where it would add much, and takes what is left from the velocities, less their
/// mean.
class NewtonSolver {
 public:
  /// @param parts  that began the same step when run is called; kept by pointer
  explicit NewtonSolver(std::span<NewtonPart* const> parts);

  /// Linearises at what the parts have as next(), as the caller left it, and makes it the solution.
  /// @param own  contacts of each part
  void run(std::span<const std::span<const Contact>> own, std::span<const SharedContact> shared,
           const NewtonOptions& options, ThreadTeam& team);

 private:
  /// What conjugate gradients carry from one iteration to the next; every worker has its own.
  struct Progress {
    bool first = false;    ///< whether the direction is what the last step changed
    double slope = 0;      ///< residual . direction [N m]
    double curvature = 0;  ///< direction . A direction; 0: there is none yet [N m]
    double force = 0;      ///< of the last correction, over particles' weight
    double before = 0;     ///< the energy where it was linearised, where pins pull [J]
    double promised = 0;   ///< how far that falls if it is what the linearisation says [J]
    int iterations = 0;
  };
  /// Does something to each part: all workers together, or each to those that are its own.
  /// @param act  (index, worker of the part)
  template <class Act>
  void each(Worker& worker, const Act& act);
  /// The sum over all parts, known to all workers. @param term  (index, worker of the part)
  template <class Term>
  double total(Worker& worker, const Term& term);
  [[nodiscard]] NewtonPart::Contacts contacts_of(std::size_t part) const;
  /// What nothing holds moves as a whole, as if it were one particle, so that free fall is exact: a
  /// cloth, or all of them where some press on each other.
  void drift(Worker& worker);
  void linearise(Worker& worker);
  void add_contact_forces(float sign, Worker& worker);
  bool choose_contacts(Worker& worker);
  void solve(const NewtonOptions& options, Progress& progress, Worker& worker);
  void iterate(Progress& progress, Worker& worker);
  void descend_direction(Progress& progress, Worker& worker);
  /// Solves once, linearised at the state, which it moves on by the step.
  void advance(const NewtonOptions& options, Progress& progress, Worker& worker);
  /// Advances as often as linearisations miss by much, and takes out energy that was gained.
  void descend(const NewtonOptions& options, Progress& progress, Worker& worker);
  bool shorten_step(Worker& worker);
  /// What the last linearisation missed by [J].
  double error_of(const Progress& progress, double known, Worker& worker);
  /// E of the state, to which a part of the step has led [J].
  double energy(float length, Worker& worker);
  void move_state(float length, Worker& worker);
  /// Takes an excess [J] out of velocities.
  void calm(double excess, Worker& worker);

  std::vector<NewtonPart*> parts_;
  ContactSystem contacts_;
  std::vector<const PaddedVectors*> positions_, steps_, directions_;
  std::vector<ContactSystem::Own> own_;  // while contacts are taken
  RowSums sums_;                         // over parts
  std::vector<Vec3d> forces_;            // left on each part [N]
  double mass_ = 0;                      // of all that moves [kg]
  double lent_ = 0;                      // what all may gain where they meet contacts [J]
  double missed_ = 0;                    // see NewtonPart [J]
  bool apart_ = false;                   // whether each part is one worker's
  bool pulled_ = false;                  // by pins that move
};

}  // namespace weft
