#pragma once

#include <string_view>
#include <variant>

namespace weft {

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

}  // namespace weft
