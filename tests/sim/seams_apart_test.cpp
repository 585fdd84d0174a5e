#include "weft/sim/sewing/seams_apart.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/garment.h"
#include "weft/sim/sewing/near_classes.h"
#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// Trousers where their pattern places them, but for the left leg.
struct Trousers {
  /// @param left  how far that is to the right of its place [m]
  explicit Trousers(float left)
      : garment(make_garment(parse_pattern(test::trousers_pattern(), "pattern"), "pattern", 0.01)),
        position(garment.flat.size()) {
    const int n = garment.flat.size();
    for (int s = 0; s < n * n; ++s) {
      const auto place = vec_cast<float>(garment.image.world_position(s / n, s % n));
      position.set(s, place - Vec3f{is_left(s) ? left : 0, 0, 0});
    }
  }
  [[nodiscard]] bool is_left(int sample) const {
    const int panel = panel_of(garment.image.mates, sample);
    return panel >= 0 && garment.image.mates.charts()[panel].name.find("left") != std::string::npos;
  }
  Garment garment;
  Planes3 position;
};

TEST(SeamsApart, KeepsTheSeamsOfTwoLegsApart) {
  const Trousers placed(0), swung(0.01F);
  SeamsApart seams(placed.garment, placed.position);
  seams.find(swung.position, 0.005);
  ASSERT_GT(seams.contacts().size(), 30U);
  for (const Contact& contact : seams.contacts()) {
    const float side = contact.weights[0] * (swung.is_left(contact.samples[0]) ? 1 : -1);
    EXPECT_EQ(swung.is_left(contact.samples[0]), swung.is_left(contact.samples[1]));
    EXPECT_NE(swung.is_left(contact.samples[0]), swung.is_left(contact.samples[2]));
    EXPECT_GT(side * contact.normal.x, 0.29F);
    EXPECT_NEAR(contact.offset, 0.01, 1e-5);
    for (const int s : contact.samples) EXPECT_LT(swung.position.at(s).y, 0.7F - 0.015F);
  }
}

TEST(SeamsApart, LeavesSeamsThatAreFarApartOrPastEachOther) {
  const Trousers placed(0), past(0.03F);
  SeamsApart seams(placed.garment, placed.position);
  seams.find(placed.position, 0.005);
  EXPECT_TRUE(seams.contacts().empty());
  seams.find(past.position, 0.005);
  EXPECT_TRUE(seams.contacts().empty());
}

/// Where both seams are closed nothing can come between their edges.
TEST(SeamsApart, LeavesClosedSeams) {
  const Trousers placed(0);
  Trousers swung(0.01F);
  SeamsApart seams(placed.garment, placed.position);
  for (const int leg : {0, 2})
    for (const auto& [a, b] : placed.garment.seams[leg].pairs)
      swung.position.set(a, swung.position.at(b));
  seams.find(swung.position, 0.005);
  EXPECT_TRUE(seams.contacts().empty());
}

TEST(NearClasses, AreFoundAlongTheSewnCloth) {
  const Trousers trousers(0);
  const Garment& garment = trousers.garment;
  const auto class_at = [&](std::size_t seam, std::size_t pair) {
    for (int k = 0; k < garment.sewn.class_count(); ++k)
      for (const int s : garment.sewn.copies(k))
        if (s == garment.seams[seam].pairs[pair][0]) return k;
    return -1;
  };
  const std::vector<std::vector<int>> near = near_classes(garment, 0.045);
  const auto are_near = [&](int a, int b) {
    return std::binary_search(near[a].begin(), near[a].end(), b);
  };
  const std::size_t last = garment.seams[0].pairs.size() - 1;
  // From the crotch down both inner seams are two ways apart.
  EXPECT_EQ(class_at(0, 0), class_at(2, last));
  EXPECT_TRUE(are_near(class_at(0, 2), class_at(2, last - 2)));
  EXPECT_FALSE(are_near(class_at(0, 3), class_at(2, last - 2)));
  EXPECT_TRUE(are_near(class_at(0, 0), class_at(0, 4)));
  EXPECT_FALSE(are_near(class_at(0, 0), class_at(0, 5)));
  for (int k = 0; k < garment.sewn.class_count(); ++k) EXPECT_TRUE(are_near(k, k));
}

}  // namespace
}  // namespace weft
