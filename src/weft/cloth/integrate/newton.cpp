#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/integrate/proposal.h"
#include "weft/cloth/newton/newton_solver.h"
#include "weft/core/error.h"

namespace weft {
namespace {

/// Newton's method as an integrator.
class Newton final : public Integrator {
 public:
  Newton(const NewtonOptions& options, const Cloth& cloth, ThreadTeam& team)
      : options_(options), cloth_(cloth), team_(team), solver_(cloth, team) {}

  void begin(const StepInput& input, const ClothState& state) noexcept override {
    const Stopwatch watch;
    report_ = {};
    solver_.begin(input, state);
    report_.forces_seconds = watch.seconds();
  }

  ClothState& proposal() noexcept override { return solver_.next(); }
  [[nodiscard]] bool starts_at_proposal() const noexcept override { return true; }
  [[nodiscard]] bool solves_contacts() const noexcept override { return true; }

  void lend(double energy) noexcept override { solver_.lend(energy); }

  ClothState& iterate(std::span<const Contact> contacts) noexcept override {
    const Stopwatch watch;
    solver_.run(contacts, options_);
    report_.iterations = solver_.iterations();
    report_.residual = solver_.correction();
    report_.solve_seconds += watch.seconds();
    return solver_.next();
  }

  [[nodiscard]] std::span<const float> contact_forces() const noexcept override {
    return solver_.contact_forces();
  }

  bool last_corrections(Grid<float>& sizes) const override {
    solver_.last_corrections(sizes);
    return true;
  }

  void forget() noexcept override { solver_.forget(); }

  StepReport end(ClothState& state) noexcept override {
    accept(cloth_, solver_.next(), state, team_);
    solver_.accept();
    return report_;
  }

  [[nodiscard]] std::string stability_advice(double /*time_step*/) const override { return {}; }

 private:
  NewtonOptions options_;
  const Cloth& cloth_;
  ThreadTeam& team_;
  NewtonSolver solver_;
  StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> make_newton(const NewtonOptions& options, const Cloth& cloth,
                                        ThreadTeam& team) {
  if (options.max_iterations < 1)
    throw SceneError("integrator.max_iterations", fmt::format("{}", options.max_iterations),
                     "at least 1");
  if (!std::isfinite(options.tolerance) || options.tolerance < 0)
    throw SceneError("integrator.tolerance", fmt::format("{}", options.tolerance), "at least 0");
  return std::make_unique<Newton>(options, cloth, team);
}

}  // namespace weft
