#include "weft/sim/stepping/energy_budget.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/error.h"
#include "weft/sim/stepping/stability_check.h"

namespace weft {
namespace {

using testing::momentum;
using testing::sheet_cloth;
using testing::total_mass;

constexpr Vec3d gravity{0, -9.81, 0};

/// Proposes what a test puts there.
class Puppet final : public Integrator {
 public:
  void begin(const StepInput& /*input*/, const ClothState& state) noexcept override {
    next = state;
  }
  ClothState& proposal() noexcept override { return next; }
  ClothState& iterate(std::span<const Contact> /*contacts*/) noexcept override { return next; }
  StepReport end(ClothState& /*state*/) noexcept override { return {}; }
  [[nodiscard]] std::string stability_advice(double /*time_step*/) const override { return {}; }
  [[nodiscard]] double missed() const noexcept override { return error; }

  ClothState next;
  double error = 0;  // [J]
};

/// A sheet of 1 m whose samples fly in all directions, in a step that a test makes up.
class MadeUpStep {
 public:
  MadeUpStep() {
    SimulatedCloth one;
    one.model = std::make_shared<Cloth>(sheet_cloth(n));
    one.state = rest_state(*one.model);
    testing::shake(*one.model, 1, one.state.velocity);
    cloths_.push_back(std::move(one));
    const Cloth& model = *cloths_[0].model;
    auto puppet = std::make_unique<Puppet>();
    puppet_ = puppet.get();
    movers_.push_back({std::move(puppet), std::nullopt, RunawayCheck(model, state(), gravity),
                       StrainLimit(model, team_), std::nullopt, EnergyMeter(model, gravity, team_),
                       DrivenWork(model, gravity, team_), Energy{}, Energy{}, Energy{}, Planes3(0),
                       Planes3(n)});
    puppet_->begin({}, state());
    budget.begin_run();
    budget.lend(false);
    mover().solved = mover().meter.measure(puppet_->next);
  }
  /// Collisions make all motion faster, by so much energy.
  void add(double energy) {
    const double kinetic = mover().solved.kinetic;
    const auto factor = static_cast<float>(std::sqrt((kinetic + energy) / kinetic));
    for (int s = 0; s < n * n; ++s)
      puppet_->next.velocity.set(s, factor * puppet_->next.velocity.at(s));
  }
  void miss(double energy) { puppet_->error = energy; }
  /// Whether a frame is stopped that ends with so much energy more than the run began with.
  bool stops(double more, double p99) {
    const std::string name = "made up";
    StabilityCheck check(name, cloths_, movers_);
    FrameReport report;
    report.kinetic_energy = total() + more;
    report.strain.p99 = p99;
    try {
      check.check_energy({}, report, report.kinetic_energy, false, budget);
    } catch (const Unstable&) {
      return true;
    }
    return false;
  }
  [[nodiscard]] double total() { return mover().meter.measure(puppet_->next).total(); }
  [[nodiscard]] Vec3d momentum_now() { return momentum(*cloths_[0].model, puppet_->next); }
  [[nodiscard]] double mass() const { return total_mass(*cloths_[0].model); }
  /// What collisions may lend: 0.003 m g times the side of 1 m [J].
  [[nodiscard]] double lent() const { return 0.003 * mass() * 9.81; }

 private:
  static constexpr int n = 9;
  ClothState& state() { return cloths_[0].state; }
  Mover& mover() { return movers_[0]; }
  ThreadTeam team_{1};
  std::vector<SimulatedCloth> cloths_;
  std::vector<Mover> movers_;
  Puppet* puppet_ = nullptr;

 public:
  EnergyBudget budget{cloths_, movers_};
};

TEST(EnergyBudget, NothingIsTakenOutOfAStepThatAddsNothing) {
  MadeUpStep step;
  const EnergyBudget::Added added = step.budget.measure_added({0}, false);
  EXPECT_NEAR(added.energy, 0, 1e-9);
  EXPECT_EQ(added.excess, 0);
  EXPECT_FALSE(added.too_much);
  EXPECT_TRUE(added.calm);
}

TEST(EnergyBudget, TakesOutWhatIsBeyondTheBoundAndKeepsMomentum) {
  MadeUpStep step;
  const double before = step.total();
  const double more = 0.05 * step.mass();
  ASSERT_GT(more, step.lent());
  step.add(more);
  const Vec3d momentum = step.momentum_now();
  const EnergyBudget::Added added = step.budget.measure_added({0}, false);
  EXPECT_NEAR(added.energy, more, 1e-5);
  EXPECT_NEAR(added.excess, more - step.lent(), 1e-5);
  EXPECT_FALSE(added.too_much);
  step.budget.take_out(added.excess);
  EXPECT_NEAR(step.total() - before, step.lent(), 1e-5);
  EXPECT_LT(length(step.momentum_now() - momentum), 1e-6);
}

TEST(EnergyBudget, WorkExplainsWhatItAdds) {
  MadeUpStep step;
  const double more = 0.05 * step.mass();
  step.add(more);
  EXPECT_EQ(step.budget.measure_added({more}, false).excess, 0);
  EXPECT_EQ(step.budget.measure_added({0}, true).excess, 0);  // seams that are sewn
}

TEST(EnergyBudget, PinsAndBodiesDoNoMoreThroughTheFilterThanItAdds) {
  MadeUpStep step;
  EXPECT_NEAR(step.budget.measure_added({1, 5}, false).work, 1, 1e-9);
  EXPECT_NEAR(step.budget.measure_added({1, -5}, false).work, 1, 1e-9);
  const double more = 0.05 * step.mass();
  step.add(more);
  EXPECT_NEAR(step.budget.measure_added({1, 5}, false).work, 1 + more, 1e-5);
  EXPECT_NEAR(step.budget.measure_added({1, 0.5 * more}, false).work, 1 + 0.5 * more, 1e-5);
  EXPECT_EQ(step.budget.measure_added({1, -5}, false).work, 1);
}

TEST(EnergyBudget, TellsStepsThatAddTooMuch) {
  MadeUpStep step;
  step.add(step.mass());
  EXPECT_TRUE(step.budget.measure_added({0}, false).too_much);
  EXPECT_FALSE(step.budget.measure_added({0}, true).too_much);
  EXPECT_FALSE(step.budget.measure_added({step.mass()}, false).too_much);
}

TEST(EnergyBudget, ASolveThatMissedMuchIsLostWhereTheStepMayBeShorter) {
  MadeUpStep step;
  EXPECT_FALSE(step.budget.solve_is_lost(1));
  step.miss(step.mass());
  EXPECT_TRUE(step.budget.solve_is_lost(1));
  EXPECT_TRUE(step.budget.solve_is_lost(0.25));
  EXPECT_FALSE(step.budget.solve_is_lost(0.125));
  step.miss(1e-3 * step.mass());
  EXPECT_FALSE(step.budget.solve_is_lost(1));
}

TEST(EnergyBudget, CountsWorkWithAndWithoutItsSign) {
  MadeUpStep step;
  step.budget.finish_step(2, true);
  step.budget.finish_step(-3, true);
  step.budget.add_pulled(0.5);
  EXPECT_EQ(step.budget.work().net, -1);
  EXPECT_EQ(step.budget.work().gross, 5);
  EXPECT_EQ(step.budget.work().pulled, 0.5);
}

TEST(StabilityCheck, StopsFarStretchedClothInOneFrameWhoseEnergyNoForceExplains) {
  MadeUpStep step;
  EXPECT_FALSE(step.stops(0, 1.5)) << "soft cloth";
  EXPECT_TRUE(step.stops(20, 1.5));
  EXPECT_FALSE(step.stops(20, 0.5)) << "one frame does not tell";
  step.budget.add_pulled(20);
  EXPECT_TRUE(step.stops(20, 1.5)) << "the filter's work explains nothing";
  step.budget.finish_step(20, true);
  EXPECT_FALSE(step.stops(20, 1.5)) << "stretched by work";
}

}  // namespace
}  // namespace weft
