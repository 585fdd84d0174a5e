#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "weft/cloth/cloth.h"
#include "weft/contact.h"
#include "weft/core/stopwatch.h"
#include "weft/core/thread_team.h"
#include "weft/integrators.h"

namespace weft {

/// Cloths of fewer samples a side are stepped by one thread each: more threads would lose in
/// barriers what they save.
inline constexpr int min_shared_size = 97;

/// Time step and gravity of one step.
struct StepInput {
  double time_step = 1.0 / 240;  ///< [s]
  Vec3f gravity{0, -9.81F, 0};   ///< [m/s^2]
};

/// Statistics of one step.
struct StepReport {
  int iterations = 0;  ///< of the linear solver, in all
  double residual =
      0;  ///< size of the last correction over the rest spacing, largest over particles
  double forces_seconds = 0, solve_seconds = 0;
};

/// Solves several cloths in contact with each other as one system.
class JointIntegrator {
 public:
  JointIntegrator() = default;
  JointIntegrator(const JointIntegrator&) = delete;
  JointIntegrator& operator=(const JointIntegrator&) = delete;
  virtual ~JointIntegrator() = default;
  /// Replaces the iterate calls of the cloths' integrators.
  /// @param own  contacts of each cloth
  /// @param shared  contacts between cloths, whose planes do not move
  virtual void iterate(std::span<const std::span<const Contact>> own,
                       std::span<const SharedContact> shared) noexcept = 0;
};

/// Advances one cloth by one step, in parts, so that a collider can work between them:
///   begin(input, state); next = iterate(contacts) (once or more, with contacts found anew);
///   ... next may be changed ...; end(state).
/// These do not throw. They allocate only where there are more contacts than before, where the set
/// of pins changes or where a time step is new (multigrid).
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Starts a step from a state and computes what does not depend on contacts. A second call
  /// instead of end restarts the step, possibly with another time step.
  virtual void begin(const StepInput& input, const ClothState& state) noexcept = 0;
  /// The current proposal for the state at the end of the step.
  [[nodiscard]] virtual ClothState& proposal() noexcept = 0;
  /// Whether begin proposes an initial guess, the motion without the cloth's internal forces. Every
  /// iterate then starts from the proposal as the caller left it, with the inertia of the step's
  /// start. Contacts are detected at the guess, and its passes through surfaces are undone before
  /// the first iterate. Otherwise the first iterate makes the first proposal.
  [[nodiscard]] virtual bool starts_at_proposal() const noexcept { return false; }
  /// Whether iterate solves for contacts and their friction, so that no response needs to follow.
  [[nodiscard]] virtual bool solves_contacts() const noexcept { return false; }
  /// Sets the energy that the cloth may gain in this step as new contacts push it off; called
  /// between begin and iterate. Methods without an energy balance ignore it. [J]
  virtual void lend(double /*energy*/) noexcept {}
  /// The energy error of the last proposal's linearisation if it is too large, or the part of it
  /// that could not be taken out of the motion; 0 if it is acceptable, and for methods that do not
  /// measure it. [J]
  [[nodiscard]] virtual double missed() const noexcept { return 0; }
  /// Proposes the state at the end of the step; the caller may change it in place (limit strain,
  /// truncate, push out of bodies) before the next iterate or end.
  virtual ClothState& iterate(std::span<const Contact> contacts) noexcept = 0;
  /// Creates the solver of several integrators of this kind as one system; null if the method has
  /// none.
  /// @param all  this one among them, kept by pointer
  /// @param team  kept by reference; the integrators' own, or, if all cloths are smaller than
  /// min_shared_size, any
  [[nodiscard]] virtual std::unique_ptr<JointIntegrator> join(std::span<Integrator* const> /*all*/,
                                                              ThreadTeam& /*team*/) {
    return nullptr;
  }
  /// Normal forces of the contacts of the last iterate, in their order; empty where the method
  /// does not solve for contacts. [N]
  [[nodiscard]] virtual std::span<const float> contact_forces() const noexcept { return {}; }
  /// The contact history that the next step starts from: forces and friction at the end of the last
  /// step. A contact between two cloths belongs to the first of both. Empty for methods without
  /// history.
  [[nodiscard]] virtual std::span<const PastContact> past_contacts() const noexcept { return {}; }
  /// Replaces the contact history.
  virtual void restore_past(std::span<const PastContact> /*past*/) {}
  /// Writes the size of each sample's last correction in the last iterate, over the rest spacing;
  /// the largest is the residual. @param sizes  [n x n]
  /// @return false where the method does not iterate; sizes are then unchanged
  virtual bool last_corrections(Grid<float>& /*sizes*/) const { return false; }
  /// Drops the search direction that a method keeps from the last step, so that the next step
  /// depends only on the state and the contact history.
  virtual void forget() noexcept {}
  /// Makes the proposal the state: mates equal, pins where the proposal has them.
  virtual StepReport end(ClothState& state) noexcept = 0;

  /// Largest stable time step for explicit methods, or largest stable stiffness for two_level, as a
  /// sentence for the error that names an instability; empty where the method is unconditionally
  /// stable.
  [[nodiscard]] virtual std::string stability_advice(double time_step) const = 0;

  /// A warning about options that are allowed but may not work well; empty if there is none.
  [[nodiscard]] virtual std::string caution() const { return {}; }
};

/// @param cloth    kept by reference, as is the team; its pins may change between steps
/// @param typical  the step that the filters of desbrun and two_level are made for, and that
/// caution is about
/// @throws SceneError when options do not fit the cloth (even local_size, n - 1 not a multiple, too
/// many particles for a dense matrix, ...)
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, const Cloth& cloth,
                                            const StepInput& typical, ThreadTeam& team);
// The same of one kind, each defined in its own source.
std::unique_ptr<Integrator> make_integrator_of(const NewtonOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team);
std::unique_ptr<Integrator> make_integrator_of(const ImplicitOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team);
std::unique_ptr<Integrator> make_integrator_of(const ExplicitOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team);
std::unique_ptr<Integrator> make_integrator_of(const DesbrunOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team);
std::unique_ptr<Integrator> make_integrator_of(const TwoLevelOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team);
std::unique_ptr<Integrator> make_integrator_of(const MultigridOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team);

/// Copies this worker's rows.
void copy_rows(const ClothState& from, ClothState& to, Worker& worker);

/// Puts every pinned sample at its target, with the velocity that takes it there in one step.
void set_pins(const Cloth& cloth, const ClothState& start, double time_step, ClothState& next);

/// Copies a proposal to the state, mates made equal but where seams are being sewn. Pins keep their
/// proposed positions: a filter may have stopped them before their targets.
void accept(const Cloth& cloth, ClothState& next, ClothState& state, ThreadTeam& team);

}  // namespace weft
