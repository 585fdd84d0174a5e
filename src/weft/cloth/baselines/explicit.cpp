#include <utility>

#include <fmt/format.h>

#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/baselines/stable_step.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Explicit Euler in its symplectic order, v += h a(x, v), then x += h v: free fall is then exactly
/// that of implicit Euler, and springs keep their energy below the largest stable step [provot95].
class Explicit final : public Integrator {
 public:
  Explicit(const Cloth& cloth, const StepInput& typical, ThreadTeam& team)
      : cloth_(cloth),
        typical_step_(typical.time_step),
        team_(team),
        kernels_(implicit_kernels_for(team.instructions())),
        force_(cloth.size),
        forces_(cloth, team.instructions()),
        bending_(cloth, team.instructions()),
        next_(rest_state(cloth)) {}

  void begin(const StepInput& input, const ClothState& state) noexcept override {
    const Stopwatch watch;
    time_step_ = input.time_step;
    team_.run([&](Worker& worker) {
      const Range mine = worker.share(cloth_.size);
      bending_.curve(state.position, worker);
      for (int r = mine.first; r < mine.last; ++r) {
        forces_.gather_damped(r, state, force_);
        bending_.add_row(1, r, force_);
      }
      worker.barrier();
      sum_over_mates(cloth_.mates, worker, {&force_.x, &force_.y, &force_.z});
      worker.barrier();
      for (int r = mine.first; r < mine.last; ++r) advance_row(input, state, r);
    });
    set_pins(cloth_, state, time_step_, next_);
    seconds_ = watch.seconds();
  }

  ClothState& proposal() noexcept override { return next_; }

  /// Ignores contacts, which the collider resolves in the proposal.
  ClothState& iterate(std::span<const Contact> /*contacts*/) noexcept override { return next_; }

  StepReport end(ClothState& state) noexcept override {
    accept(cloth_, next_, state, team_);
    return {0, 0, seconds_, 0};
  }

  [[nodiscard]] std::string stability_advice(double time_step) const override {
    return fmt::format(
        "the largest stable step of this cloth is about {:.3g} s, the step is {:.3g} s",
        largest_stable_step(cloth_, team_), time_step);
  }

  /// The strain limiter may keep unstable springs within bounds: the cloth trembles without
  /// diverging.
  [[nodiscard]] std::string caution() const override {
    if (is_surely_stable(cloth_, typical_step_)) return {};
    if (largest_stable_step(cloth_, team_) >= typical_step_) return {};
    return "this may tremble or run away: " + stability_advice(typical_step_);
  }

 private:
  void advance_row(const StepInput& input, const ClothState& state, int row) {
    const Vec3f g = input.gravity;
    kernels_.advance(cloth_.size,
                     {static_cast<float>(input.time_step),
                      {g.x, g.y, g.z},
                      row_of(state.position, row),
                      row_of(state.velocity, row),
                      row_of(std::as_const(force_), row),
                      cloth_.inverse_mass.row(row),
                      cloth_.owner.row(row)},
                     row_of(next_.position, row), row_of(next_.velocity, row));
  }

  const Cloth& cloth_;
  double typical_step_;  // [s]
  ThreadTeam& team_;
  const ImplicitKernels& kernels_;
  Planes3 force_;
  SpringForces forces_;
  BendingPass bending_;
  ClothState next_;
  double time_step_ = 1, seconds_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> make_integrator_of(const ExplicitOptions& /*options*/,
                                               const Cloth& cloth, const StepInput& typical,
                                               ThreadTeam& team) {
  return std::make_unique<Explicit>(cloth, typical, team);
}

}  // namespace weft
