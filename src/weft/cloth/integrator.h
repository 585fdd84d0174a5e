#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "weft/cloth/cloth.h"
#include "weft/core/contact.h"
#include "weft/core/thread_team.h"

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

/// Explicit Euler [provot95]; with Provot's limit where `limiter_passes` asks for it.
struct ExplicitOptions {};
/// Linearised implicit Euler, conjugate gradients without a matrix [baraff98].
struct ImplicitOptions {
  int max_iterations = 200;
  /// Stop when the correction of an iteration falls below this times the rest spacing; a tenth
  /// of it while something presses on the cloth.
  double tolerance = 1e-4;
};
/// One dense filter W of the cloth's own springs [desbrun99].
struct DesbrunOptions {};
/// The paper's local and global filters [zink07]. Its soft springs leave all stretch to the
/// limiter, at 5 % where the material has no limit of its own.
struct TwoLevelOptions {
  int local_size = 11;  ///< n_l, odd
  int global_size = 0;  ///< n_g, n - 1 a multiple of n_g - 1; 0: the largest such up to 17
  /// f_l + interpolate(f_g), the printed torque correction, and a limiter that limits diagonals and
  /// shortening too and lends velocities its whole corrections.
  bool as_printed = false;
  /// k of the filter and of its soft springs [N/m]; 0: the largest known stable.
  double filter_stiffness = 0;
};
/// Implicit Euler solved by descent, preconditioned by the exact filter on the image's mip pyramid.
/// Two iterations a step, and a tolerance that only cloth near rest meets before: with four steps a
/// frame they bring the fall of a hanging sheet within 1 cm of the converged one, whatever its
/// size. Three swing farther from it than two at some sizes, four lie within a millimetre for 1.6
/// times the time (docs/measured.md).
struct MultigridOptions {
  int max_iterations = 2;  ///< a step; four times as many while something presses on the cloth
  /// Stop when the correction of an iteration falls below this times the rest spacing; a ten
  /// thousandth of it while something presses on the cloth.
  double tolerance = 1e-3;
};
/// Implicit Euler by Newton's method with a block multigrid preconditioner: the default. Soft and
/// heavy fabrics take about three iterations a step, light and stiff ones five; more change the
/// motion by less than the linearisation leaves.
struct NewtonOptions {
  int max_iterations = 8;  ///< of conjugate gradients for each linearisation
  /// Stop when an iteration's correction, as a force on every particle (in the norm of the system's
  /// inverse), is below this times its weight.
  double tolerance = 0.1;
};
using IntegratorOptions = std::variant<NewtonOptions, MultigridOptions, ImplicitOptions,
                                       ExplicitOptions, DesbrunOptions, TwoLevelOptions>;

/// Whether the strain limiter goes with a method, so that `limiter_passes` is a key of it: with
/// those of the literature that came with it, and with multigrid, whose few iterations may leave
/// springs too long. Implicit Euler solved to the end holds its cloth by the springs themselves.
bool has_limiter(const IntegratorOptions& options);

/// The name in scene file and command line: newton, multigrid, implicit, explicit, desbrun,
/// two_level.
std::string_view name_of(const IntegratorOptions& options);

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

}  // namespace weft
