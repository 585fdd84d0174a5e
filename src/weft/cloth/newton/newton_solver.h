#pragma once

#include <optional>
#include <span>
#include <vector>

#include "weft/cloth/integrator.h"
#include "weft/cloth/newton/contact_system.h"
#include "weft/cloth/newton/newton_part.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// One step of implicit Euler by Newton's method for one cloth, or for several in contact with each
/// other: the energy
///   E(x) = |x - y|^2_M / (2 h^2) + springs(x) + bending(x) + contacts(x),  y = x0 + h v0 + h^2 g,
/// is linearised at x0 + h v0, and again wherever run() is called, with the positive part of its
/// Hessian. Conjugate gradients preconditioned by each cloth's BlockMultigrid find the step
/// [nocedal06]. A state at rest stays at rest, whatever the number of iterations. The first search
/// direction is the velocity change of the step before, which is in no ClothState: forget() makes
/// steps depend on their state alone. Where nothing drives the cloths, a run adds no energy: it
/// linearises again if it would add much, and takes the rest out of the velocities relative to
/// their mean. Pins that move alike stand still for an observer who moves with them, to whom the
/// same applies.
class NewtonSolver {
 public:
  /// @param parts  that began the same step when run is called; kept by pointer
  explicit NewtonSolver(std::span<NewtonPart* const> parts);

  /// Solves the step from the parts' next() as the caller left it, which becomes the solution.
  /// @param own  contacts of each part
  void run(std::span<const std::span<const Contact>> own, std::span<const SharedContact> shared,
           const NewtonOptions& options, ThreadTeam& team);

 private:
  /// State of conjugate gradients between iterations; every worker has its own.
  struct Progress {
    bool first = false;    ///< whether to start along the velocity change of the last step
    double slope = 0;      ///< residual . direction [N m]
    double curvature = 0;  ///< direction . A direction; 0: there is none yet [N m]
    double force = 0;      ///< of the last correction, over particles' weight
    double inner = 0;      ///< energy at the linearisation, without that of contacts [J]
    double contacts = 0;   ///< that of contacts there, if it is compared [J]
    double promised = 0;   ///< decrease of all energy by the linearisation [J]
    int iterations = 0;
  };
  /// Calls act for each part: all workers together on every part, or each worker on its own parts.
  /// @param act  (index, worker of the part)
  template <class Act>
  void each(Worker& worker, const Act& act);
  /// The sum over all parts, known to all workers. @param term  (index, worker of the part)
  template <class Term>
  double total(Worker& worker, const Term& term);
  [[nodiscard]] NewtonPart::Contacts contacts_of(std::size_t part) const;
  /// Moves free cloths as a whole by their net force, like one particle, so that free fall is
  /// exact: each on its own, or all together where some are in contact with each other.
  /// @return the decrease of the energy by that [J]
  double drift(Worker& worker);
  void linearise(Worker& worker);
  bool choose_contacts(bool stepped, Worker& worker);
  double precondition(bool has_product, Worker& worker);
  void solve(const NewtonOptions& options, Progress& progress, Worker& worker);
  void iterate(Progress& progress, Worker& worker);
  void descend_direction(Progress& progress, Worker& worker);
  /// Linearises at the state, solves and moves the state by the step.
  void advance(const NewtonOptions& options, Progress& progress, Worker& worker);
  /// Advances until the energy error is acceptable, then takes out the energy gained.
  void descend(const NewtonOptions& options, Progress& progress, Worker& worker);
  bool shorten_step(Worker& worker);
  /// How far from the end of a step a linearisation may end [m].
  [[nodiscard]] double good_way() const;
  /// How far from there the last one ended [m].
  double missed_way(const Progress& progress, Worker& worker);
  /// Energy error of the last linearisation [J].
  double error_of(const Progress& progress, double known, Worker& worker);
  /// The energy that the cloths gained, as who moves with the pins sees it [J].
  double gained_beside_pins(double known, Worker& worker);
  /// The displacement of all pins; none where none moves, or they move differently [m].
  [[nodiscard]] std::optional<Vec3d> common_pin_step() const;
  [[nodiscard]] Vec3d pin_velocity() const;
  /// Whether pins move so that the energy gained is not known.
  [[nodiscard]] bool is_pulled_unlike() const { return pulled_ && !carried_; }
  /// E at the state without that of contacts [J].
  double inner_energy(Worker& worker);
  /// E at the state, which is at a part `length` of the step [J].
  double energy(float length, Worker& worker);
  void move_state(float length, Worker& worker);
  /// Energy that rounding alone may seem to add [J].
  [[nodiscard]] double rounding() const;
  /// Takes an excess [J] out of the velocities relative to their mean.
  /// @return the part that they do not have, and the cloth keeps [J]
  double calm(double excess, Worker& worker);

  std::vector<NewtonPart*> parts_;
  ContactSystem contacts_;
  std::vector<const PaddedVectors*> positions_, steps_, directions_, preconditioned_;
  std::vector<ContactSystem::Own> own_;  // arguments of set_contacts
  RowSums sums_;                         // over parts
  std::vector<Vec3d> forces_;            // net residual force on each part [N]
  double mass_ = 0;                      // of all that moves [kg]
  double lent_ = 0;                      // energy that all may gain from contacts [J]
  double missed_ = 0;                    // see NewtonPart [J]
  bool apart_ = false;                   // whether each part is one worker's
  bool pulled_ = false, sewn_ = false;   // whether pins move; whether seams are being sewn
  std::optional<Vec3d> carried_;         // displacement of all pins, where they move alike [m]
};

template <class Act>
void NewtonSolver::each(Worker& worker, const Act& act) {
  if (!apart_) {
    for (std::size_t i = 0; i < parts_.size(); ++i) act(i, worker);
    return;
  }
  const Range mine = worker.share(static_cast<int>(parts_.size()));
  Worker lone = Worker::lone();
  for (int i = mine.first; i < mine.last; ++i) act(static_cast<std::size_t>(i), lone);
  worker.barrier();
}

template <class Term>
double NewtonSolver::total(Worker& worker, const Term& term) {
  if (!apart_) {
    double sum = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) sum += term(i, worker);
    return sum;
  }
  Worker lone = Worker::lone();
  return sums_.sum(worker, [&](int i) { return term(static_cast<std::size_t>(i), lone); });
}

}  // namespace weft
