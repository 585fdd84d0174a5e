#include "weft/cloth/newton/contact_system.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"

namespace weft {
namespace {

using testing::sheet_cloth;

/// A flat sheet at height 0 and contacts of its samples with a floor, all by themselves.
class SheetOnFloor {
 public:
  static constexpr int n = 9;
  static constexpr double time_step = 1.0 / 240;
  SheetOnFloor() {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        const Vec3f p = cloth_.rest.at(r * n + c);
        put(start_, r, c, p);
        put(position_, r, c, p);
        for (const int block : {0, 3, 5}) diagonal_(r, c, block) = spring;
      }
  }
  /// A contact of a sample with a floor at a height, which moves.
  void add(int sample, float height, float friction = 0, Vec3f floor_moves = {}) {
    Contact contact;
    contact.samples[0] = sample;
    contact.normal = {0, 1, 0};
    contact.offset = height;
    contact.friction = friction;
    contact.surface_displacement = floor_moves;
    contacts_.push_back(contact);
  }
  /// Linearises where the sheet has moved to, and decides.
  void choose_at(Vec3f moved) {
    for (int s = 0; s < n * n; ++s) put(position_, s / n, s % n, cloth_.rest.at(s) + moved);
    const ContactSystem::Own own{contacts_, &start_, &history_};
    system.set_contacts(std::span(&own, 1), {}, {.time_step = time_step});
    run([&](Worker& worker) {
      system.hold(0, diagonal_, worker);
      system.place(position(), worker);
      system.choose(nullptr, worker);
    });
  }
  [[nodiscard]] double energy(Vec3f step, float part = 1) {
    set_step(step);
    double found = 0;
    run([&](Worker& worker) { found = system.energy(this->step(), part, worker); });
    return found;
  }
  [[nodiscard]] Vec3d force(Vec3f step) {
    set_step(step);
    Vec3d found;
    run([&](Worker& worker) { found = system.obstacle_force(this->step(), worker); });
    return found;
  }
  [[nodiscard]] double work(Vec3f step) {
    set_step(step);
    double found = 0;
    run([&](Worker& worker) { found = system.work(this->step(), worker); });
    return found;
  }
  [[nodiscard]] double work_on_cloths(Vec3f step) {
    set_step(step);
    double found = 0;
    run([&](Worker& worker) { found = system.work_on_cloths(this->step(), worker); });
    return found;
  }
  /// Decides anew after a step.
  void choose_after(Vec3f moved) {
    set_step(moved);
    const ContactSystem::Fields steps = step();
    run([&](Worker& worker) { system.choose(&steps, worker); });
  }
  [[nodiscard]] PastContact measured() {
    run([&](Worker& worker) { system.measure(position(), worker); });
    ContactHistory history;
    system.remember(0, history);
    history.accept();
    return history.past().front();
  }

 private:
  static void put(PaddedVectors& field, int r, int c, Vec3f p) {
    field.x(r, c) = p.x;
    field.y(r, c) = p.y;
    field.z(r, c) = p.z;
  }
  void set_step(Vec3f step) {
    for (int s = 0; s < n * n; ++s) put(step_, s / n, s % n, step);
  }
  [[nodiscard]] ContactSystem::Fields position() const { return positions_; }
  [[nodiscard]] ContactSystem::Fields step() const { return steps_; }
  template <class Act>
  void run(const Act& act) {
    ThreadTeam team(2);
    team.run([&](Worker& worker) { act(worker); });
  }

  static constexpr float spring = 3000;  // [N/m]
  Cloth cloth_ = sheet_cloth(n);
  std::array<const Cloth*, 1> cloths_{&cloth_};
  PaddedVectors start_{n, n}, position_{n, n}, step_{n, n};
  std::array<const PaddedVectors*, 1> positions_{&position_}, steps_{&step_};
  PlaneSet diagonal_{n, n, 6};
  ContactHistory history_;
  std::vector<Contact> contacts_;

 public:
  ContactSystem system{cloths_};
};

TEST(ContactSystem, HoldsWhatWouldBeBeyondItsPlaneAlone) {
  SheetOnFloor sheet;
  sheet.add(3, -0.001F);
  sheet.add(40, -0.003F);
  sheet.choose_at({0, -0.002F, 0});
  EXPECT_EQ(sheet.system.active(), 1);
  EXPECT_TRUE(sheet.system.is_held(0));
  EXPECT_FALSE(sheet.system.is_shared());
  const Vec3d force = sheet.force({});
  EXPECT_GT(force.y, 0);
  EXPECT_EQ(force.x, 0);
  EXPECT_GT(sheet.energy({}), 0);
  EXPECT_EQ(sheet.energy({0, 0.002F, 0}), 0);  // back over both planes
}

TEST(ContactSystem, ForcesAreTheSlopesOfItsEnergy) {
  SheetOnFloor sheet;
  sheet.add(3, 0, 0.5F);
  sheet.add(40, 0, 0.2F);
  sheet.choose_at({1e-6F, -1e-4F, 0});
  ASSERT_EQ(sheet.system.active(), 2);
  const Vec3f at{1e-5F, -2e-5F, -3e-5F};
  constexpr float little = 4e-6F;
  for (const Vec3f along : {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}) {
    const double slope =
        (sheet.energy(at + little * along) - sheet.energy(at - little * along)) / (2 * little);
    const double force = dot(sheet.force(at), vec_cast<double>(along));
    EXPECT_NEAR(-slope, force, 2e-3 * length(sheet.force(at)));
  }
}

TEST(ContactSystem, PartOfAStepCostsWhatAStepOfThatLengthDoes) {
  SheetOnFloor sheet;
  sheet.add(3, 0, 0.5F);
  sheet.choose_at({0, -1e-4F, 0});
  EXPECT_NEAR(sheet.energy({4e-5F, -4e-5F, 0}, 0.5F), sheet.energy({2e-5F, -2e-5F, 0}), 1e-9);
  EXPECT_GT(sheet.energy({0, -4e-5F, 0}), sheet.energy({}));
}

TEST(ContactSystem, MovingObstaclesWorkByTheirForce) {
  SheetOnFloor sheet;
  const Vec3f up{0, 2e-4F, 0};
  sheet.add(3, 1e-4F, 0, up);
  sheet.choose_at({});
  ASSERT_EQ(sheet.system.active(), 1);
  EXPECT_GT(sheet.work({}), 0);
  EXPECT_NEAR(sheet.work({}), dot(sheet.force({}), vec_cast<double>(up)), 1e-9);
}

TEST(ContactSystem, ItsForcesWorkOnClothByTheirMeanBetweenChoices) {
  SheetOnFloor sheet;
  sheet.add(3, 0, 0.5F);
  sheet.add(40, -2e-4F);
  sheet.choose_at({0, -1e-4F, 0});
  ASSERT_EQ(sheet.system.active(), 1);
  EXPECT_EQ(sheet.work_on_cloths({}), 0);
  const Vec3f down{2e-5F, -3e-4F, 0}, back{0, 5e-5F, 0};
  const auto mean_work = [&](Vec3f from, Vec3f to) {
    return dot(0.5 * (sheet.force(from) + sheet.force(to)), vec_cast<double>(to - from));
  };
  const double first = mean_work({}, down);
  EXPECT_LT(first, 0);
  EXPECT_NEAR(sheet.work_on_cloths(down), first, 1e-5 * std::abs(first));
  sheet.choose_after(down);  // where the floor holds the other point as well
  ASSERT_EQ(sheet.system.active(), 2);
  const double second = mean_work(down, back);
  EXPECT_GT(second, 0);
  EXPECT_NEAR(sheet.work_on_cloths(back), first + second, 1e-5 * second);
}

TEST(ContactSystem, FrictionStaysWithinItsCone) {
  for (const float friction : {0.1F, 0.4F, 1.0F}) {
    SheetOnFloor sheet;
    sheet.add(3, 0, friction);
    sheet.choose_at({2e-3F, -1e-4F, 0});
    const PastContact measured = sheet.measured();
    EXPECT_GT(measured.force, 0);
    EXPECT_LT(measured.friction.x, 0);
    EXPECT_LE(length(measured.friction), 1.001F * friction * measured.force);
    EXPECT_EQ(measured.friction.y, 0);
  }
}

}  // namespace
}  // namespace weft
