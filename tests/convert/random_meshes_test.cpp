#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/random_mesh.h"
#include "weft/convert.h"
#include "weft/core/random.h"
#include "weft/cut/open_to_disk.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/param/border_layout.h"

// Set WEFT_RANDOM_SEEDS="FIRST COUNT" to try other seeds than 1 .. 500 (one alone: "77 1"), and
// WEFT_RANDOM_KEEP=FOLDER to have the meshes that fail written there.

namespace weft {
namespace {

constexpr int meshes_a_test = 50;
constexpr int tests = 10;

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

/// The least size that holds the mesh's plain cut, a little more, or one that users ask for.
int random_size(const TriangleMesh& mesh, std::uint64_t seed) {
  Random random(~seed);
  const TriangleMesh repaired = repair_mesh(mesh, {}).mesh;
  const int least = min_size(cut_open(repaired, open_to_disk(repaired)));
  const std::array wanted{least, least + 1, least + 2, 17, 24, 33, 65, 100, 129};
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
std::string fault(const TriangleMesh& mesh, int size) {
  ConvertOptions options;
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

TEST_P(RandomMeshes, ConvertWithoutAFault) {
  const auto [first, count] = seeds_of(GetParam());
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const test::RandomMesh made = test::random_mesh(seed);
    const int size = random_size(made.mesh, seed);
    const std::string wrong = fault(made.mesh, size);
    EXPECT_EQ(wrong, "") << command(seed, size, made.made_of);
    if (!wrong.empty()) keep(made.mesh, seed, size);
  }
}

TEST_P(RandomMeshes, BrokenOnesEndInTheirError) {
  const auto [first, count] = seeds_of(GetParam());
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const test::BrokenMesh broken = test::random_broken_mesh(seed);
    const std::string said =
        test::message_of<Error>([&] { convert_mesh(broken.mesh, "broken", {}); });
    EXPECT_TRUE(said.starts_with("broken: ")) << command(seed, 0, broken.made_of) << ": " << said;
    EXPECT_NE(said.find(broken.error), std::string::npos)
        << command(seed, 0, broken.made_of) << ": " << said << ", without: " << broken.error;
  }
}

INSTANTIATE_TEST_SUITE_P(Part, RandomMeshes, ::testing::Range(0, tests));

}  // namespace
}  // namespace weft
