#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/baselines/filtered_integrator.h"
#include "weft/cloth/baselines/paper_filters.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/integrator.h"
#include "weft/error.h"

namespace weft {
namespace {

/// Largest side of a patch or coarse grid whose dense matrix is made.
constexpr int largest_dense_side = LocalFilter::largest_patch;
constexpr int largest_default_global_size = 17;
/// h^2 k / m up to which runs are known to stay bounded, for each sample of the patch's side.
/// Measured on waving sheets of 33 and 65 samples a side, free and hung, for n_l = 3, 5, 7, 9, 11,
/// 15, 21, they first grow at 0.25, 0.46, 0.73, 1.07, 1.14, 2.4, 4.5; n_g makes no difference. This
/// keeps half of that and more.
constexpr double stable_ratio_per_sample = 0.04;

int default_global_size(int n) {
  for (int size = largest_default_global_size; size > 2; --size)
    if ((n - 1) % (size - 1) == 0) return size;
  return 2;
}

double mean_mass(const Cloth& cloth) {
  double sum = 0;
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) sum += double{cloth.mass(r, c)} * cloth.owner(r, c);
  return sum / cloth.particles;
}

/// The paper's method [zink07, section 4], with its errors corrected: soft springs of its own,
/// whose accelerations are filtered locally by W_l and globally by W_g, beside unfiltered gravity.
/// The sliding patch takes rows of W_l, which conserves neither momentum where patches lie at the
/// border; without pins a rigid acceleration removes the net force and torque.
class TwoLevel final : public FilteredIntegrator {
 public:
  TwoLevel(const TwoLevelOptions& options, const Cloth& cloth, const StepInput& typical,
           ThreadTeam& team)
      : FilteredIntegrator(cloth, team),
        options_(options),
        mean_mass_(mean_mass(cloth)),
        filter_step_(typical.time_step),
        stiffness_(options.filter_stiffness > 0 ? options.filter_stiffness
                                                : largest_stable_stiffness(typical.time_step)),
        local_(cloth.size, options.local_size, ratio(), team),
        global_(cloth, {options.global_size, stiffness_, typical.time_step, !options.as_printed},
                team) {
    for (int d = 0; d < spring_directions; ++d) make_springs_of(d);
  }

  [[nodiscard]] std::string stability_advice(double time_step) const override {
    return fmt::format(
        "the largest stiffness known to be stable with a step of {:.3g} s is about {:.3g} N/m, "
        "filter_stiffness is {:.3g} N/m",
        time_step, largest_stable_stiffness(time_step), stiffness_);
  }

  /// The strain limiter may keep an unstable filter within bounds: the cloth trembles without
  /// diverging.
  [[nodiscard]] std::string caution() const override {
    std::string text = FilteredIntegrator::caution();
    if (stiffness_ <= largest_stable_stiffness(filter_step_)) return text;
    if (!text.empty()) text += "; ";
    return text + "this may tremble or run away: " + stability_advice(filter_step_);
  }

 private:
  [[nodiscard]] double largest_stable_stiffness(double time_step) const {
    return stable_ratio_per_sample * options_.local_size * mean_mass_ / (time_step * time_step);
  }
  [[nodiscard]] double ratio() const {
    return filter_step_ * filter_step_ * stiffness_ / mean_mass_;
  }

  /// Sets the springs of a direction; none between mates.
  void make_springs_of(int direction) {
    const int n = cloth_.size;
    const auto [down, right] = spring_offsets[direction];
    Grid<float>& stiffness = springs_.stiffness[direction];
    Grid<float>& viscosity = springs_.viscosity[direction];
    mass_springs(
        {down, right}, stiffness_ / mean_mass_, [&](int r, int c) { return cloth_.mass(r, c); },
        stiffness);
    const double lag = filter_step_ + cloth_.material.damping * mean_mass_ / (2 * stiffness_);
    for (int r = 0; r + down < n; ++r)
      for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c) {
        if (cloth_.mates.representative(r * n + c) ==
            cloth_.mates.representative((r + down) * n + c + right))
          stiffness(r, c) = 0;
        viscosity(r, c) = static_cast<float>(lag) * stiffness(r, c);
      }
  }

  void filter(const Planes3& acceleration, Planes3& filtered, Worker& worker) override {
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r)
      local_.apply_row(acceleration, filtered, r, worker);
    average(filtered, worker);
    worker.barrier();
    global_.filter(filtered, worker);
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r) global_.add_row(filtered, r);
    average(filtered, worker);
  }

  [[nodiscard]] Corrections corrections(const Moments& moments, double time_step) const override {
    if (!options_.as_printed) return FilteredIntegrator::corrections(moments, time_step);
    return {{}, printed_correction(moments, time_step, mean_mass_)};
  }

  TwoLevelOptions options_;
  double mean_mass_, filter_step_, stiffness_;
  LocalFilter local_;
  GlobalFilter global_;
};

void check(const TwoLevelOptions& options, int n) {
  const auto refuse = [](const char* key, const std::string& found, const std::string& wanted) {
    throw SceneError(fmt::format("integrator.{}", key), found, wanted);
  };
  const int side = std::min(n, largest_dense_side);
  if (options.local_size < 3 || options.local_size % 2 == 0 || options.local_size > side)
    refuse("local_size", fmt::format("{}", options.local_size),
           fmt::format("an odd number from 3 to {}", side));
  const int global = options.global_size;
  if (global < 2 || global > side || (n - 1) % (global - 1) != 0)
    refuse("global_size", fmt::format("{}", global),
           fmt::format("0, or a number from 2 to {} such that {} is a multiple of it less 1", side,
                       n - 1));
  if (!std::isfinite(options.filter_stiffness) || options.filter_stiffness < 0)
    refuse("filter_stiffness", fmt::format("{}", options.filter_stiffness),
           "a stiffness above 0 N/m, or 0 for the largest known to be stable");
}

}  // namespace

std::unique_ptr<Integrator> make_integrator_of(const TwoLevelOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team) {
  TwoLevelOptions chosen = options;
  if (chosen.global_size == 0) chosen.global_size = default_global_size(cloth.size);
  check(chosen, cloth.size);
  return std::make_unique<TwoLevel>(chosen, cloth, typical, team);
}

}  // namespace weft
