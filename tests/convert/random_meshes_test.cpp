#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/convert_options.h"
#include "tests/support/errors.h"
#include "tests/support/random_mesh.h"
#include "weft/convert.h"
#include "weft/core/random.h"
#include "weft/cut/open_to_disk.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh_statistics.h"
#include "weft/param/border_layout.h"

// Set WEFT_RANDOM_SEEDS="FIRST COUNT" to try other seeds than 1 .. 100 (one alone: "77 1"), and
// WEFT_RANDOM_KEEP=FOLDER to have the meshes that fail written there.

namespace weft {
namespace {

using test::single_chart;
using test::sized;
using test::unmeasured;

constexpr int meshes_a_test = 10;
constexpr int tests = 10;
/// Of the images of several pieces: enough for poor ones to be divided.
constexpr int pieces_size = 97;

struct Seeds {
  std::uint64_t first = 0;
  int count = meshes_a_test;
};

Seeds seeds_of(int test) {
  Seeds seeds{1 + static_cast<std::uint64_t>(test) * meshes_a_test, meshes_a_test};
  if (const char* const asked = std::getenv("WEFT_RANDOM_SEEDS")) {
    Seeds all;
    std::istringstream(asked) >> all.first >> all.count;
    seeds.count = (all.count + tests - 1) / tests;
    seeds.first = all.first + static_cast<std::uint64_t>(test) * seeds.count;
    seeds.count = std::max(0, std::min(seeds.count, all.count - test * seeds.count));
  }
  return seeds;
}

/// Of so many seeds one in several, but all of those that were asked for.
std::uint64_t one_in(int several, int count) {
  return static_cast<std::uint64_t>(std::getenv("WEFT_RANDOM_SEEDS") ? count : count / several);
}

/// The least size that holds the mesh's plain cut, a little more, or one that users ask for: a
/// large one, which takes long, of one seed in nine.
int random_size(const TriangleMesh& mesh, std::uint64_t seed) {
  Random random(~seed);
  const TriangleMesh repaired = repair_mesh(mesh, {}).mesh;
  const int least = min_size(cut_open(repaired, open_to_disk(repaired)));
  const std::vector<int> wanted = seed % 9 == 0
                                      ? std::vector{100, 129}
                                      : std::vector{least, least + 1, least + 2, 17, 24, 33, 65};
  return std::max(least, wanted[random.index(static_cast<int>(wanted.size()))]);
}

std::string command(std::uint64_t seed, int size, const std::string& made_of) {
  return "seed " + std::to_string(seed) + ", size " + std::to_string(size) + " (" + made_of +
         "); run again with WEFT_RANDOM_SEEDS=\"" + std::to_string(seed) + " 1\"";
}

void keep(const TriangleMesh& mesh, std::uint64_t seed, int size) {
  if (const char* const folder = std::getenv("WEFT_RANDOM_KEEP"))
    write_mesh(std::filesystem::path(folder) /
                   ("fail-" + std::to_string(seed) + "-" + std::to_string(size) + ".obj"),
               mesh);
}

/// What is wrong with the conversion of a mesh; empty when nothing is.
std::string fault(const TriangleMesh& mesh, ConvertOptions options, int size) {
  options.size = size;
  options.measure = false;
  try {
    const Conversion made = convert_mesh(mesh, "random", options);
    const TopologyCounts& input = made.input.counts;
    std::ostringstream wrong;
    const auto require = [&](const char* what, int found, int wanted) {
      if (found != wanted) wrong << what << " " << found << ", wanted " << wanted << "; ";
    };
    require("size", made.image.size(), size);
    require("components", input.components, 1);
    require("flipped", made.map_quality.flipped, 0);
    require("degenerate", made.map_quality.degenerate, 0);
    require("mates bit-equal", made.quality.mates_bit_equal ? 1 : 0, 1);
    require("Euler number", made.quality.euler, input.euler);
    require("borders", made.quality.boundaries, input.boundaries);
    return wrong.str();
  } catch (const Error& error) {
    return error.what();
  }
}

class RandomMeshes : public ::testing::TestWithParam<int> {};

/// By turns into as many charts as are good for it, and into one.
ConvertOptions by_turns(std::uint64_t seed) {
  return seed % 2 == 0 ? ConvertOptions{} : single_chart();
}

TEST_P(RandomMeshes, ConvertWithoutAFault) {
  const auto [first, count] = seeds_of(GetParam());
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const test::RandomMesh made = test::random_mesh(seed);
    const int size = random_size(made.mesh, seed);
    const std::string wrong = fault(made.mesh, by_turns(seed), size);
    EXPECT_EQ(wrong, "") << command(seed, size, made.made_of);
    if (!wrong.empty()) keep(made.mesh, seed, size);
  }
}

TEST_P(RandomMeshes, BrokenOnesEndInTheirError) {
  const auto [first, count] = seeds_of(GetParam());
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const test::BrokenMesh broken = test::random_broken_mesh(seed);
    const std::string said =
        test::message_of<Error>([&] { convert_mesh(broken.mesh, "broken", single_chart()); });
    EXPECT_TRUE(said.starts_with("broken: ")) << command(seed, 0, broken.made_of) << ": " << said;
    EXPECT_NE(said.find(broken.error), std::string::npos)
        << command(seed, 0, broken.made_of) << ": " << said << ", without: " << broken.error;
  }
}

/// Two to five random meshes beside each other.
test::RandomMesh random_pieces(std::uint64_t seed) {
  Random random(seed * 77);
  test::RandomMesh all;
  const int count = 2 + random.index(4);
  for (int k = 0; k < count; ++k) {
    const test::RandomMesh piece =
        test::random_mesh(seed + 1000 * (static_cast<std::uint64_t>(k) + 1));
    const auto first = static_cast<int>(all.mesh.positions.size());
    for (const Vec3d p : piece.mesh.positions)
      all.mesh.positions.push_back(p + Vec3d{3.0 * k, 0, 0});
    for (const auto& [a, b, c] : piece.mesh.triangles)
      all.mesh.triangles.push_back({first + a, first + b, first + c});
    all.made_of += (k > 0 ? " + " : "") + piece.made_of;
  }
  return all;
}

/// Genus and borders of every component, sorted.
std::vector<std::array<int, 2>> components_of(const TriangleMesh& mesh) {
  std::vector<std::array<int, 2>> found;
  for (const ComponentStatistics& one : examine_mesh(mesh).component_list)
    found.push_back({one.genus().value_or(-1), one.boundaries});
  std::sort(found.begin(), found.end());
  return found;
}

TEST_P(RandomMeshes, SeveralPiecesBecomeAsManyChartsOrMore) {
  const auto [first, count] = seeds_of(GetParam());
  for (std::uint64_t seed = first; seed < first + one_in(10, count); ++seed) {
    const test::RandomMesh made = random_pieces(seed);
    try {
      // The mesh before poor pieces were divided: that of the conversion is parted.
      const TriangleMesh whole =
          repair_mesh(made.mesh, {.component = {ComponentChoice::Kind::all, 0}}).mesh;
      const Conversion found = convert_mesh(made.mesh, "random", unmeasured(pieces_size));
      EXPECT_EQ(found.map_quality.flipped + found.map_quality.degenerate, 0);
      EXPECT_TRUE(found.quality.mates_bit_equal);
      if (found.input.joined.empty()) {
        EXPECT_EQ(found.charts.size(), components_of(whole).size());
      }
      EXPECT_EQ(components_of(rebuild_mesh(found.image).mesh), components_of(whole))
          << command(seed, pieces_size, made.made_of);
    } catch (const Error& error) {
      ADD_FAILURE() << error.what() << ": " << command(seed, pieces_size, made.made_of);
      keep(made.mesh, seed, pieces_size);
    }
  }
}

/// Moebius bands and Klein bottles, edges of five triangles, several pieces.
bool is_a_surface(const test::BrokenMesh& broken) {
  return broken.error == "not orientable" || broken.error == "non-manifold edge" ||
         broken.error == "2 components";
}

TEST_P(RandomMeshes, WhatIsNoManifoldIsPartedAndJoinedAgain) {
  const auto [first, count] = seeds_of(GetParam());
  for (std::uint64_t seed = first; seed < first + one_in(4, count); ++seed) {
    const test::BrokenMesh broken = test::random_broken_mesh(seed);
    if (!is_a_surface(broken)) continue;
    try {
      const Conversion made = convert_mesh(broken.mesh, "broken", unmeasured(pieces_size));
      EXPECT_EQ(made.map_quality.flipped + made.map_quality.degenerate, 0);
      EXPECT_TRUE(made.quality.mates_bit_equal);
      EXPECT_EQ(made.quality.euler, made.input.counts.euler);
      EXPECT_EQ(made.quality.boundaries, made.input.counts.boundaries);
    } catch (const Error& error) {
      ADD_FAILURE() << error.what() << ": " << command(seed, pieces_size, broken.made_of);
      keep(broken.mesh, seed, pieces_size);
    }
  }
}

/// Of all edges of more than two triangles together [m].
double nonmanifold_length(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b] : examine_mesh(mesh).nonmanifold_edge_list)
    sum += length(mesh.positions[a] - mesh.positions[b]);
  return sum;
}

/// What is wrong with the conversion of what is no manifold; empty when nothing is.
std::string complex_fault(const test::RandomComplex& complex) {
  try {
    const Conversion made = convert_mesh(complex.mesh, "complex", unmeasured(pieces_size));
    const TopologyCounts wanted =
        repair_mesh(complex.whole, {.component = {ComponentChoice::Kind::all, 0}}).counts;
    const TriangleMesh again = rebuild_mesh(made.image).mesh;
    const MeshStatistics found = examine_mesh(again);
    std::ostringstream wrong;
    const auto require = [&](const char* what, int is, int should) {
      if (is != should) wrong << what << " " << is << ", wanted " << should << "; ";
    };
    require("flipped", made.map_quality.flipped + made.map_quality.degenerate, 0);
    require("mates bit-equal", made.quality.mates_bit_equal ? 1 : 0, 1);
    require("Euler number", made.quality.euler, wanted.euler);
    require("borders", made.quality.boundaries, wanted.boundaries);
    require("components", found.components, wanted.components);
    const double before = nonmanifold_length(complex.whole), after = nonmanifold_length(again);
    const double rounding = 1e-4 * before + 1e-5 * found.box.diagonal();
    // Samples may cut the corners of a curve of several edges.
    if (after > before + rounding || after < 0.8 * before - rounding)
      wrong << "edges of more than two triangles " << after << " m, wanted " << before << "; ";
    return wrong.str();
  } catch (const Error& error) {
    return error.what();
  }
}

TEST_P(RandomMeshes, WhatFilesHoldKeepsItsTopology) {
  const auto [first, count] = seeds_of(GetParam());
  for (std::uint64_t seed = first; seed < first + one_in(10, count); ++seed) {
    const test::RandomComplex complex = test::random_complex(seed);
    const std::string wrong = complex_fault(complex);
    EXPECT_EQ(wrong, "") << command(seed, pieces_size, complex.made_of);
    if (!wrong.empty()) keep(complex.mesh, seed, pieces_size);
  }
}

INSTANTIATE_TEST_SUITE_P(Part, RandomMeshes, ::testing::Range(0, tests));

}  // namespace
}  // namespace weft
