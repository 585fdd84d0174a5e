#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/convert_options.h"
#include "weft/convert.h"
#include "weft/convert/pieces.h"
#include "weft/image_file.h"
#include "weft/mesh_statistics.h"
#include "weft/param/square_map.h"
#include "weft/shapes.h"

/// Charts of what is long.
namespace weft {
namespace {

using test::sized;
using test::unmeasured;

void add(TriangleMesh& to, const TriangleMesh& mesh, Vec3d by) {
  const auto first = static_cast<int>(to.positions.size());
  for (const Vec3d p : mesh.positions) to.positions.push_back(p + by);
  for (const auto& [a, b, c] : mesh.triangles)
    to.triangles.push_back({first + a, first + b, first + c});
}

/// A ribbon along x, 70 times longer than wide, that waves.
TriangleMesh ribbon(double length, double wave) {
  constexpr int rows = 2, cols = 240;
  TriangleMesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= cols; ++c) {
      const double u = static_cast<double>(c) / cols;
      mesh.positions.push_back({length * u, wave * std::sin(60 * u), length / 70 * r / rows});
    }
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      const int a = r * (cols + 1) + c, b = a + cols + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return mesh;
}

/// A closed box of the given extent; every side is cut into 4 x 4 quads.
TriangleMesh plate(Vec3d extent) {
  constexpr int cuts = 4;
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> number;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [found, is_new] = number.emplace(at, static_cast<int>(mesh.positions.size()));
    if (is_new)
      mesh.positions.push_back(
          {extent.x * at[0] / cuts, extent.y * at[1] / cuts, extent.z * at[2] / cuts});
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, cuts})
      for (int i = 0; i < cuts; ++i)
        for (int j = 0; j < cuts; ++j) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = a;
            at[(axis + 2) % 3] = b;
            return vertex(at);
          };
          const int a = corner(i, j), c = corner(i + 1, j + 1);
          int b = corner(i + 1, j), d = corner(i, j + 1);
          if (side == 0) std::swap(b, d);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
  return mesh;
}

/// The mean lengths of a chart's edges along rows and along columns, the longer over the shorter.
double anisotropy(const GeometryImage& image, const Chart& chart) {
  double along_rows = 0, along_cols = 0;
  for (int r = 0; r < chart.rows; ++r)
    for (int c = 0; c < chart.cols; ++c) {
      const Vec3d here = image.world_position(chart.row + r, chart.col + c);
      if (c + 1 < chart.cols)
        along_rows += length(image.world_position(chart.row + r, chart.col + c + 1) - here);
      if (r + 1 < chart.rows)
        along_cols += length(image.world_position(chart.row + r + 1, chart.col + c) - here);
    }
  along_rows /= chart.rows * (chart.cols - 1);
  along_cols /= chart.cols * (chart.rows - 1);
  return std::max(along_rows / along_cols, along_cols / along_rows);
}

void expect_sound(const Conversion& made) {
  EXPECT_EQ(made.map_quality.flipped + made.map_quality.degenerate, 0);
  EXPECT_TRUE(mates_bit_equal(made.image));
  const TriangleMesh mesh = rebuild_mesh(made.image).mesh;
  const TopologyCounts counts =
      count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles);
  EXPECT_EQ(counts.euler, made.input.counts.euler);
  EXPECT_EQ(counts.boundaries, made.input.counts.boundaries);
  EXPECT_EQ(counts.components, made.input.counts.components);
}

int rectangles_of(const Conversion& made) {
  return static_cast<int>(
      std::count_if(made.charts.begin(), made.charts.end(),
                    [](const ConvertedChart& c) { return c.place.rows != c.place.cols; }));
}

TEST(Rectangles, AStripBesideABallHasSquareCellsAndTheBallKeepsItsSquare) {
  TriangleMesh mesh = make_shape("sphere");
  add(mesh, ribbon(4, 0), {3, 0, 0});
  const Conversion made = convert_mesh(mesh, "strip", unmeasured(769));
  expect_sound(made);
  ASSERT_EQ(made.charts.size(), 2U);
  EXPECT_EQ(made.charts[0].place.rows, made.charts[0].place.cols) << "the ball";
  EXPECT_LT(anisotropy(made.image, made.charts[1].place), 1.6);
  EXPECT_GE(coarsest_level(made.image), 2);
}

TEST(Rectangles, StripsAreNearerToTheirMeshThanInSquaresOfMoreSamples) {
  TriangleMesh two = ribbon(4, 0.05);
  add(two, ribbon(4, 0.05), {0, 0, 0.3});
  const Conversion made = convert_mesh(two, "two", sized(513));
  expect_sound(made);
  ASSERT_EQ(rectangles_of(made), 2);
  const Chart& chart = made.charts[0].place;
  int side = 5;
  while (side * side < chart.rows * chart.cols) side += 4;
  ConvertOptions options = sized(side);
  options.charts = ChartChoice::one;
  const Conversion alone = convert_mesh(ribbon(4, 0.05), "one", options);
  EXPECT_LT(made.quality.from_image.rms, 0.5 * alone.quality.from_image.rms);
  EXPECT_LT(made.quality.from_mesh.rms, 0.5 * alone.quality.from_mesh.rms);
  EXPECT_LT(made.map_quality.stretch_l2, 0.5 * alone.map_quality.stretch_l2);
}

/// A band about the y axis, of the four sides of a square section; every side an island.
TriangleMesh belt() {
  constexpr int around = 200;
  constexpr double turn = 2 * 3.14159265358979 / around;
  TriangleMesh mesh;
  const std::vector<Vec2d> section{{1.6, 0}, {1.6, 0.1}, {1.5, 0.1}, {1.5, 0}};
  for (const Vec2d at : section)
    for (int j = 0; j < around; ++j)
      mesh.positions.push_back({at.x * std::cos(turn * j), at.y, -at.x * std::sin(turn * j)});
  for (int side = 0; side < 4; ++side)
    for (int j = 0; j < around; ++j) {
      const auto uv = [&](int along, int across) -> Vec2f {
        return {static_cast<float>(along) / around,
                0.1F * static_cast<float>(side) + 0.01F * static_cast<float>(across)};
      };
      const int next = (side + 1) % 4 * around, k = (j + 1) % around;
      mesh.triangles.push_back({side * around + j, side * around + k, next + k});
      mesh.corner_uv.push_back({uv(j, 0), uv(j + 1, 0), uv(j + 1, 1)});
      mesh.triangles.push_back({side * around + j, next + k, next + j});
      mesh.corner_uv.push_back({uv(j, 0), uv(j + 1, 1), uv(j, 1)});
    }
  return mesh;
}

TEST(Rectangles, IslandsOfABeltAreStripsThatFitTogether) {
  ConvertOptions options = unmeasured(1025);
  options.charts = ChartChoice::texture;
  const Conversion made = convert_mesh(belt(), "belt", options);
  expect_sound(made);
  ASSERT_EQ(made.charts.size(), 4U);
  EXPECT_EQ(rectangles_of(made), 4);
  for (const ConvertedChart& chart : made.charts) {
    EXPECT_LT(anisotropy(made.image, chart.place), 1.6);
    EXPECT_LT(chart.mapped->quality.stretch_l2, 1.25);
  }
}

TEST(Rectangles, WhatIsLongOfThirtyPiecesIsARectangle) {
  TriangleMesh mesh;
  for (int k = 0; k < 10; ++k) {
    const double z = 0.4 * k;
    add(mesh, plate({0.3, 0.3, 0.3}), {0, 0, z});
    add(mesh, plate({1.0 + 0.1 * k, 0.04, 0.1}), {0.5, 0, z});
    add(mesh, plate({0.2, 0.3, 0.2}), {2.5, 0, z});
  }
  const Conversion made = convert_mesh(mesh, "robot", unmeasured(513));
  expect_sound(made);
  ASSERT_EQ(made.charts.size(), 30U);
  for (const ConvertedChart& chart : made.charts) {
    Box3d box;
    for (const Vec3d p : chart.piece->mesh.positions) box.add(p);
    const bool is_rod = box.extent().x > 0.9;
    EXPECT_EQ(chart.place.cols > 2 * chart.place.rows, is_rod)
        << chart.place.rows << " x " << chart.place.cols;
  }
}

TEST(Rectangles, TheSameBitsEveryTimeAndForAnyNumberOfThreads) {
  TriangleMesh mesh = make_shape("sphere");
  add(mesh, ribbon(4, 0.05), {3, 0, 0});
  ConvertOptions options = unmeasured(257);
  const std::string once = exr_bytes(convert_mesh(mesh, "strip", options).image);
  for (const int threads : {1, 3}) {
    options.threads = threads;
    EXPECT_EQ(exr_bytes(convert_mesh(mesh, "strip", options).image), once) << threads;
  }
}

TEST(Rectangles, WhatGoesWithAnImageIsSampledThere) {
  TriangleMesh mesh = make_shape("sphere");
  add(mesh, ribbon(4, 0), {3, 0, 0});
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec2f, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = {static_cast<float>(mesh.positions[t[k]].x),
                    static_cast<float>(mesh.positions[t[k]].z)};
    mesh.corner_uv.push_back(corners);
  }
  ConvertOptions options = sized(257);
  options.normal_map_size = 513;
  options.keep_uv = options.keep_places = options.keep_source = true;
  const LoadedSurface loaded = load_surface(Surface(mesh, "strip"), options);
  ASSERT_TRUE(loaded.normals && loaded.texture && loaded.follows && loaded.source);
  const Chart& chart = loaded.image.mates.charts()[1];
  ASSERT_NE(chart.rows, chart.cols);
  for (int r = 0; r < chart.rows; ++r)
    for (int c = 0; c < chart.cols; ++c) {
      const int row = chart.row + r, col = chart.col + c;
      const Vec3d p = loaded.image.world_position(row, col);
      EXPECT_NEAR(loaded.texture->at(row, col).x, p.x, 1e-4);
      EXPECT_NEAR(loaded.texture->at(row, col).y, p.z, 1e-4);
      EXPECT_NEAR(std::abs(loaded.normals->normal.at(2 * row, 2 * col).y), 1, 1e-5);
      Vec3d followed;
      const BlendedVertex& blend = loaded.follows->blends[row * 257 + col];
      for (int k = 0; k < 3; ++k) followed += blend.weights[k] * mesh.positions[blend.vertices[k]];
      EXPECT_LT(length(followed - p), 1e-4);
    }
}

TEST(Rectangles, FittedSamplesAreNearerToAWavingStrip) {
  TriangleMesh two = ribbon(4, 0.05);
  add(two, ribbon(4, 0.05), {0, 0, 0.3});
  ConvertOptions options = sized(257);
  const Conversion plain = convert_mesh(two, "two", options);
  ASSERT_EQ(rectangles_of(plain), 2);
  options.fit_samples = true;
  const Conversion fitted = convert_mesh(two, "two", options);
  expect_sound(fitted);
  EXPECT_LT(fitted.quality.from_image.rms, plain.quality.from_image.rms);
}

}  // namespace
}  // namespace weft
