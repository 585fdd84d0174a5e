#include "weft/collide/contacts/contact_finder.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft::contact_finder_test {
namespace {

using test::pyramid;
using test::TestCloth;

constexpr double step = 1.0 / 240;
constexpr int n = 17, middle = n / 2;

/// A ball of 20 cm whose top is at the height 0, over the ground.
Obstacles ball() {
  Obstacles obstacles;
  obstacles.bodies.push_back(test::octahedral_sphere(33, 0.1, {0, -0.1, 0}));
  obstacles.bodies.back().friction = 0.3;
  obstacles.ground = -0.2;
  return obstacles;
}

/// Two sheets of 40 cm, and the search for their contacts alone.
class Sheets {
 public:
  Sheets() {
    place(0, 0.5);
    place(1, 1);
    std::vector<const SurfaceGrid*> grids;
    for (const WorldCloth& cloth : world_.cloths) grids.push_back(&cloth.grid);
    untangler_.set_up(grids, properties_);
  }
  void place(std::size_t cloth, double height) {
    const double aside = cloth == 0 ? 0 : 0.009;  // no samples over samples
    cloths_[cloth].place([&](int r, int c) {
      return Vec3d{0.025 * (c - middle) + aside, height, 0.025 * (r - middle) - aside};
    });
  }
  void propose(std::size_t cloth, Vec3f way) {
    for (int s = 0; s < n * n; ++s) propose(cloth, s, way);
  }
  void propose(std::size_t cloth, int sample, Vec3f way) {
    cloths_[cloth].position.set(sample, cloths_[cloth].start.at(sample) + way);
  }
  void find() {
    const std::vector<MovingCloth> moving = gather();
    world_.place_bodies(team_);
    world_.refit(team_);
    finder.find_with_bodies(moving, step, team_);
    finder.find_between_cloths(moving, step, untangler_, team_);
    finder.take_ends(moving);
  }
  void find_again() {
    const std::vector<MovingCloth> moving = gather();
    world_.refit(team_);
    finder.find_with_bodies(moving, step, team_);
    finder.find_where_moved(moving, step, untangler_, team_);
  }

 private:
  std::vector<MovingCloth> gather() {
    std::vector<MovingCloth> moving{cloths_[0].moving(), cloths_[1].moving()};
    world_.gather_surfaces(moving);
    return moving;
  }
  std::vector<CollidingCloth> both() {
    std::vector<CollidingCloth> sheets;
    while (sheets.size() < 2)
      sheets.push_back({.mates = none_,
                        .size = n,
                        .thickness = 0.002,
                        .friction = 0.3,
                        .rest_spacing = 0.025,
                        .self_collision = true,
                        .self_thickness = 0.002});
    return sheets;
  }

  std::array<TestCloth, 2> cloths_{TestCloth(n), TestCloth(n)};
  BorderMates none_;
  std::vector<CollidingCloth> properties_ = both();
  Obstacles obstacles_ = ball();
  ThreadTeam team_{2};
  CollisionWorld world_{pyramid, obstacles_, properties_};
  Untangler untangler_;

 public:
  ContactFinder finder{world_, obstacles_};
};

TEST(ContactFinder, FindsNothingFarFromEverything) {
  Sheets sheets;
  sheets.find();
  EXPECT_TRUE(sheets.finder.contacts(0).empty());
  EXPECT_FALSE(sheets.finder.anything_near());
  EXPECT_EQ(sheets.finder.self_contacts(), 0);
}

TEST(ContactFinder, ContactsWithABodyComeFirstAndPointAway) {
  Sheets sheets;
  sheets.place(0, 0.003);
  sheets.place(1, 0.005);
  sheets.propose(0, {0, -0.004F, 0});
  sheets.find();
  ASSERT_FALSE(sheets.finder.hard_contacts(0).empty());
  EXPECT_TRUE(sheets.finder.anything_near());
  for (const Contact& contact : sheets.finder.hard_contacts(0)) {
    EXPECT_GT(contact.normal.y, 0.9F);
    EXPECT_NEAR(length(contact.normal), 1, 1e-5);
    EXPECT_NEAR(contact.friction, 0.3F, 1e-6);
    EXPECT_EQ(contact.weights[0] + contact.weights[1] + contact.weights[2] + contact.weights[3], 1);
  }
  EXPECT_TRUE(sheets.finder.hard_contacts(1).empty());
}

TEST(ContactFinder, ContactsBetweenClothsAreSharedWhereThatIsAsked) {
  for (const bool shared : {false, true}) {
    Sheets sheets;
    sheets.finder.share(shared);
    sheets.place(1, 0.5025);
    sheets.propose(1, {0, -0.002F, 0});
    sheets.find();
    EXPECT_GT(sheets.finder.self_contacts(), 0);
    EXPECT_EQ(sheets.finder.shared().empty(), !shared);
    EXPECT_EQ(sheets.finder.contacts(0).empty(), shared);
    for (const SharedContact& one : sheets.finder.shared()) {
      const auto& w = one.contact.weights;
      EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 0, 1e-6);
      EXPECT_NE(one.first, one.second);
    }
  }
}

TEST(ContactFinder, OfOtherProposalsFindsAnewWhatEndsElsewhere) {
  Sheets sheets;
  sheets.finder.share(true);
  sheets.place(1, 0.5025);
  sheets.propose(1, {0, -0.002F, 0});
  sheets.find();
  const std::size_t all = sheets.finder.shared().size();
  sheets.propose(1, {1e-5F, -0.002F, 0});  // as good as there
  sheets.find_again();
  EXPECT_EQ(sheets.finder.shared().size(), all);
  sheets.propose(1, {0, 0.2F, 0});
  sheets.find_again();
  EXPECT_LT(sheets.finder.shared().size(), all);
}

TEST(ContactFinder, TakesWhatTheFilterAsksFor) {
  Sheets sheets;
  sheets.find();
  StruckContact struck;
  struck.body = 0;
  struck.compliance = 1;
  struck.shared.contact.samples[0] = 5;
  struck.shared.contact.normal = {0, 1, 0};
  sheets.finder.add_struck(std::span(&struck, 1), step);
  ASSERT_EQ(sheets.finder.contacts(0).size(), 1u);
  EXPECT_EQ(sheets.finder.contacts(0)[0].samples[0], 5);
  EXPECT_TRUE(sheets.finder.contacts(1).empty());
}

}  // namespace
}  // namespace weft::contact_finder_test
