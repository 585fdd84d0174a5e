#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/image/image_cases.h"
#include "tests/support/errors.h"
#include "weft/core/json.h"
#include "weft/image/io/metadata.h"
#include "weft/mesh_statistics.h"

namespace weft {
namespace {

using test::expect_same_samples;

std::string chart_refusal(int size, std::vector<Chart> charts,
                          std::vector<MateInterval> intervals = {}) {
  return test::message_of<InputError>(
      [&] { BorderMates(size, std::move(charts), std::move(intervals)); });
}

/// A flat grid for each chart, far apart, whose seams hold equal bits.
GeometryImage flat_charts(int size, const std::vector<Chart>& charts,
                          std::vector<MateInterval> intervals) {
  GeometryImage image;
  image.cube = Planes3(size);
  image.mates = BorderMates(size, charts, std::move(intervals));
  image.source = "charts.obj";
  for (int s = 0; s < size * size; ++s) {
    const int point = image.mates.representative(s);
    const float scale = 1.0F / static_cast<float>(size);
    image.cube.set(s, {scale * static_cast<float>(point % size),
                       scale * static_cast<float>(point / size), 0.25F});
  }
  return image;
}

TopologyCounts counts_of(const GeometryImage& image) {
  const TriangleMesh mesh = rebuild_mesh(image).mesh;
  return count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles);
}

const std::vector<Chart> two{{"left", 0, 0, 5, 7}, {"right", 4, 8, 9, 5}};

TEST(Charts, BorderPositionsFollowChartAfterChart) {
  const BorderMates mates(13, two, {});
  EXPECT_EQ(mates.border_length(), 20 + 24);
  EXPECT_EQ(mates.sample_at(0), 0);
  EXPECT_EQ(mates.sample_at(6), 6) << "the end of the first row";
  EXPECT_EQ(mates.sample_at(10), 4 * 13 + 6) << "up the last column";
  EXPECT_EQ(mates.sample_at(16), 4 * 13) << "back along the last row";
  EXPECT_EQ(mates.sample_at(20), 4 * 13 + 8) << "the second chart begins";
  EXPECT_EQ(mates.along_border(19, 1), 0) << "around the first";
  EXPECT_EQ(mates.along_border(20, -1), 43) << "around the second";
}

TEST(Charts, HolesFollowASampleBesideThem) {
  const BorderMates mates(13, two, {});
  EXPECT_FALSE(mates.is_hole(0));
  EXPECT_TRUE(mates.is_hole(7));
  EXPECT_EQ(mates.representative(7), 6) << "to the left";
  EXPECT_EQ(mates.representative(5 * 13), 4 * 13) << "above, where nothing is to the left";
  for (int s = 0; s < 13 * 13; ++s) EXPECT_FALSE(mates.is_hole(mates.representative(s)));
  for (int k = 0; k < mates.class_count(); ++k)
    EXPECT_EQ(mates.representative(mates.mates(k).back()), mates.mates(k).front());
}

TEST(Charts, OneChartThatFillsTheImageIsTheOldKind) {
  const std::vector<MateInterval> torus{{0, 12, 4}, {4, 16, 4}};
  const BorderMates whole(5, {{"", 0, 0, 5, 5}}, torus), plain(5, torus);
  for (int s = 0; s < 25; ++s) EXPECT_EQ(whole.representative(s), plain.representative(s));
  EXPECT_EQ(whole.class_count(), plain.class_count());
}

TEST(Charts, WhatIsNoRectangleInTheImageIsRefused) {
  EXPECT_NE(chart_refusal(13, {}).find("without charts"), std::string::npos);
  EXPECT_NE(chart_refusal(13, {{"a", 0, 0, 5, 14}}).find("'a'"), std::string::npos);
  EXPECT_NE(chart_refusal(13, {{"a", -1, 0, 5, 5}}).find("'a'"), std::string::npos);
  EXPECT_NE(chart_refusal(13, {{"a", 0, 0, 4, 5}}).find("'a'"), std::string::npos) << "too narrow";
  EXPECT_NE(chart_refusal(13, {{"a", 0, 0, 5, 5}, {"b", 4, 4, 5, 5}}).find("overlaps"),
            std::string::npos);
  EXPECT_NE(chart_refusal(13, two, {{0, 45, 3}}).find("0 .. 43"), std::string::npos);
  EXPECT_NE(chart_refusal(13, two, {{0, 20, 21}}).find("1 .. 20"), std::string::npos)
      << "longer than the first chart's border";
  EXPECT_NE(chart_refusal(13, two, {{0, 20, 20}, {0, 20, 20}, {0, 20, 5}}).find("more than 44"),
            std::string::npos)
      << "joined again and again";
}

TEST(Charts, ARunMayBeLongerThanTheBorderOfAChartThatItIsNotOn) {
  EXPECT_EQ(chart_refusal(13, two, {{20, 20, 24}}), "")
      << "the first chart's border has 20 intervals";
  EXPECT_NE(chart_refusal(13, two, {{20, 20, 25}}).find("1 .. 24"), std::string::npos);
}

TEST(Charts, AreSeparatePiecesWithoutSeams) {
  const TopologyCounts counts = counts_of(flat_charts(13, two, {}));
  EXPECT_EQ(counts.components, 2);
  EXPECT_EQ(counts.boundaries, 2);
  EXPECT_EQ(counts.vertices, 5 * 7 + 9 * 5);
  EXPECT_EQ(counts.triangles, 2 * (4 * 6 + 8 * 4));
}

TEST(Charts, ASeamJoinsTwoIntoOnePiece) {
  // The last column of the left one, downwards, is the first column of the right one.
  const GeometryImage image = flat_charts(13, two, {{6, 20 + 24, 4}});
  const TopologyCounts counts = counts_of(image);
  EXPECT_EQ(counts.components, 1);
  EXPECT_EQ(counts.boundaries, 1);
  EXPECT_EQ(counts.euler, 1);
  EXPECT_TRUE(mates_bit_equal(image));
}

TEST(Charts, ATurnedSeamOfOneChartMakesAMoebiusBand) {
  // The first column, walked upwards, is the last column walked upwards: no orientation is left, so
  // only the counts of vertices and triangles are those of a surface.
  const GeometryImage image = flat_charts(13, {{"band", 0, 0, 5, 13}}, {{12, 28, 4, true}});
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  EXPECT_EQ(rebuilt.mesh.positions.size(), std::size_t{5} * 12);
  const MeshStatistics statistics = examine_mesh(rebuilt.mesh);
  EXPECT_FALSE(statistics.orientable);
  EXPECT_EQ(statistics.border_loops.size(), 1U);
  EXPECT_EQ(statistics.nonmanifold_edges, 0);
}

TEST(Charts, ThreeSeamsOnOneCurveMakeEdgesOfThreeTriangles) {
  const std::vector<Chart> three{{"a", 0, 0, 5, 5}, {"b", 0, 8, 5, 5}, {"c", 8, 0, 5, 5}};
  const GeometryImage image = flat_charts(13, three, {{0, 20, 4}, {0, 36, 4}});
  const MeshStatistics statistics = examine_mesh(rebuild_mesh(image).mesh);
  EXPECT_EQ(statistics.components, 1);
  EXPECT_EQ(statistics.nonmanifold_edges, 4);
}

TEST(Charts, FilesKeepThem) {
  const GeometryImage image = flat_charts(13, two, {{6, 20 + 24, 4}, {0, 3, 2, true}});
  for (const std::string& bytes : {exr_bytes(image)}) {
    const GeometryImage read = parse_image(bytes, "file");
    expect_same_samples(read, image);
    EXPECT_EQ(read.mates.charts(), image.mates.charts());
    EXPECT_EQ(read.mates.intervals(), image.mates.intervals());
    EXPECT_EQ(exr_bytes(read), bytes);
  }
  const GeometryImage rounded = parse_image(png_bytes(image), "file");
  EXPECT_EQ(rounded.mates.charts(), image.mates.charts());
  EXPECT_TRUE(mates_bit_equal(rounded));
}

TEST(Charts, OneChartIsWrittenAsEver) {
  const nlohmann::json json = parse_json(metadata_text(test::torus_image(9)), 9);
  EXPECT_EQ(json["version"], 1);
  EXPECT_FALSE(json.contains("charts"));
}

TEST(Charts, SpoiledMetadataEndInOneLine) {
  const GeometryImage image = flat_charts(13, two, {});
  const auto spoiled = [&](const char* key, const nlohmann::json& value) {
    nlohmann::json json = parse_json(metadata_text(image), 9);
    json.erase("checksum");
    json[key] = value;
    return test::message_of<InputError>(
        [&] { assemble_image(stored_samples(image), json_text(json), "file"); });
  };
  EXPECT_NE(spoiled("charts", 3).find("charts"), std::string::npos);
  EXPECT_NE(spoiled("charts", nlohmann::json::array()).find("charts"), std::string::npos);
  EXPECT_NE(spoiled("charts", {{{"name", "a"}}}).find("charts"), std::string::npos);
  EXPECT_NE(spoiled("charts", {{{"name", "a"}, {"row", 0}, {"col", 0}, {"rows", 2}, {"cols", 9}}})
                .find("file"),
            std::string::npos);
  EXPECT_NE(spoiled("version", 3).find("version 3"), std::string::npos);
  EXPECT_NE(spoiled("mates", {{0, 1, 2, 3, 4}}).find("mates"), std::string::npos);
}

}  // namespace
}  // namespace weft
