#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/baselines/nonlinear_pcg.h"
#include "weft/cloth/integrator.h"
#include "weft/error.h"

namespace weft {
namespace {

/// NonlinearPcg as an integrator.
class Multigrid final : public Integrator {
 public:
  Multigrid(const MultigridOptions& options, const Cloth& cloth, const StepInput& typical,
            ThreadTeam& team)
      : options_(options), cloth_(cloth), team_(team), pcg_(cloth, typical.time_step, team) {}

  void begin(const StepInput& input, const ClothState& state) noexcept override {
    const Stopwatch watch;
    report_ = {};
    time_step_ = input.time_step;
    pcg_.begin(input, state);
    report_.forces_seconds = watch.seconds();
  }

  ClothState& proposal() noexcept override { return pcg_.next(); }
  [[nodiscard]] bool starts_at_proposal() const noexcept override { return true; }

  ClothState& iterate(std::span<const Contact> contacts) noexcept override {
    const Stopwatch watch;
    pcg_.run(contacts, options_);
    report_.iterations = pcg_.iterations();
    report_.residual = pcg_.correction();
    report_.solve_seconds += watch.seconds();
    return pcg_.next();
  }

  [[nodiscard]] std::span<const float> contact_forces() const noexcept override {
    return pcg_.contact_forces();
  }

  bool last_corrections(Grid<float>& sizes) const override {
    pcg_.last_corrections(sizes);
    return true;
  }

  StepReport end(ClothState& state) noexcept override {
    accept(cloth_, pcg_.next(), state, team_);
    return report_;
  }

  [[nodiscard]] std::string stability_advice(double /*time_step*/) const override { return {}; }

 private:
  MultigridOptions options_;
  const Cloth& cloth_;
  ThreadTeam& team_;
  NonlinearPcg pcg_;
  double time_step_ = 0;  // [s]
  StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> make_integrator_of(const MultigridOptions& options, const Cloth& cloth,
                                               const StepInput& typical, ThreadTeam& team) {
  if (options.max_iterations < 1)
    throw SceneError("integrator.max_iterations", fmt::format("{}", options.max_iterations),
                     "at least 1 is wanted");
  if (!std::isfinite(options.tolerance) || options.tolerance < 0)
    throw SceneError("integrator.tolerance", fmt::format("{}", options.tolerance),
                     "at least 0 is wanted");
  return std::make_unique<Multigrid>(options, cloth, typical, team);
}

}  // namespace weft
