#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "weft/cloth/integrator.h"
#include "weft/cloth/newton/level_layout.h"
#include "weft/cloth/newton/newton_solver.h"
#include "weft/core/math.h"
#include "weft/error.h"

namespace weft {
namespace {

/// Newton's method as an integrator.
class Newton final : public Integrator {
 public:
  Newton(const NewtonOptions& options, const Cloth& cloth, ThreadTeam& team)
      : options_(options),
        cloth_(cloth),
        team_(team),
        part_(cloth, team.size(), team.instructions()),
        solver_(std::array{&part_}) {}

  void begin(const StepInput& input, const ClothState& state) noexcept override {
    const Stopwatch watch;
    report_ = {};
    part_.begin(input, state, team_);
    report_.forces_seconds = watch.seconds();
  }

  ClothState& proposal() noexcept override { return part_.next(); }
  [[nodiscard]] bool starts_at_proposal() const noexcept override { return true; }
  [[nodiscard]] bool solves_contacts() const noexcept override { return true; }

  void lend(double energy) noexcept override { part_.lent = energy; }
  [[nodiscard]] double missed() const noexcept override { return part_.missed; }

  ClothState& iterate(std::span<const Contact> contacts) noexcept override {
    const Stopwatch watch;
    solver_.run(std::array{contacts}, {}, options_, team_);
    report_.solve_seconds += watch.seconds();
    return part_.next();
  }

  [[nodiscard]] std::unique_ptr<JointIntegrator> join(std::span<Integrator* const> all,
                                                      ThreadTeam& team) override;

  [[nodiscard]] std::span<const float> contact_forces() const noexcept override {
    return part_.contact_forces;
  }

  bool last_corrections(Grid<float>& sizes) const override {
    part_.last_corrections(sizes);
    return true;
  }

  [[nodiscard]] std::span<const PastContact> past_contacts() const noexcept override {
    return part_.history.past();
  }
  void restore_past(std::span<const PastContact> past) override { part_.history.restore(past); }

  void forget() noexcept override { part_.forget(); }

  StepReport end(ClothState& state) noexcept override {
    accept(cloth_, part_.next(), state, team_);
    part_.accept();
    report_.iterations = part_.iterations;
    report_.residual = part_.correction;
    return report_;
  }

  [[nodiscard]] std::string stability_advice(double /*time_step*/) const override { return {}; }

  [[nodiscard]] std::string caution() const override {
    // Positions of single precision do not show a weight that strains cloth by less.
    constexpr double min_strain = 0x1p-23;
    const Material& material = cloth_.material;
    const double stretch = std::max(material.stretch.warp, material.stretch.weft);
    const double most = part_.side_length() * material.density * standard_gravity / min_strain;
    if (stretch <= most) return {};
    return fmt::format(
        "a stretch of {:.3g} N/m is so stiff for its weight that rounding holds it back: at most "
        "{:.2g} is wanted",
        stretch, most);
  }

  [[nodiscard]] NewtonPart& part() { return part_; }
  void spend(double seconds) { report_.solve_seconds += seconds; }

 private:
  NewtonOptions options_;
  const Cloth& cloth_;
  ThreadTeam& team_;
  NewtonPart part_;
  NewtonSolver solver_;
  StepReport report_;
};

/// Newton's method for several cloths in one system.
class JointNewton final : public JointIntegrator {
 public:
  JointNewton(std::vector<Newton*> members, const NewtonOptions& options, ThreadTeam& team)
      : members_(std::move(members)), options_(options), team_(team), solver_(parts_of(members_)) {}

  void iterate(std::span<const std::span<const Contact>> own,
               std::span<const SharedContact> shared) noexcept override {
    const Stopwatch watch;
    solver_.run(own, shared, options_, team_);
    members_.front()->spend(watch.seconds());
  }

 private:
  static std::vector<NewtonPart*> parts_of(std::span<Newton* const> members) {
    std::vector<NewtonPart*> parts;
    for (Newton* member : members) parts.push_back(&member->part());
    return parts;
  }

  std::vector<Newton*> members_;
  NewtonOptions options_;
  ThreadTeam& team_;
  NewtonSolver solver_;
};

std::unique_ptr<JointIntegrator> Newton::join(std::span<Integrator* const> all, ThreadTeam& team) {
  std::vector<Newton*> members;
  for (Integrator* one : all) {
    auto* member = dynamic_cast<Newton*>(one);
    if (member == nullptr) return nullptr;
    members.push_back(member);
  }
  return std::make_unique<JointNewton>(std::move(members), options_, team);
}

}  // namespace

std::unique_ptr<Integrator> make_integrator_of(const NewtonOptions& options, const Cloth& cloth,
                                               const StepInput& /*typical*/, ThreadTeam& team) {
  if (options.max_iterations < 1)
    throw SceneError("integrator.max_iterations", fmt::format("{}", options.max_iterations),
                     "at least 1 is wanted");
  if (!std::isfinite(options.tolerance) || options.tolerance < 0)
    throw SceneError("integrator.tolerance", fmt::format("{}", options.tolerance),
                     "at least 0 is wanted");
  if (cloth.mates.charts().size() > 1 && !LevelLayout(cloth.mates).has_gaps())
    throw SceneError("cloth", "charts that lie side by side",
                     fmt::format("{} samples between all charts", LevelLayout::gap));
  return std::make_unique<Newton>(options, cloth, team);
}

}  // namespace weft
