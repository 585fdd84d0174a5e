#include "weft/convert/surface_places.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/convert.h"
#include "weft/core/math.h"
#include "weft/cut/seam.h"
#include "weft/shapes.h"

namespace weft {
namespace {

ConvertOptions quick(int size) {
  ConvertOptions options;
  options.size = size;
  options.measure = false;
  return options;
}

/// Texture coordinates that are an affine function of the place.
Vec2f affine_uv(Vec3d p) {
  return {static_cast<float>(0.3 + 0.5 * p.x - 0.2 * p.z),
          static_cast<float>(0.1 * p.x + 0.4 * p.y)};
}

TriangleMesh with_affine_uv(TriangleMesh mesh) {
  for (const auto& [a, b, c] : mesh.triangles)
    mesh.corner_uv.push_back(
        {affine_uv(mesh.positions[a]), affine_uv(mesh.positions[b]), affine_uv(mesh.positions[c])});
  return mesh;
}

/// A tetrahedron, whose few triangles are split at corners, samples and chords; a torus; a shape of
/// many handles; one with true borders.
class Places : public testing::TestWithParam<std::string> {
 public:
  static TriangleMesh mesh() {
    if (GetParam() == "tetrahedron") return test::tetrahedron();
    if (GetParam() == "coarse_torus") return test::torus(5, 4);
    return make_shape(GetParam());
  }
};

TEST_P(Places, AreWhereTheSamplesAre) {
  const Conversion made = convert_mesh(mesh(), GetParam(), quick(65));
  const TriangleMesh& surface = made.input.mesh;
  for (const int size : {65, 97}) {
    const std::vector<SurfacePlace> places =
        surface_places(*made.charts[0].mapped, surface.triangles, size);
    for (int sample = 0; sample < size * size; ++sample) {
      const SurfacePlace& place = places[sample];
      Vec3d p;
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(place.weights[k], 0);
        sum += place.weights[k];
        p += place.weights[k] * surface.positions[surface.triangles.at(place.triangle)[k]];
      }
      ASSERT_NEAR(sum, 1, 1e-12);
      if (size != made.image.size()) continue;
      const Vec3d at = made.image.world_position(sample / size, sample % size);
      ASSERT_LT(length(p - at), 1e-6 * made.image.world.scale) << sample;
    }
  }
}

TEST_P(Places, TextureThatIsAffineInSpaceStaysSo) {
  ConvertOptions options = quick(65);
  options.keep_uv = true;
  const Conversion made = convert_mesh(with_affine_uv(mesh()), GetParam(), options);
  ASSERT_TRUE(made.texture.has_value());
  for (int row = 0; row < 65; ++row)
    for (int col = 0; col < 65; ++col) {
      const Vec2f expected = affine_uv(made.image.world_position(row, col));
      ASSERT_NEAR(made.texture->x(row, col), expected.x, 1e-6) << row << ' ' << col;
      ASSERT_NEAR(made.texture->y(row, col), expected.y, 1e-6) << row << ' ' << col;
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, Places,
                         testing::Values("tetrahedron", "coarse_torus", "genus20", "skirt"),
                         [](const auto& instance) { return instance.param; });

TEST(Texture, MatesAreApartWhereASeamOfTheTextureRunsAlongTheCut) {
  // A tube around which u runs from 0 to 1: the seam is the line of vertices 0, 7, 14 ...
  const int around = 7, rows = 6;
  TriangleMesh mesh;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < around; ++k)
      mesh.positions.push_back(
          {0.2 * cosine(2 * pi * k / around), 0.2 * row, -0.2 * sine(2 * pi * k / around)});
  for (int row = 0; row + 1 < rows; ++row)
    for (int k = 0; k < around; ++k) {
      const int a = row * around, b = a + around, next = (k + 1) % around;
      const auto uv = [&](int col, int at) {
        return Vec2f{static_cast<float>(col) / around, static_cast<float>(at)};
      };
      mesh.triangles.push_back({a + k, a + next, b + next});
      mesh.corner_uv.push_back({uv(k, row), uv(k + 1, row), uv(k + 1, row + 1)});
      mesh.triangles.push_back({a + k, b + next, b + k});
      mesh.corner_uv.push_back({uv(k, row), uv(k + 1, row + 1), uv(k, row + 1)});
    }
  ConvertOptions options = quick(33);
  options.keep_uv = true;
  options.seam = parse_seam("0 35", "seam.txt");
  const Conversion made = convert_mesh(mesh, "tube", options);
  EXPECT_TRUE(made.warnings.empty());
  ASSERT_GT(made.image.mates.class_count(), 3);
  for (int k = 0; k < made.image.mates.class_count(); ++k) {
    const auto mates = made.image.mates.mates(k);
    ASSERT_EQ(mates.size(), 2U);
    const Vec3f one = made.texture->at(mates[0]), other = made.texture->at(mates[1]);
    EXPECT_NEAR(std::abs(one.x - other.x), 1, 1e-6);
    EXPECT_NEAR(one.y, other.y, 1e-6);
  }
}

TEST(Texture, MeshWithoutItIsRefused) {
  ConvertOptions options = quick(33);
  options.keep_uv = true;
  EXPECT_EQ(
      test::message_of<InputError>([&] { convert_mesh(test::tetrahedron(), "bare.obj", options); }),
      "bare.obj: not every corner of its faces has texture coordinates; an OBJ with vt, a "
      "PLY with s and t or u and v, or a glTF with TEXCOORD_0 is wanted");
}

}  // namespace
}  // namespace weft
