#pragma once

#include <cmath>
#include <string_view>
#include <variant>

#include "weft/methods.h"

namespace weft {

/// Properties of an integrator.
struct IntegratorTraits {
  /// Solves with contact constraints. Other integrators ignore them, and penetrations are pushed
  /// out at the end of the step.
  bool solves_contacts = false;
  /// Its springs are too soft to limit stretch: the strain limiter does, alternating with the
  /// collider.
  bool soft_springs = false;
  /// The strain limiter may follow its solve, and `limiter_passes` is a key of it: for methods of
  /// the literature that include a limiter, and those whose few iterations may leave springs too
  /// long. Converged implicit Euler limits stretch by the springs themselves.
  bool has_limiter = false;
  /// Range of the default number of limiter passes, half the samples a side. With stiff springs
  /// only the few samples about pins are overstretched, more of them in finer images, but they
  /// carry the whole cloth's weight: that takes many passes, which cost little.
  int min_passes = 0, max_passes = 0;
  bool several_charts = false;  ///< takes cloths whose image has several charts
  double bytes_per_sample = 0;  ///< memory of a cloth for each sample
  double bytes_per_pair = 0;    ///< and for every pair of samples
};

/// Explicit Euler [provot95]; with Provot's limit where `limiter_passes` asks for it.
struct ExplicitOptions {
  static constexpr std::string_view name = "explicit";
  static constexpr IntegratorTraits traits{.has_limiter = true, .bytes_per_sample = 385};
  template <class Visit>
  static void visit_options(const Visit& /*visit*/) {}
};
/// Linearised implicit Euler, conjugate gradients without a matrix [baraff98].
struct ImplicitOptions {
  int max_iterations = 200;
  /// Stop when the correction of an iteration falls below this times the rest spacing; a tenth
  /// of it under contact.
  double tolerance = 1e-4;

  static constexpr std::string_view name = "implicit";
  static constexpr IntegratorTraits traits{.solves_contacts = true, .bytes_per_sample = 785};
  template <class Visit>
  static void visit_options(const Visit& visit) {
    visit("max_iterations", &ImplicitOptions::max_iterations, OptionRange{1, 1'000'000});
    visit("tolerance", &ImplicitOptions::tolerance, OptionRange{0, HUGE_VAL, true});
  }
};
/// One dense filter W of the cloth's own springs [desbrun99].
struct DesbrunOptions {
  static constexpr std::string_view name = "desbrun";
  static constexpr IntegratorTraits traits{.has_limiter = true,
                                           .min_passes = 60,
                                           .max_passes = 128,
                                           .bytes_per_sample = 500,
                                           .bytes_per_pair = 4};
  template <class Visit>
  static void visit_options(const Visit& /*visit*/) {}
};
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

  static constexpr std::string_view name = "two_level";
  static constexpr IntegratorTraits traits{.soft_springs = true,
                                           .has_limiter = true,
                                           .min_passes = 10,
                                           .max_passes = 10,
                                           .bytes_per_sample = 445};
  template <class Visit>
  static void visit_options(const Visit& visit) {
    visit("local_size", &TwoLevelOptions::local_size, OptionRange{3, 8193, false, true});
    visit("global_size", &TwoLevelOptions::global_size, OptionRange{0, 8193});
    visit("as_printed", &TwoLevelOptions::as_printed, OptionRange{});
    visit("filter_stiffness", &TwoLevelOptions::filter_stiffness, OptionRange{0});
  }
};
/// Implicit Euler solved by descent, preconditioned by the exact filter on the image's mip pyramid.
/// The default is two iterations a step; only cloth near rest meets the tolerance earlier. With
/// four steps a frame the fall of a hanging sheet then stays within 1 cm of the converged one at
/// any size. Three iterations deviate more than two at some sizes; four stay within a millimetre at
/// 1.6 times the time (docs/measured.md).
struct MultigridOptions {
  int max_iterations = 2;  ///< a step; four times as many under contact
  /// Stop when the correction of an iteration falls below this times the rest spacing; a ten
  /// thousandth of it under contact.
  double tolerance = 1e-3;

  static constexpr std::string_view name = "multigrid";
  static constexpr IntegratorTraits traits{.solves_contacts = true,
                                           .has_limiter = true,
                                           .min_passes = 60,
                                           .max_passes = 128,
                                           .bytes_per_sample = 640};
  template <class Visit>
  static void visit_options(const Visit& visit) {
    visit("max_iterations", &MultigridOptions::max_iterations, OptionRange{1, 1'000'000});
    visit("tolerance", &MultigridOptions::tolerance, OptionRange{0, HUGE_VAL, true});
  }
};
/// Implicit Euler by Newton's method with a block multigrid preconditioner: the default. Soft and
/// heavy fabrics take about three iterations a step, light and stiff ones five; more change the
/// motion by less than the linearisation leaves.
struct NewtonOptions {
  /// Of conjugate gradients for each linearisation; twice as many while seams are being sewn.
  int max_iterations = 8;
  /// Stop when an iteration's correction, as a force on every particle (in the norm of the system's
  /// inverse), is below this times its weight.
  double tolerance = 0.1;

  static constexpr std::string_view name = "newton";
  static constexpr IntegratorTraits traits{
      .solves_contacts = true, .several_charts = true, .bytes_per_sample = 1150};
  template <class Visit>
  static void visit_options(const Visit& visit) {
    visit("max_iterations", &NewtonOptions::max_iterations, OptionRange{1, 1'000'000});
    visit("tolerance", &NewtonOptions::tolerance, OptionRange{0, HUGE_VAL, true});
  }
};
using IntegratorOptions = std::variant<NewtonOptions, ImplicitOptions, ExplicitOptions,
                                       DesbrunOptions, TwoLevelOptions, MultigridOptions>;

using Integrators = Methods<IntegratorOptions>;

/// The name of an integrator in scene file and command line.
inline std::string_view name_of(const IntegratorOptions& options) {
  return Integrators::name_of(options);
}

}  // namespace weft
