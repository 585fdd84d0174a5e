#include "apps/viewer/colouring.h"

#include <gtest/gtest.h>

#include "apps/viewer/scene_view.h"
#include "tests/view/shapes.h"
#include "weft/image/builtin.h"

namespace weft::viewer {
namespace {

constexpr int n = 33;

TEST(Colouring, StretchedClothIsRedAndShortenedClothIsBlue) {
  Planes3 colours;
  colour_strain(Grid<float>(n, n, 0.04F), 0, colours);
  EXPECT_GT(colours.at(10, 10).x, 2 * colours.at(10, 10).z);
  colour_strain(Grid<float>(n, n, -0.04F), 0, colours);
  EXPECT_GT(colours.at(10, 10).z, 2 * colours.at(10, 10).x);
  colour_strain(Grid<float>(n, n, 0), 0, colours);
  EXPECT_NEAR(colours.at(10, 10).x, colours.at(10, 10).z, 0.1);
}

TEST(Colouring, LargerResidualsAreDarker) {
  Grid<float> sizes(n, n, 1e-8F);
  sizes(3, 4) = 1e-3F;
  sizes(5, 6) = 0.5F;
  Planes3 colours;
  colour_residual(sizes, colours);
  EXPECT_GT(colours.at(0, 0).y, colours.at(3, 4).y);
  EXPECT_GT(colours.at(3, 4).y, colours.at(5, 6).y);
}

TEST(Colouring, ContactsOfBodiesAndOfClothDiffer) {
  std::vector<Contact> contacts(2);
  contacts[0].samples = {7, 0, 0, 0};
  contacts[1].samples = {20, 50, 0, 0};
  contacts[1].weights = {1, -1, 0, 0};
  Planes3 colours;
  colour_contacts(contacts, n, colours);
  EXPECT_NE(colours.at(7), colours.at(20));
  EXPECT_EQ(colours.at(20), colours.at(50));
  EXPECT_NE(colours.at(7), colours.at(8));
  EXPECT_EQ(colours.at(8), colours.at(0));
}

TEST(Colouring, BothSidesOfASeamHaveOneColour) {
  const GeometryImage torus = make_image_shape("torus", n);
  Planes3 colours;
  colour_mates(torus.mates, colours);
  EXPECT_EQ(colours.at(0, n / 2), colours.at(n - 1, n / 2));
  EXPECT_EQ(colours.at(n / 2, 0), colours.at(n / 2, n - 1));
  EXPECT_NE(colours.at(0, n / 2), colours.at(n / 2, 0));
  const GeometryImage sheet = make_image_shape("sheet", n);
  colour_mates(sheet.mates, colours);
  EXPECT_EQ(colours.at(0, n / 2), colours.at(n / 2, 0));
  EXPECT_NE(colours.at(0, n / 2), colours.at(n / 2, n / 2));
}

TEST(Colouring, ACellOfALevelHasOneColourAndItsNeighbourAnother) {
  Planes3 colours;
  colour_mip(3, n, colours);
  EXPECT_EQ(colours.at(0, 0), colours.at(7, 7));
  EXPECT_NE(colours.at(7, 7), colours.at(7, 8));
  EXPECT_NE(colours.at(7, 7), colours.at(8, 7));
}

TEST(Colouring, EvenStepsAreWhiteAndLongOnesRed) {
  Planes3 colours;
  Planes3 sheet = world_positions(make_image_shape("sheet", n));
  colour_stretch(sheet, colours);
  EXPECT_NEAR(colours.at(9, 9).x, colours.at(9, 9).z, 0.05);
  for (int r = 0; r < n; ++r) {
    const Vec3f last = sheet.at(r, n - 1);
    sheet.set(r, n - 1, {last.x + 2, last.y, last.z});
  }
  colour_stretch(sheet, colours);
  EXPECT_GT(colours.at(9, n - 1).x, 1.5F * colours.at(9, n - 1).z);
}

TEST(Colouring, ImagesHaveTheirOwnUntilSomethingElseIsAskedFor) {
  Subject subject;
  const BorderMates mates(n, {});
  subject.cloths = {{"cloth", mates, {}, Planes3(n), true, Planes3(n)}};
  subject.bodies = {{"painted", mates, {}, Planes3(n), false, Planes3(n)},
                    {"plain", mates, {}, Planes3(n), false, {}}};
  Snapshot snapshot;
  snapshot.subject = std::make_shared<const Subject>(subject);
  snapshot.cloths = {Planes3(n)};
  snapshot.bodies.resize(2);
  snapshot.colours.resize(1);
  const DrawnScene own = drawn_scene(snapshot, {});
  EXPECT_EQ(own.surfaces[0].colours, &snapshot.subject->cloths[0].colours);
  EXPECT_EQ(own.surfaces[1].colours, &snapshot.subject->bodies[0].colours);
  EXPECT_EQ(own.surfaces[1].colour, (Vec3f{1, 1, 1}));
  EXPECT_EQ(own.surfaces[2].colours, nullptr);
  snapshot.colours[0] = Planes3(n);
  EXPECT_EQ(drawn_scene(snapshot, {}).surfaces[0].colours, &snapshot.colours[0]);
}

}  // namespace
}  // namespace weft::viewer
