#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/integrate/descent.h"
#include "weft/cloth/integrate/proposal.h"
#include "weft/core/error.h"

namespace weft {
namespace {

/// The descent as an integrator.
class Multigrid final : public Integrator {
 public:
  Multigrid(const MultigridOptions& options, const Cloth& cloth, const StepInput& typical,
            ThreadTeam& team)
      : options_(options), cloth_(cloth), team_(team), descent_(cloth, typical.time_step, team) {}

  void begin(const StepInput& input, const ClothState& state) noexcept override {
    const Stopwatch watch;
    report_ = {};
    time_step_ = input.time_step;
    descent_.begin(input, state);
    report_.forces_seconds = watch.seconds();
  }

  ClothState& proposal() noexcept override { return descent_.next(); }
  [[nodiscard]] bool starts_at_proposal() const noexcept override { return true; }

  ClothState& iterate(std::span<const Contact> contacts) noexcept override {
    const Stopwatch watch;
    descent_.run(contacts, options_);
    report_.iterations = descent_.iterations();
    report_.residual = descent_.correction();
    report_.solve_seconds += watch.seconds();
    return descent_.next();
  }

  [[nodiscard]] std::span<const float> contact_forces() const noexcept override {
    return descent_.contact_forces();
  }

  bool last_corrections(Grid<float>& sizes) const override {
    descent_.last_corrections(sizes);
    return true;
  }

  StepReport end(ClothState& state) noexcept override {
    accept(cloth_, descent_.next(), state, team_);
    return report_;
  }

  [[nodiscard]] std::string stability_advice(double /*time_step*/) const override { return {}; }

 private:
  MultigridOptions options_;
  const Cloth& cloth_;
  ThreadTeam& team_;
  Descent descent_;
  double time_step_ = 0;  // [s]
  StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> make_multigrid(const MultigridOptions& options, const Cloth& cloth,
                                           const StepInput& typical, ThreadTeam& team) {
  if (options.max_iterations < 1)
    throw SceneError("integrator.max_iterations", fmt::format("{}", options.max_iterations),
                     "at least 1");
  if (!std::isfinite(options.tolerance) || options.tolerance < 0)
    throw SceneError("integrator.tolerance", fmt::format("{}", options.tolerance), "at least 0");
  return std::make_unique<Multigrid>(options, cloth, typical, team);
}

}  // namespace weft
