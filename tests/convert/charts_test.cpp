#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/convert_options.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/convert.h"
#include "weft/convert/chart_packing.h"
#include "weft/error.h"
#include "weft/image_file.h"
#include "weft/image_quality.h"
#include "weft/mesh_statistics.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using test::single_chart;
using test::sized;
using test::unmeasured;

TriangleMesh beside(const std::vector<TriangleMesh>& meshes, double distance = 3) {
  TriangleMesh all;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const auto first = static_cast<int>(all.positions.size());
    for (const Vec3d p : meshes[k].positions)
      all.positions.push_back(p + Vec3d{distance * static_cast<double>(k), 0, 0});
    for (const auto& [a, b, c] : meshes[k].triangles)
      all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

bool overlap(const Chart& a, const Chart& b) {
  return a.row < b.row + b.rows && b.row < a.row + a.rows && a.col < b.col + b.cols &&
         b.col < a.col + a.cols;
}

TEST(ChartPacking, ChartsAreApartAlignedAndAsLargeAsTheyCanBe) {
  for (const int size : {33, 65, 257, 1000})
    for (const int count : {1, 2, 5, 17, 40}) {
      std::vector<ChartShare> shares;
      for (int k = 0; k < count; ++k) shares.push_back({5, 1.0 / (1 + k % 7)});
      const std::optional<std::vector<Chart>> packed = pack_charts(shares, size);
      if (!packed) {
        EXPECT_EQ(size, 33) << count << " charts of 8 x 8 fit into " << size;
        continue;
      }
      double samples = 0;
      for (int i = 0; i < count; ++i) {
        const Chart& chart = (*packed)[i];
        EXPECT_EQ(chart.row % 4 + chart.col % 4, 0);
        EXPECT_EQ((chart.rows - 1) % 4 + (chart.cols - 1) % 4, 0);
        EXPECT_LE(std::max(chart.row + chart.rows, chart.col + chart.cols), size);
        for (int j = 0; j < i; ++j) EXPECT_FALSE(overlap(chart, (*packed)[j]));
        samples += static_cast<double>(chart.rows) * chart.cols;
      }
      // Two equal squares cover half of a larger one at most.
      if (size >= 257) {
        EXPECT_GT(samples, 0.45 * size * size) << count << " in " << size;
      }
    }
}

// Of 4 x 4 quads a torus has edges that more than two of its triangles share.
TEST(Charts, LevelsAtWhichASurfaceIsNoManifoldAreLeftOut) {
  const TriangleMesh tori = beside(std::vector(20, test::torus(20, 8, 0.5, 0.1)));
  const Conversion made = convert_mesh(tori, "tori", unmeasured(65));
  ASSERT_EQ(measure_topology(made.image).euler, 0);
  EXPECT_EQ(coarsest_level(made.image), 0);
  EXPECT_FALSE(coarser_image(made.image, 1));
}

TEST(ChartPacking, WhatDoesNotFitIsTold) {
  EXPECT_FALSE(pack_charts(std::vector<ChartShare>(30, {5, 1}), 33));
  EXPECT_FALSE(pack_charts(std::vector<ChartShare>{{40, 1}}, 33));
  EXPECT_TRUE(pack_charts(std::vector<ChartShare>{{33, 1}}, 33));
}

TEST(ChartPacking, RectanglesLieApartAndHaveTheirAspect) {
  for (const int size : {257, 513})
    for (const int count : {2, 5, 17}) {
      std::vector<ChartShare> shares;
      for (int k = 0; k < count; ++k)
        shares.push_back({5, 1.0 / (1 + k % 7), k % 3 == 0 ? 6.0 : 1});
      const std::optional<std::vector<Chart>> packed = pack_charts(shares, size);
      ASSERT_TRUE(packed);
      for (int i = 0; i < count; ++i) {
        const Chart& chart = (*packed)[i];
        EXPECT_EQ((chart.rows - 1) % 4 + (chart.cols - 1) % 4, 0);
        EXPECT_LE(std::max(chart.row + chart.rows, chart.col + chart.cols), size);
        for (int j = 0; j < i; ++j) EXPECT_FALSE(overlap(chart, (*packed)[j]));
        // Narrow ones have more rows than they would.
        const double aspect = (chart.cols - 1.0) / (chart.rows - 1);
        if (chart.rows > 17) {
          EXPECT_NEAR(aspect / shares[i].aspect, 1, 0.4) << chart.rows << " x " << chart.cols;
        }
      }
    }
}

TEST(ChartPacking, AChartGrowsAlongItsLongerSideToHoldItsBorder) {
  EXPECT_EQ(with_border(ChartSize(17, 33), 96, 257), ChartSize(17, 33));
  EXPECT_EQ(with_border(ChartSize(17, 33), 97, 257), ChartSize(17, 37));
  EXPECT_EQ(with_border(ChartSize(17, 33), 97, 33), ChartSize(21, 33)) << "as far as that goes";
  EXPECT_EQ(with_border(ChartSize(17), 65, 257), ChartSize(21)) << "a square";
}

TEST(Charts, EveryPieceKeepsItsTopology) {
  const TriangleMesh mesh =
      beside({make_shape("sphere"), make_shape("torus"), make_shape("tshirt"), make_shape("knot")});
  const Conversion made = convert_mesh(mesh, "four", sized(257));
  EXPECT_EQ(made.image.size(), 257);
  EXPECT_EQ(made.charts.size(), 4U);
  EXPECT_TRUE(made.quality.mates_bit_equal);
  EXPECT_EQ(made.quality.euler, 2 + 0 - 2 + 0);
  EXPECT_EQ(made.quality.boundaries, 4);
  EXPECT_GT(made.quality.psnr_db, 70);
  EXPECT_EQ(made.map_quality.flipped + made.map_quality.degenerate, 0);
}

TEST(Charts, TheSameBitsEveryTime) {
  const TriangleMesh mesh = beside({make_shape("sphere"), make_shape("torus")});
  const ConvertOptions options = unmeasured(65);
  EXPECT_EQ(exr_bytes(convert_mesh(mesh, "two", options).image),
            exr_bytes(convert_mesh(mesh, "two", options).image));
}

TEST(Charts, OnePieceIsConvertedAsAlone) {
  ConvertOptions options = unmeasured(65);
  const std::string automatic = exr_bytes(convert_mesh(make_shape("torus"), "t", options).image);
  options.charts = ChartChoice::one;
  EXPECT_EQ(exr_bytes(convert_mesh(make_shape("torus"), "t", options).image), automatic);
}

TEST(Charts, SeveralPiecesAreRefusedWhereOneChartIsAsked) {
  const TriangleMesh mesh = beside({make_shape("sphere"), make_shape("torus")});
  const std::string said =
      test::message_of<TopologyError>([&] { convert_mesh(mesh, "two", single_chart()); });
  EXPECT_NE(said.find("2 components"), std::string::npos) << said;
}

TEST(Charts, TooManyPiecesForTheSizeMakeTheImageGrow) {
  const TriangleMesh mesh = beside(std::vector<TriangleMesh>(12, make_shape("box")));
  const Conversion made = convert_mesh(mesh, "cubes", unmeasured(17));
  EXPECT_GT(made.image.size(), 17);
  ASSERT_EQ(made.warnings.size(), 1U);
  EXPECT_NE(made.warnings[0].find("12 pieces"), std::string::npos);
}

TEST(Charts, AHollowKeepsItsInnerWall) {
  TriangleMesh mesh = make_shape("sphere");
  const auto outer = static_cast<int>(mesh.positions.size());
  for (int v = 0; v < outer; ++v) mesh.positions.push_back(0.5 * mesh.positions[v]);
  const std::vector<Triangle> triangles = mesh.triangles;
  for (const auto& [a, b, c] : triangles)
    mesh.triangles.push_back({outer + a, outer + c, outer + b});
  const Conversion made = convert_mesh(mesh, "hollow", unmeasured(129));
  double volume = 0, whole = 0;
  const TriangleMesh again = rebuild_mesh(made.image).mesh;
  for (const auto& [a, b, c] : again.triangles)
    volume += dot(again.positions[a], cross(again.positions[b], again.positions[c]));
  const TriangleMesh ball = make_shape("sphere");
  for (const auto& [a, b, c] : ball.triangles)
    whole += dot(ball.positions[a], cross(ball.positions[b], ball.positions[c]));
  EXPECT_NEAR(volume / whole, 7.0 / 8, 0.01) << "the ball less its hollow";
}

TEST(Charts, PiecesWithoutAreaAreDroppedAndTold) {
  TriangleMesh mesh = make_shape("box");
  const auto first = static_cast<int>(mesh.positions.size());
  for (const double x : {5.0, 6.0, 7.0}) mesh.positions.push_back({x, 5, 5});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const Conversion made = convert_mesh(mesh, "cube", unmeasured(33));
  EXPECT_EQ(made.charts.size(), 1U);
  EXPECT_NE(std::find(made.input.repairs.begin(), made.input.repairs.end(),
                      "dropped 1 component without area"),
            made.input.repairs.end());
}

TEST(Charts, SurfacesFollowTheVerticesOfAllPieces) {
  const TriangleMesh mesh = beside({make_shape("box"), make_shape("sphere")});
  ConvertOptions options = sized(65);
  options.keep_places = options.keep_source = true;
  const LoadedSurface loaded = load_surface(Surface(mesh, "two"), options);
  ASSERT_TRUE(loaded.follows && loaded.source);
  for (int s = 0; s < 65 * 65; ++s) {
    Vec3d place;
    const BlendedVertex& blend = loaded.follows->blends[s];
    for (int k = 0; k < 3; ++k) place += blend.weights[k] * mesh.positions[blend.vertices[k]];
    EXPECT_LT(length(place - loaded.image.world_position(s / 65, s % 65)), 1e-5);
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec2d place = loaded.source->places[v];
    ASSERT_TRUE(std::isfinite(place.x));
    const int row = static_cast<int>(place.y), col = static_cast<int>(place.x);
    EXPECT_FALSE(loaded.image.mates.is_hole(row * 65 + col)) << "vertex " << v;
  }
}

TEST(Charts, AWeldedMeshFollowsAllOfItsVertices) {
  const TriangleMesh ball = make_shape("sphere");
  TriangleMesh soup;
  for (const Triangle& t : ball.triangles) {
    const int first = static_cast<int>(soup.positions.size());
    for (const int v : t) soup.positions.push_back(ball.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  ConvertOptions options = sized(33);
  options.keep_source = true;
  const LoadedSurface loaded = load_surface(Surface(soup, "soup"), options);
  EXPECT_TRUE(loaded.image.has_one_chart());
  ASSERT_TRUE(loaded.source);
  ASSERT_EQ(loaded.source->places.size(), soup.positions.size());
  for (std::size_t v = 0; v < soup.positions.size(); ++v)
    EXPECT_TRUE(std::isfinite(loaded.source->places[v].x)) << "vertex " << v;
}

void expect_sound(const Conversion& made, const std::string& what) {
  const TopologyCounts& wanted = made.input.counts;
  EXPECT_EQ(made.map_quality.flipped, 0) << what;
  EXPECT_TRUE(mates_bit_equal(made.image)) << what;
  const TriangleMesh mesh = rebuild_mesh(made.image).mesh;
  const TopologyCounts counts =
      count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles);
  EXPECT_EQ(counts.euler, wanted.euler) << what;
  EXPECT_EQ(counts.boundaries, wanted.boundaries) << what;
  EXPECT_EQ(counts.components, wanted.components) << what;
}

TEST(Charts, RegionsOfAnyNumberAreOneSurface) {
  for (const auto& [shape, count] : {std::pair{"torus", 8}, {"knot", 3}, {"sheet", 8}}) {
    ConvertOptions options = unmeasured(65);
    options.charts = ChartChoice::regions;
    options.max_charts = count;
    const Conversion made = convert_mesh(make_shape(shape), shape, options);
    const std::string what = std::string(shape) + " in " + std::to_string(count);
    EXPECT_EQ(made.charts.size(), static_cast<std::size_t>(count)) << what;
    expect_sound(made, what);
  }
}

TEST(Charts, IslandsOfTheTextureBecomeCharts) {
  TriangleMesh mesh = make_shape("torus");
  for (const Triangle& t : mesh.triangles) {
    const Vec3d middle = mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]];
    std::array<Vec2f, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = {static_cast<float>(mesh.positions[t[k]].x) + (middle.x > 0 ? 10.0F : 0.0F),
                    static_cast<float>(mesh.positions[t[k]].z)};
    mesh.corner_uv.push_back(corners);
  }
  ConvertOptions options = unmeasured(65);
  options.charts = ChartChoice::texture;
  const Conversion made = convert_mesh(mesh, "torus", options);
  EXPECT_EQ(made.charts.size(), 2U);
  expect_sound(made, "torus in halves");
}

TEST(Charts, TextureAndNumbersThatCannotBeAreRefused) {
  ConvertOptions options = unmeasured(33);
  options.charts = ChartChoice::texture;
  EXPECT_THROW(convert_mesh(make_shape("torus"), "torus", options), InputError);
  options.charts = ChartChoice::regions;
  for (const int count : {0, -1, largest_chart_count + 1}) {
    options.max_charts = count;
    EXPECT_THROW(convert_mesh(make_shape("torus"), "torus", options), UsageError) << count;
  }
}

/// Three pages that meet in a spine.
TriangleMesh book(int pages) {
  TriangleMesh mesh;
  constexpr int rows = 10, cols = 5;
  for (int k = 0; k < pages; ++k)
    for (int i = 0; i <= rows; ++i)
      for (int j = 0; j <= cols; ++j) {
        const double angle = 2 * 3.14159265358979 * k / pages, out = 0.2 * j;
        mesh.positions.push_back({out * std::cos(angle), 0.1 * i, out * std::sin(angle)});
      }
  const auto at = [](int k, int i, int j) {
    return (j == 0 ? 0 : k) * (rows + 1) * (cols + 1) + i * (cols + 1) + j;
  };
  for (int k = 0; k < pages; ++k)
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < cols; ++j) {
        mesh.triangles.push_back({at(k, i, j), at(k, i, j + 1), at(k, i + 1, j + 1)});
        mesh.triangles.push_back({at(k, i, j), at(k, i + 1, j + 1), at(k, i + 1, j)});
      }
  return mesh;
}

TEST(SeamCharts, ABookKeepsItsSpine) {
  for (const int pages : {3, 4, 5}) {
    const Conversion made = convert_mesh(book(pages), "book", sized(129));
    EXPECT_EQ(made.image.mates.charts().size(), std::size_t(pages));
    EXPECT_EQ(made.quality.euler, 1);
    EXPECT_EQ(made.quality.boundaries, 1);
    EXPECT_TRUE(made.quality.mates_bit_equal);
    EXPECT_GT(made.quality.psnr_db, 90);
    const MeshStatistics again = examine_mesh(rebuild_mesh(made.image).mesh);
    EXPECT_EQ(again.components, 1);
    EXPECT_GT(again.nonmanifold_edges, 0);
    double spine = 0;
    const TriangleMesh mesh = rebuild_mesh(made.image).mesh;
    for (const auto& [a, b] : again.nonmanifold_edge_list)
      spine += length(mesh.positions[a] - mesh.positions[b]);
    EXPECT_NEAR(spine, 1, 1e-5) << pages;
  }
}

TEST(SeamCharts, AMoebiusBandStaysOne) {
  TriangleMesh mesh;
  constexpr int around = 40, across = 4;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j <= across; ++j) {
      const double angle = 2 * 3.14159265358979 * i / around, s = 0.15 * (j - 0.5 * across);
      const double r = 1 + s * std::cos(angle / 2);
      mesh.positions.push_back({r * std::cos(angle), s * std::sin(angle / 2), r * std::sin(angle)});
    }
  const auto at = [](int i, int j) { return i == around ? across - j : i * (across + 1) + j; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  const Conversion made = convert_mesh(mesh, "band", sized(129));
  EXPECT_EQ(made.quality.euler, 0);
  EXPECT_EQ(made.quality.boundaries, 1);
  EXPECT_GT(made.quality.psnr_db, 75);
  const MeshStatistics again = examine_mesh(rebuild_mesh(made.image).mesh);
  EXPECT_FALSE(again.orientable);
  EXPECT_EQ(again.nonmanifold_edges, 0);
  const GeometryImage read = parse_image(exr_bytes(made.image), "file");
  EXPECT_EQ(exr_bytes(read), exr_bytes(made.image)) << "files keep turned seams";
  const std::string said =
      test::message_of<TopologyError>([&] { convert_mesh(mesh, "band", single_chart()); });
  EXPECT_NE(said.find("not orientable"), std::string::npos) << said;
}

TEST(SeamCharts, ASlitOfOneEdgeIsMadeLonger) {
  // A fin on one edge within a surface: both ends of the edge are inside.
  TriangleMesh mesh = make_shape("sphere");
  const auto [a, b, c] = mesh.triangles[100];
  mesh.positions.push_back(1.5 * mesh.positions[a]);
  mesh.triangles.push_back({a, b, static_cast<int>(mesh.positions.size()) - 1});
  const Conversion made = convert_mesh(mesh, "fin", unmeasured(129));
  EXPECT_EQ(made.charts.size(), 2U);
  EXPECT_EQ(made.quality.euler, 2);
  EXPECT_EQ(made.quality.boundaries, 1);
}

}  // namespace
}  // namespace weft
