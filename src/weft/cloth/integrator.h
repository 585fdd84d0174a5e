#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "weft/cloth/cloth.h"
#include "weft/contact.h"
#include "weft/core/thread_team.h"
#include "weft/integrators.h"

namespace weft {

/// Smaller cloths are stepped by one thread each: what others would save they would spend waiting.
inline constexpr int min_shared_size = 97;

/// What acts during one step.
struct StepInput {
  double time_step = 1.0 / 240;  ///< [s]
  Vec3f gravity{0, -9.81F, 0};   ///< [m/s^2]
};

/// How one step went.
struct StepReport {
  int iterations = 0;  ///< of the linear solver, in all
  double residual =
      0;  ///< size of the last correction over the rest spacing, largest over particles
  double forces_seconds = 0, solve_seconds = 0;
};

/// What solves several cloths as one system, where they press on each other.
class JointIntegrator {
 public:
  JointIntegrator() = default;
  JointIntegrator(const JointIntegrator&) = delete;
  JointIntegrator& operator=(const JointIntegrator&) = delete;
  virtual ~JointIntegrator() = default;
  /// Does what iterate of each cloth's integrator does, in their stead.
  /// @param own  contacts of each cloth @param shared  between cloths, whose planes do not move
  virtual void iterate(std::span<const std::span<const Contact>> own,
                       std::span<const SharedContact> shared) noexcept = 0;
};

/// Advances one cloth by one step, in parts, so that a collider can work between them:
///   begin(input, state); next = iterate(contacts) (once or more, with contacts found anew);
///   ... next may be changed ...; end(state).
/// Nothing here allocates once constructed, but where the set of pins changes (multigrid, desbrun)
/// or a time step is new (multigrid); nothing throws.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Takes the state at the start of the step and computes what does not depend on contacts. May
  /// be called again instead of end: the step starts anew, with another time step perhaps.
  virtual void begin(const StepInput& input, const ClothState& state) noexcept = 0;
  /// The proposal as it stands.
  [[nodiscard]] virtual ClothState& proposal() noexcept = 0;
  /// Whether begin proposes a guess, where the step leads without the cloth's own forces, and every
  /// iterate starts from the proposal as the caller left it, the inertia staying that of the step's
  /// start. Contacts are looked for at the guess then, and what it passed through is taken back
  /// before the first iterate. Else the first iterate makes the first proposal.
  [[nodiscard]] virtual bool starts_at_proposal() const noexcept { return false; }
  /// Whether iterate solves for contacts and their friction, so that no response needs to follow.
  [[nodiscard]] virtual bool solves_contacts() const noexcept { return false; }
  /// Between begin and iterate: what a cloth that meets contacts may gain in this step, as contacts
  /// that were not there before push it off. Methods that keep no account of energy do not ask. [J]
  virtual void lend(double /*energy*/) noexcept {}
  /// By how much the energy of the last proposal exceeds what its linearisation promised, where
  /// that was too far for it; 0 where it will do, and for methods that do not look. [J]
  [[nodiscard]] virtual double missed() const noexcept { return 0; }
  /// Proposes the state at the end of the step; the caller may change it in place (limit strain,
  /// truncate, push out of bodies) before the next iterate or end.
  virtual ClothState& iterate(std::span<const Contact> contacts) noexcept = 0;
  /// What solves the cloths of integrators of this kind together; null where the method does not.
  /// @param all   this one among them, kept by pointer
  /// @param team  kept by reference; that of the integrators, or, where all cloths are smaller than
  /// min_shared_size, any
  [[nodiscard]] virtual std::unique_ptr<JointIntegrator> join(std::span<Integrator* const> /*all*/,
                                                              ThreadTeam& /*team*/) {
    return nullptr;
  }
  /// Normal forces of the contacts of the last iterate, in their order; empty where the method
  /// does not solve for contacts. [N]
  [[nodiscard]] virtual std::span<const float> contact_forces() const noexcept { return {}; }
  /// What contacts did at the end of the last step, with which the next goes on; of those that
  /// several cloths share, at the first of both. Empty where the method goes on with nothing.
  [[nodiscard]] virtual std::span<const PastContact> past_contacts() const noexcept { return {}; }
  /// Goes on with others.
  virtual void restore_past(std::span<const PastContact> /*past*/) {}
  /// The last correction that the last iterate made to each sample, over the rest spacing, the
  /// largest of which is its residual. @param sizes [n x n]
  /// @return false where the method does not iterate; sizes are as they were
  virtual bool last_corrections(Grid<float>& /*sizes*/) const { return false; }
  /// Where a method starts its search along what it found before: it starts anew. What follows
  /// depends on the state and past contacts alone then.
  virtual void forget() noexcept {}
  /// Makes the proposal the state; mates equal, pins where the proposal has them.
  virtual StepReport end(ClothState& state) noexcept = 0;

  /// Largest stable time step for explicit methods, or largest stable stiffness for two_level, as a
  /// sentence for the error that names an instability; empty where the method is unconditionally
  /// stable.
  [[nodiscard]] virtual std::string stability_advice(double time_step) const = 0;

  /// A remark on options that are allowed but may not go well; empty where there is none.
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

}  // namespace weft
