#include "weft/cloth/newton/contact_history.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

Contact contact(std::array<int, 4> samples, std::array<float, 4> weights, Vec3f normal) {
  Contact made;
  made.samples = samples;
  made.weights = weights;
  made.normal = normal;
  return made;
}

Contact on_vertex(int sample, Vec3f normal) { return contact({sample}, {1}, normal); }

PastContact pressing(float force) {
  PastContact done;
  done.force = force;
  return done;
}

TEST(ContactHistory, FindsWhatTheAcceptedStepDid) {
  ContactHistory history;
  const Contact floor = on_vertex(7, {0, 1, 0});
  history.add(floor, -1, pressing(3));
  EXPECT_EQ(history.find(floor, -1), nullptr);  // not accepted yet
  history.accept();
  ASSERT_NE(history.find(floor, -1), nullptr);
  EXPECT_EQ(history.find(floor, -1)->force, 3);
}

TEST(ContactHistory, ForgetsAStepThatIsStartedAnew) {
  ContactHistory history;
  history.add(on_vertex(7, {0, 1, 0}), -1, pressing(3));
  history.start_step();
  history.accept();
  EXPECT_TRUE(history.past().empty());
}

TEST(ContactHistory, TellsApartBySamplesClothAndNormal) {
  ContactHistory history;
  const Contact floor = on_vertex(7, {0, 1, 0}), wall = on_vertex(7, {1, 0, 0});
  const Contact layer = contact({7, 8, 9, 10}, {1, -0.25F, -0.25F, -0.5F}, {0, 1, 0});
  history.add(floor, -1, pressing(1));
  history.add(wall, -1, pressing(2));
  history.add(layer, 2, pressing(3));
  history.accept();
  EXPECT_EQ(history.find(floor, -1)->force, 1);
  EXPECT_EQ(history.find(wall, -1)->force, 2);
  EXPECT_EQ(history.find(on_vertex(7, {0.8F, 0.6F, 0}), -1)->force, 2);  // the closest normal
  EXPECT_EQ(history.find(layer, 2)->force, 3);
  EXPECT_EQ(history.find(layer, 1), nullptr);
  EXPECT_EQ(history.find(on_vertex(8, {0, 1, 0}), -1), nullptr);
  EXPECT_EQ(history.find(on_vertex(7, {0, -1, 0}), -1), nullptr);
}

TEST(ContactHistory, SamplesWithoutWeightDoNotCount) {
  ContactHistory history;
  Contact edge = contact({4, 5, 6, 7}, {0.5F, 0.5F, 0, 0}, {0, 1, 0});
  history.add(edge, -1, pressing(1));
  history.accept();
  edge.samples = {4, 5, 0, 0};
  EXPECT_NE(history.find(edge, -1), nullptr);
}

TEST(ContactHistory, GoesOnFromWhatWasSaved) {
  ContactHistory history, other;
  for (int sample = 0; sample < 100; ++sample)
    history.add(on_vertex(sample, {0, 1, 0}), -1, pressing(static_cast<float>(sample)));
  history.accept();
  other.restore(history.past());
  EXPECT_EQ(other.find(on_vertex(41, {0, 1, 0}), -1)->force, 41);
}

}  // namespace
}  // namespace weft
