#include <array>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

constexpr double step = 1.0 / 240, gap = 0.002;
const Material cotton{.density = 0.15, .stretch = 20000, .shear = 100, .bending = 1.2e-5};

/// Level sheets one above the other, a gap apart, each sample pressing on the one below.
class Stack {
 public:
  Stack(std::vector<int> sizes, const TeamOptions& team) : team_(team) {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      cloths_.push_back(sheet_cloth(sizes[i], cotton));
      states_.push_back(rest_state(cloths_[i]));
      const auto height = static_cast<float>(gap * static_cast<double>(i));
      for (int s = 0; s < sizes[i] * sizes[i]; ++s)
        states_[i].position.set(s, states_[i].position.at(s) + Vec3f{0, height, 0});
    }
    for (const Cloth& cloth : cloths_) {
      own_.push_back(make_integrator(NewtonOptions{}, cloth, {}, team_));
      all_.push_back(own_.back().get());
    }
    joint_ = all_.front()->join(all_, team_);
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) press(static_cast<int>(i));
  }
  void advance() {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i]->begin({.time_step = step}, states_[i]);
    const std::vector<std::span<const Contact>> none(all_.size());
    joint_->iterate(none, contacts_);
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i]->end(states_[i]);
  }
  /// Of all [kg m/s].
  [[nodiscard]] Vec3d momentum() const {
    Vec3d sum;
    for (std::size_t i = 0; i < cloths_.size(); ++i)
      for (int s = 0; s < cloths_[i].size * cloths_[i].size; ++s)
        sum += double{cloths_[i].mass(s / cloths_[i].size, s % cloths_[i].size)} *
               vec_cast<double>(states_[i].velocity.at(s));
    return sum;
  }
  [[nodiscard]] double energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < cloths_.size(); ++i)
      sum += kinetic_energy(cloths_[i], states_[i]) +
             potential_energy(cloths_[i], states_[i], {0, -9.81, 0});
    return sum;
  }
  [[nodiscard]] double mean_height(std::size_t i) const {
    double sum = 0;
    const int n = cloths_[i].size;
    for (int s = 0; s < n * n; ++s) sum += double{states_[i].position.at(s).y};
    return sum / (n * n);
  }
  void throw_at(std::size_t i, Vec3f velocity) {
    for (int s = 0; s < cloths_[i].size * cloths_[i].size; ++s)
      states_[i].velocity.set(s, velocity);
  }
  /// Holds a whole cloth where it is.
  void hold(std::size_t i) {
    for (int s = 0; s < cloths_[i].size * cloths_[i].size; ++s)
      pin(cloths_[i], s, vec_cast<double>(states_[i].position.at(s)));
  }
  [[nodiscard]] double mass() const {
    double sum = 0;
    for (const Cloth& cloth : cloths_) sum += total_mass(cloth);
    return sum;
  }
  [[nodiscard]] std::string hash() const {
    std::string all;
    for (const ClothState& state : states_) all += hash_of(state);
    return all;
  }

 private:
  /// Samples of the upper one against the nearest of the lower one.
  void press(int lower) {
    const int below = cloths_[lower].size, above = cloths_[lower + 1].size;
    for (int s = 0; s < above * above; ++s) {
      const auto scaled = [&](int at) {
        return (at * (below - 1) + (above - 1) / 2) / (above - 1);
      };
      SharedContact one;
      one.first = lower + 1;
      one.second = lower;
      one.contact.samples = {s, scaled(s / above) * below + scaled(s % above), 0, 0};
      one.contact.weights = {1, -1, 0, 0};
      one.contact.normal = {0, 1, 0};
      one.contact.offset = gap;
      one.contact.friction = 0.4F;
      one.contact.stiffness = 100 * cloths_[lower].mass(0, 0) / static_cast<float>(step * step);
      contacts_.push_back(one);
    }
  }

  ThreadTeam team_;
  std::vector<Cloth> cloths_;
  std::vector<ClothState> states_;
  std::vector<std::unique_ptr<Integrator>> own_;
  std::vector<Integrator*> all_;
  std::unique_ptr<JointIntegrator> joint_;
  std::vector<SharedContact> contacts_;
};

TEST(JointNewton, WhatPressesTakesAndGivesTheSameMomentum) {
  Stack stack({17, 17}, 1);
  stack.throw_at(1, {0.3F, -0.5F, 0});
  const Vec3d before = stack.momentum();
  const double energy = stack.energy();
  for (int i = 1; i <= 5; ++i) {
    stack.advance();
    const Vec3d expected = before + Vec3d{0, -9.81 * step * i * stack.mass(), 0};
    EXPECT_LT(length(stack.momentum() - expected), 1e-6 * length(before)) << i;
    EXPECT_LE(stack.energy(), energy * (1 + 1e-6));
  }
}

TEST(JointNewton, APileRestsOnWhatIsHeld) {
  Stack stack({17, 17, 17, 17}, 1);
  stack.hold(0);
  for (int i = 0; i < 240; ++i) stack.advance();
  // Each layer sinks by what the weight above it takes: less than a tenth of the gap in all.
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_LT(stack.mean_height(i), gap * static_cast<double>(i));
    EXPECT_GT(stack.mean_height(i), gap * (static_cast<double>(i) - 0.1));
  }
  const double energy = stack.energy();
  stack.advance();
  EXPECT_LT(std::abs(stack.energy() - energy), 1e-9 * stack.mass() * 9.81);
}

TEST(JointNewton, ThreadsAndInstructionSetsGiveTheSameBits) {
  for (const std::vector<int>& sizes : {std::vector{17, 24, 17}, std::vector{17, 97}}) {
    std::string first;
    for (const InstructionSet set : instruction_sets())
      for (const int threads : {1, 2, 3, 7}) {
        if (!has_instruction_set(set)) continue;
        Stack stack(sizes, {threads, set});
        stack.throw_at(1, {0.2F, -0.4F, 0});
        for (int i = 0; i < 4; ++i) stack.advance();
        if (first.empty()) first = stack.hash();
        EXPECT_EQ(stack.hash(), first) << name_of(set) << ", " << threads;
      }
  }
}

TEST(JointNewton, OneWithoutContactsMovesAsAlone) {
  ThreadTeam team(1);
  const Cloth cloth = sheet_cloth(17, cotton);
  const auto alone = make_integrator(NewtonOptions{}, cloth, {}, team);
  const auto joined = make_integrator(NewtonOptions{}, cloth, {}, team);
  Integrator* const all[] = {joined.get()};
  const auto joint = joined->join(all, team);
  ClothState a = rest_state(cloth), b = rest_state(cloth);
  shake(cloth, 0.1 * cloth.rest_spacing, a.position);
  b.position = a.position;
  const std::span<const Contact> none;
  for (int i = 0; i < 5; ++i) {
    alone->begin({.time_step = step}, a);
    alone->iterate(none);
    alone->end(a);
    joined->begin({.time_step = step}, b);
    joint->iterate(std::span(&none, 1), {});
    joined->end(b);
  }
  EXPECT_EQ(hash_of(a), hash_of(b));
}

TEST(JointNewton, VelocitiesFollowAGuessThatWasTakenBack) {
  ThreadTeam team(1);
  const Cloth cloth = sheet_cloth(9, cotton);
  const auto integrator = make_integrator(NewtonOptions{}, cloth, {}, team);
  ClothState state = rest_state(cloth);
  for (int s = 0; s < 81; ++s) state.velocity.set(s, {0, -4, 0});
  // Half a step's way below is an obstacle: guesses are put on it, contacts say so.
  integrator->begin({.time_step = step, .gravity = {}}, state);
  std::vector<Contact> contacts(81);
  ClothState& guess = integrator->proposal();
  for (int s = 0; s < 81; ++s) {
    const float height = state.position.at(s).y - static_cast<float>(2 * step);
    Vec3f at = guess.position.at(s);
    at.y = height;
    guess.position.set(s, at);
    contacts[s].samples[0] = s;
    contacts[s].normal = {0, 1, 0};
    contacts[s].offset = height;
  }
  integrator->iterate(contacts);
  // It comes to rest there, not beyond it by what was taken back.
  for (int s = 0; s < 81; ++s)
    EXPECT_NEAR(guess.position.at(s).y - contacts[s].offset, 0, 0.2 * 2 * step) << s;
}

}  // namespace
}  // namespace weft
