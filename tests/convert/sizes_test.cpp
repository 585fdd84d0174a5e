#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cut/voxel_mesh.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/convert.h"
#include "weft/cut/open_to_disk.h"
#include "weft/error.h"
#include "weft/param/border_layout.h"

namespace weft {
namespace {

TriangleMesh genus_20() {
  return test::slab_surface({"###########", "#.#.#.#.#.#", "###########", "#.#.#.#.#.#",
                             "###########", "#.#.#.#.#.#", "###########", "#.#.#.#.#.#",
                             "###########"});
}

TriangleMesh double_torus() { return test::slab_surface({"#####", "#.#.#", "#####"}, 1.3); }

int min_of(const TriangleMesh& mesh) { return min_size(cut_open(mesh, open_to_disk(mesh))); }

/// Converts at every size from the least to 65, then at larger ones.
void expect_topology_at_every_size(const TriangleMesh& mesh, int genus) {
  ConvertOptions options;
  options.measure = false;
  const int least = min_of(mesh);
  std::vector<int> sizes{129, 257, 513};
  for (int n = least; n <= std::max(least, 65); ++n) sizes.push_back(n);
  for (const int n : sizes) {
    options.size = n;
    const Conversion made = convert_mesh(mesh, "mesh", options);
    EXPECT_EQ(made.image.size(), n);
    EXPECT_EQ(made.map_quality.flipped + made.map_quality.degenerate, 0) << n;
    EXPECT_TRUE(made.quality.mates_bit_equal) << n;
    EXPECT_EQ(made.quality.euler, 2 - 2 * genus) << n;
    EXPECT_EQ(made.quality.boundaries, 0) << n;
  }
  if (least == min_image_size) return;
  options.size = least - 1;
  const std::string refused =
      test::message_of<TopologyError>([&] { convert_mesh(mesh, "mesh", options); });
  EXPECT_NE(refused.find("size " + std::to_string(least) + " or more"), std::string::npos)
      << refused;
}

TEST(Sizes, TorusKeepsItsTopologyAtEverySize) {
  expect_topology_at_every_size(test::torus(12, 12), 1);
}

TEST(Sizes, DoubleTorusKeepsItsTopologyAtEverySize) {
  expect_topology_at_every_size(double_torus(), 2);
}

TEST(Sizes, Genus20KeepsItsTopologyAtEverySize) { expect_topology_at_every_size(genus_20(), 20); }

TEST(Sizes, FineTorusKeepsItsTopologyFromTheLeastSizeOn) {
  const TriangleMesh mesh = test::torus(200, 200);
  ConvertOptions options;
  options.measure = false;
  for (const int n : {min_of(mesh), 33, 257}) {
    options.size = n;
    const Conversion made = convert_mesh(mesh, "mesh", options);
    EXPECT_EQ(made.map_quality.flipped + made.map_quality.degenerate, 0) << n;
    EXPECT_EQ(made.quality.euler, 0) << n;
    EXPECT_EQ(made.quality.boundaries, 0) << n;
  }
}

}  // namespace
}  // namespace weft
