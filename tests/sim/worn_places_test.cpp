#include "weft/sim/sewing/worn_places.h"

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/image/builtin.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

/// A top and a skirt with labels of their own, and a torus that wears them.
class WornBy : public ::testing::Test {
 protected:
  WornBy() { wear(test::top_and_skirt("collar", "lower_interface")); }

  void wear(const std::string& pattern) {
    garment = make_garment(parse_pattern(pattern, "pattern"), "pattern", 0.02);
    placed = placed_positions(garment.image, placement_map({}));
    bodies.resize(1);
    bodies[0].image = make_image_shape("torus", 33);
    bodies[0].positions = placed_positions(bodies[0].image, placement_map({}));
    const std::vector<TiedSurface> surfaces = {
        {"figure", &bodies[0].positions, grid_triangles(bodies[0].image)}};
    worn = WornPlaces(garment, placed, surfaces);
  }
  void lower(float by, std::span<const int> samples) {
    for (const int s : samples) placed.set(s, placed.at(s) - Vec3f{0, by, 0});
  }
  void lower_all(float by) {
    for (int s = 0; s < placed.size() * placed.size(); ++s)
      placed.set(s, placed.at(s) - Vec3f{0, by, 0});
  }
  void lower_body(double by) {
    bodies[0].positions =
        placed_positions(bodies[0].image, placement_map({{1, 1, 1}, {}, {0, -by, 0}}));
  }
  [[nodiscard]] double sunk() const { return worn.sunk(placed, bodies); }

  Garment garment;
  Planes3 placed;
  std::vector<PlacedBody> bodies;
  WornPlaces worn;
};

TEST_F(WornBy, SinksAsItsLabelThatSinksTheMost) {
  EXPECT_NEAR(sunk(), 0, 1e-5);
  ASSERT_EQ(garment.labels.size(), 2);
  EXPECT_EQ(garment.labels[0].name, "lower_interface");
  lower(0.3F, garment.labels[0].samples);
  EXPECT_NEAR(sunk(), 0.3, 1e-5) << "a skirt, its top still in its place";
}

TEST_F(WornBy, GoesWithItsBody) {
  lower_body(0.4);
  EXPECT_NEAR(sunk(), 0, 1e-5) << "higher than it is worn";
  lower_all(0.4F);
  EXPECT_NEAR(sunk(), 0, 1e-5);
  lower_body(0);
  EXPECT_NEAR(sunk(), 0.4, 1e-5);
}

TEST_F(WornBy, GarmentsWithoutLabelsSinkAsAWhole) {
  wear(test::top_and_skirt("", ""));
  EXPECT_TRUE(garment.labels.empty());
  lower_all(0.5F);
  EXPECT_NEAR(sunk(), 0.5, 1e-5);
}

TEST_F(WornBy, PanelsWithoutLabelsAndSeamsSinkAsAWhole) {
  wear(test::loose_square());
  ASSERT_EQ(garment.sewn.class_count(), 0) << "one chart that fills the image";
  EXPECT_NEAR(sunk(), 0, 1e-5);
  lower_all(0.5F);
  EXPECT_NEAR(sunk(), 0.5, 1e-5);
}

TEST_F(WornBy, HolesBetweenPanelsCountForNothing) {
  wear(test::top_and_skirt("", ""));
  for (int s = 0; s < placed.size() * placed.size(); ++s)
    if (garment.sewn.is_hole(s)) lower(0.5F, std::span(&s, 1));
  EXPECT_NEAR(sunk(), 0, 1e-5);
}

TEST_F(WornBy, NobodyKeepsThePlacesOfThePattern) {
  bodies.clear();
  worn = WornPlaces(garment, placed, {});
  lower_all(0.25F);
  EXPECT_NEAR(sunk(), 0.25, 1e-5);
}

}  // namespace
}  // namespace weft
