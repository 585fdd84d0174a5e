// Colours of a mesh in the square of its image.
#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "tests/support/convert_options.h"
#include "tests/support/errors.h"
#include "weft/convert.h"
#include "weft/core/random.h"
#include "weft/error.h"
#include "weft/image_file.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using test::unmeasured;

/// A colour that is linear in space, within the cube of a mesh.
Vec3f colour_at(Vec3d p) {
  return vec_cast<float>(Vec3d{0.5 + 0.4 * p.x, 0.5 + 0.3 * p.y, 0.5 - 0.4 * p.z});
}

std::shared_ptr<const SurfaceColours> linear_colours_of(const TriangleMesh& mesh) {
  auto colours = std::make_shared<SurfaceColours>();
  colours->part_of.assign(mesh.triangles.size(), -1);
  for (const auto& [a, b, c] : mesh.triangles)
    colours->corners.push_back(
        {colour_at(mesh.positions[a]), colour_at(mesh.positions[b]), colour_at(mesh.positions[c])});
  return colours;
}

/// Turns some triangles over and renumbers corners, as files do whose triangles do not agree.
TriangleMesh disordered(TriangleMesh mesh) {
  Random random(5);
  for (Triangle& t : mesh.triangles) {
    if (random.uniform(0, 1) < 0.3) std::swap(t[0], t[1]);
    if (random.uniform(0, 1) < 0.5) std::rotate(t.begin(), t.begin() + 1, t.end());
  }
  return mesh;
}

Conversion coloured(const TriangleMesh& mesh, int size) {
  ConvertOptions options = unmeasured(size);
  options.colours = linear_colours_of(mesh);
  return convert_mesh(mesh, "mesh", options);
}

/// The largest difference from the colours that belong to the samples' places.
double largest_error(const Conversion& made) {
  double largest = 0;
  const int n = made.image.size(), scale = (made.colour_map->size() - 1) / (n - 1);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      if (made.image.mates.is_hole(r * n + c)) continue;
      const Vec3f wanted = colour_at(made.image.world_position(r, c));
      const Vec3f off = made.colour_map->at(scale * r, scale * c) - wanted;
      largest = std::max(
          {largest, std::abs(double{off.x}), std::abs(double{off.y}), std::abs(double{off.z})});
    }
  return largest;
}

TEST(BakeColours, AreThoseOfTheSamplesPlacesWhateverTheOrderOfCorners) {
  EXPECT_LT(largest_error(coloured(disordered(make_shape("torus")), 65)), 1e-5);
}

TEST(BakeColours, AreInEveryChart) {
  TriangleMesh mesh = make_shape("sphere");
  const auto first = static_cast<int>(mesh.positions.size());
  const TriangleMesh one = mesh;
  for (const Vec3d p : one.positions) mesh.positions.push_back(0.4 * p + Vec3d{0.1, 1, 0});
  for (const auto& [a, b, c] : one.triangles)
    mesh.triangles.push_back({a + first, b + first, c + first});
  const Conversion made = coloured(mesh, 97);
  EXPECT_EQ(made.charts.size(), 2U);
  EXPECT_LT(largest_error(made), 1e-5);
}

TEST(BakeColours, MatesHoldEqualBitsAndTheFileGivesThemBack) {
  const Conversion made = coloured(make_shape("torus"), 65);
  const GeometryImage read = parse_image(exr_bytes(made.image), "a.exr");
  ASSERT_TRUE(read.has_colours());
  EXPECT_EQ(exr_bytes(read), exr_bytes(made.image));
  for (int s = 0; s < 65 * 65; ++s) {
    const int other = read.mates.representative(s);
    EXPECT_EQ(read.colours.at(s), read.colours.at(other));
    EXPECT_EQ(made.image.colours.at(s), made.image.colours.at(other));
    const Vec3f off = read.colours.at(s) - made.image.colours.at(s);
    EXPECT_LT(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), 3e-4) << "half floats";
  }
}

TEST(BakeColours, LeavePositionsAsTheyAre) {
  const TriangleMesh mesh = make_shape("torus");
  Conversion made = coloured(mesh, 65);
  made.image.colours = {};
  EXPECT_EQ(exr_bytes(made.image), exr_bytes(convert_mesh(mesh, "mesh", unmeasured(65)).image));
}

TEST(BakeColours, CoarserLevelsAndRebuiltMeshesHaveThem) {
  const Conversion made = coloured(make_shape("torus"), 65);
  const std::optional<GeometryImage> coarse = coarser_image(made.image, 1);
  ASSERT_TRUE(coarse && coarse->has_colours());
  EXPECT_EQ(coarse->colours.at(16, 16), made.image.colours.at(32, 32));
  const RebuiltMesh rebuilt = rebuild_mesh(made.image);
  const std::vector<Vec3f> colours = vertex_colours(made.image, rebuilt);
  ASSERT_EQ(colours.size(), rebuilt.mesh.positions.size());
  for (std::size_t v = 0; v < colours.size(); ++v) {
    const Vec3f off = colours[v] - colour_at(rebuilt.mesh.positions[v]);
    EXPECT_LT(length(vec_cast<double>(off)), 0.02) << "means of what lies around";
  }
}

TEST(BakeColours, OfAnotherMeshAreRefused) {
  const TriangleMesh mesh = make_shape("torus");
  ConvertOptions options = unmeasured(33);
  options.colours = linear_colours_of(make_shape("sphere"));
  EXPECT_NE(
      test::message_of<UsageError>([&] { convert_mesh(mesh, "mesh", options); }).find("are wanted"),
      std::string::npos);
}

TEST(BakeColours, OutOfRangeInAnImageAreRefused) {
  GeometryImage image = coloured(make_shape("torus"), 33).image;
  image.colours.set(3, 4, {0.5F, 1.5F, 0});
  EXPECT_EQ(test::message_of<InputError>([&] { check_image(image, "a"); }),
            "a: the colour of row 3, column 4; red, green and blue from 0 to 1 are wanted");
  image.colours = Planes3(17);
  EXPECT_EQ(test::message_of<InputError>([&] { check_image(image, "a"); }),
            "a: colours of a side of 17; 33 is wanted");
}

}  // namespace
}  // namespace weft
