#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "weft/convert.h"
#include "weft/mesh.h"

namespace weft {
namespace {

const std::filesystem::path meshes = std::filesystem::path(WEFT_SHARED_DIR) / "meshes";

/// What conversion of a public test mesh to 129 x 129 has to better; bench/targets.py measures more
/// of them at more sizes.
struct Target {
  const char* file;
  double stretch_l2;
  double psnr_db;
};
std::ostream& operator<<(std::ostream& out, const Target& target) { return out << target.file; }

class Quality : public ::testing::TestWithParam<Target> {};

TEST_P(Quality, BettersItsTarget) {
  const auto& [file, stretch_l2, psnr_db] = GetParam();
  if (!std::filesystem::exists(meshes / file)) GTEST_SKIP() << "no " << meshes / file;
  ConvertOptions options;
  options.size = 129;
  const Conversion made = convert_mesh(read_mesh(meshes / file), file, options);
  EXPECT_LT(made.map_quality.stretch_l2, stretch_l2);
  EXPECT_GT(made.quality.psnr_db, psnr_db);
}

INSTANTIATE_TEST_SUITE_P(Meshes, Quality,
                         ::testing::Values(Target{"gpt_mannequin.off", 1.290, 68.0},
                                           Target{"ode_spot.obj", 1.202, 72.6},
                                           Target{"c3d_rocker-arm.obj", 1.456, 65.6},
                                           Target{"igl_fertility.off", 1.617, 68.2},
                                           Target{"cgal_turbine.off", 3.751, 54.5},
                                           Target{"dc_tshirt1000-tri.obj", 1.208, 79.6}));

TEST(Convert, SliversDoNotMisleadTheChoiceOfTheCut) {
  const std::filesystem::path path = meshes / "thingi_472042.stl";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const TriangleMesh mesh = read_mesh(path);
  for (const int size : {7, 17, 65}) {
    ConvertOptions options;
    options.size = size;
    options.measure = false;
    EXPECT_LT(convert_mesh(mesh, "slivers", options).map_quality.stretch_l2, 1.7) << size;
  }
}

}  // namespace
}  // namespace weft
