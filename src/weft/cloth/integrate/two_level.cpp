#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/forces.h"
#include "weft/cloth/integrate/global_filter.h"
#include "weft/cloth/integrate/local_filter.h"
#include "weft/cloth/integrate/mass_springs.h"
#include "weft/cloth/integrate/momentum.h"
#include "weft/cloth/integrate/proposal.h"
#include "weft/cloth/mates.h"
#include "weft/core/error.h"

namespace weft {
namespace {

/// Side of the largest patch or coarse grid whose dense matrix is still made.
constexpr int largest_dense_side = 65;
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
    for (int c = 0; c < cloth.size; ++c) sum += double{cloth.mass(r, c)} * cloth.counted(r, c);
  return sum / cloth.particles;
}

/// The paper's method [zink07, section 4], with its slips mended: soft springs of its own, whose
/// accelerations are filtered locally by W_l and globally by W_g, on top of gravity, which is not
/// filtered. The sliding patch takes rows of W_l, which conserves neither momentum where patches
/// lean on the border; with nothing pinned a rigid acceleration takes back the net force and
/// torque.
class TwoLevel final : public Integrator {
 public:
  TwoLevel(const TwoLevelOptions& options, const Cloth& cloth, const StepInput& typical,
           ThreadTeam& team)
      : options_(options),
        cloth_(cloth),
        team_(team),
        mean_mass_(mean_mass(cloth)),
        filter_step_(typical.time_step),
        stiffness_(options.filter_stiffness > 0 ? options.filter_stiffness
                                                : largest_stable_stiffness(typical.time_step)),
        local_(cloth.size, options.local_size, ratio()),
        global_(cloth, {options.global_size, stiffness_, typical.time_step, !options.as_printed}),
        acceleration_(cloth.size),
        filtered_(cloth.size),
        next_(rest_state(cloth)),
        sums_(cloth.size) {
    for (int d = 0; d < spring_directions; ++d) {
      springs_[d] = Grid<float>(cloth.size, cloth.size);
      mass_springs(
          spring_offsets[d], stiffness_ / mean_mass_,
          [&](int r, int c) { return cloth.mass(r, c); }, springs_[d]);
      drop_missing(d);
    }
  }

  void begin(const StepInput& input, const ClothState& state) noexcept override {
    const Stopwatch watch;
    input_ = input;
    team_.run([&](Worker& worker) { accelerate(state, worker); });
    report_ = {};
    report_.forces_seconds = watch.seconds();
    const Stopwatch filtering;
    team_.run([&](Worker& worker) {
      filter(worker);
      advance(state, worker);
    });
    set_pins(cloth_, state, input_.time_step, next_);
    report_.solve_seconds = filtering.seconds();
  }

  /// Contacts are left to what the collider does with the proposal.
  ClothState& iterate(std::span<const Contact> /*contacts*/) noexcept override { return next_; }

  StepReport end(ClothState& state) noexcept override {
    accept(cloth_, next_, input_.time_step, state, team_);
    return report_;
  }

  [[nodiscard]] std::string stability_advice(double time_step) const override {
    return fmt::format(
        "the largest stiffness known to be stable with a step of {:.3g} s is about {:.3g} N/m, "
        "filter_stiffness is {:.3g} N/m",
        time_step, largest_stable_stiffness(time_step), stiffness_);
  }

 private:
  [[nodiscard]] double largest_stable_stiffness(double time_step) const {
    return stable_ratio_per_sample * options_.local_size * mean_mass_ / (time_step * time_step);
  }
  [[nodiscard]] double ratio() const {
    return filter_step_ * filter_step_ * stiffness_ / mean_mass_;
  }

  /// No spring between mates.
  void drop_missing(int direction) {
    const int n = cloth_.size;
    const auto [down, right] = spring_offsets[direction];
    for (int r = 0; r + down < n; ++r)
      for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c)
        if (cloth_.mates.representative(r * n + c) ==
            cloth_.mates.representative((r + down) * n + c + right))
          springs_[direction](r, c) = 0;
  }

  void average(Planes3& planes, Worker& worker) {
    worker.barrier();
    average_over_mates(cloth_.mates, worker, {&planes.x, &planes.y, &planes.z});
    worker.barrier();
  }

  /// Accelerations by the soft springs; zero where pinned.
  void accelerate(const ClothState& state, Worker& worker) {
    const double damping_lag = cloth_.material.damping * mean_mass_ / (2 * stiffness_);
    const LaggedSprings springs{&cloth_, &springs_,
                                static_cast<float>(input_.time_step + damping_lag)};
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) gather_lagged(springs, r, state, acceleration_);
    worker.barrier();
    sum_over_mates(cloth_.mates, worker, {&acceleration_.x, &acceleration_.y, &acceleration_.z});
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r) {
      const Row3 a = row_of(acceleration_, r);
      const float* inverse_mass = cloth_.inverse_mass.row(r);
      for (int c = 0; c < cloth_.size; ++c) {
        a.x[c] *= inverse_mass[c];
        a.y[c] *= inverse_mass[c];
        a.z[c] *= inverse_mass[c];
      }
    }
  }

  void filter(Worker& worker) {
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) local_.apply_row(acceleration_, filtered_, r);
    average(filtered_, worker);
    global_.filter(filtered_, worker);
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r) global_.add_row(filtered_, r);
    average(filtered_, worker);
  }

  /// What is added to the filtered accelerations before they move velocities, and positions alone.
  struct Corrections {
    RigidAcceleration both, position;
  };
  Corrections corrections(const ClothState& state, Worker& worker) {
    if (!cloth_.pins.empty()) return {};
    const Moments moments = sums_.sum(cloth_, state.position, filtered_, worker);
    if (!options_.as_printed) return {momentum_correction(moments), {}};
    return {{}, printed_correction(moments, input_.time_step, mean_mass_)};
  }

  void advance(const ClothState& state, Worker& worker) {
    const Corrections add = corrections(state, worker);
    const double h = input_.time_step;
    const Vec3d g = vec_cast<double>(input_.gravity);
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r)
      for (int c = 0; c < cloth_.size; ++c) {
        const Vec3f x = state.position.at(r, c), v = state.velocity.at(r, c);
        const Vec3d at = vec_cast<double>(x);
        const Vec3d a = vec_cast<double>(filtered_.at(r, c)) + g + add.both.linear +
                        cross(at - add.both.centre, add.both.turn);
        const Vec3f v1 = v + vec_cast<float>(h * a);
        const Vec3d moved =
            vec_cast<double>(v1) + h * cross(at - add.position.centre, add.position.turn);
        next_.velocity.set(r, c, v1);
        next_.position.set(r, c, x + vec_cast<float>(h * moved));
      }
  }

  TwoLevelOptions options_;
  const Cloth& cloth_;
  ThreadTeam& team_;
  double mean_mass_, filter_step_, stiffness_;
  std::array<Grid<float>, spring_directions> springs_;
  LocalFilter local_;
  GlobalFilter global_;
  Planes3 acceleration_, filtered_;
  ClothState next_;
  MomentSums sums_;
  StepInput input_;
  StepReport report_;
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

std::unique_ptr<Integrator> make_two_level(const TwoLevelOptions& options, const Cloth& cloth,
                                           const StepInput& typical, ThreadTeam& team) {
  TwoLevelOptions chosen = options;
  if (chosen.global_size == 0) chosen.global_size = default_global_size(cloth.size);
  check(chosen, cloth.size);
  return std::make_unique<TwoLevel>(chosen, cloth, typical, team);
}

}  // namespace weft
