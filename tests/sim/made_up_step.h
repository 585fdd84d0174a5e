#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/cloth/sheets.h"
#include "weft/sim/stepping/energy_budget.h"
#include "weft/sim/stepping/mover.h"

namespace weft::testing {

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
  /// @param density  of the sheet [kg/m^2]
  explicit MadeUpStep(double density = soft_fabric.density) {
    SimulatedCloth one;
    Material material = soft_fabric;
    material.density = density;
    one.model = std::make_shared<Cloth>(sheet_cloth(n, material));
    one.state = rest_state(*one.model);
    shake(*one.model, 1, one.state.velocity);
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
  /// The filter stretches the cloth along x, or the solve does.
  void stretch(float factor, bool in_solve = false) {
    Planes3& position = puppet_->next.position;
    for (int s = 0; s < n * n; ++s) {
      Vec3f p = position.at(s);
      p.x *= factor;
      position.set(s, p);
    }
    if (in_solve) mover().solved = mover().meter.measure(puppet_->next);
  }
  void miss(double energy) { puppet_->error = energy; }
  [[nodiscard]] double total() { return mover().meter.measure(puppet_->next).total(); }
  [[nodiscard]] double at_start() { return mover().meter.measure(state()).total(); }
  [[nodiscard]] double moved() const {
    return largest_displacement(cloths_[0].state.position, puppet_->next.position);
  }
  [[nodiscard]] Vec3d momentum_now() { return momentum(*cloths_[0].model, puppet_->next); }
  [[nodiscard]] double mass() const { return total_mass(*cloths_[0].model); }
  /// What collisions may lend: 0.003 m g times the side of 1 m [J].
  [[nodiscard]] double lent() const { return 0.003 * mass() * 9.81; }

  [[nodiscard]] const std::vector<SimulatedCloth>& cloths() const { return cloths_; }
  [[nodiscard]] std::vector<Mover>& movers() { return movers_; }

 private:
  static constexpr int n = 9;
  static constexpr Vec3d gravity{0, -9.81, 0};
  ClothState& state() { return cloths_[0].state; }
  Mover& mover() { return movers_[0]; }
  ThreadTeam team_{1};
  std::vector<SimulatedCloth> cloths_;
  std::vector<Mover> movers_;
  Puppet* puppet_ = nullptr;

 public:
  EnergyBudget budget{cloths_, movers_};
};

}  // namespace weft::testing
