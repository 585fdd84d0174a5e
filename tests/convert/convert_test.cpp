#include "weft/convert.h"

#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/convert/maps.h"
#include "tests/support/convert_options.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "weft/convert/sample.h"
#include "weft/core/hash.h"
#include "weft/error.h"
#include "weft/image/builtin.h"
#include "weft/image_file.h"
#include "weft/image_quality.h"
#include "weft/mesh.h"
#include "weft/shapes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

TriangleMesh square_mesh(double height) {
  return {{{0, height, 0}, {1, height, 0}, {1, height, -1}, {0, height, -1}},
          {{0, 1, 2}, {0, 2, 3}}};
}

// The torus with some triangles taken out: holes.
TriangleMesh holed_torus() {
  TriangleMesh mesh = test::torus(16, 16, 1, 0.4);
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == 3 * 16 + 4 || t[0] == 9 * 16 + 9; });
  return mesh;
}

// A plate of m x m vertices, every fourth quad each way a hole.
TriangleMesh plate_with_holes(int m) {
  TriangleMesh plate;
  for (int k = 0; k < m * m; ++k) plate.positions.push_back({k % m * 1.0, 0, -(k / m) * 1.0});
  for (int row = 0; row + 1 < m; ++row)
    for (int col = 0; col + 1 < m; ++col) {
      if (row % 4 == 1 && col % 4 == 1) continue;
      const int a = row * m + col;
      plate.triangles.push_back({a, a + 1, a + m + 1});
      plate.triangles.push_back({a, a + m + 1, a + m});
    }
  return plate;
}

std::string hash_of(const GeometryImage& image) {
  Hash hash;
  hash.add(image.cube.x);
  hash.add(image.cube.y);
  hash.add(image.cube.z);
  return hash.text();
}

TEST(Measure, DistanceOfParallelSquaresGivesTheFigures) {
  const GeometryImage image = sample_image(maps::sheet(9, 5, maps::flat));
  const double apart = 0.01;
  const ImageQuality quality = measure_image(image, square_mesh(apart));
  EXPECT_NEAR(quality.psnr_db, 20 * std::log10(std::sqrt(2.0) / apart), 1e-6);
  EXPECT_NEAR(quality.hausdorff_percent, 100 * apart / std::sqrt(2.0), 1e-6);
  EXPECT_EQ(quality.euler, 1);
  EXPECT_EQ(quality.boundaries, 1);
  EXPECT_TRUE(quality.mates_bit_equal);
}

TEST(Measure, EqualSurfacesHaveTheBestFigure) {
  const GeometryImage image = sample_image(maps::sheet(9, 5, maps::flat));
  const ImageQuality quality = measure_image(image, square_mesh(0));
  EXPECT_GT(quality.psnr_db, 200);
  EXPECT_LE(quality.psnr_db, best_psnr_db);
}

// Leaves of games and walls between boxes are modelled so: each side with triangles of its own.
TEST(Measure, WhatHasTwoSidesInOnePlaceIsNotReversed) {
  TriangleMesh leaf = make_shape("disk");
  const TriangleMesh front = leaf;
  const auto count = static_cast<int>(front.positions.size());
  leaf.positions.insert(leaf.positions.end(), front.positions.begin(), front.positions.end());
  for (const auto& [a, b, c] : front.triangles)
    leaf.triangles.push_back({count + a, count + c, count + b});
  const Conversion made = convert_mesh(leaf, "leaf", test::sized(65));
  EXPECT_LT(made.quality.reversed_area, 1e-3);
  EXPECT_TRUE(made.warnings.empty()) << made.warnings[0];
  TriangleMesh back = front;
  for (Triangle& t : back.triangles) std::swap(t[1], t[2]);
  const Conversion one = convert_mesh(front, "front", test::sized(65));
  EXPECT_GT(measure_image(one.image, back).reversed_area, 0.999);
}

TEST(Measure, MatesThatDifferAreSeen) {
  GeometryImage image = sample_image(maps::torus(9, 12));
  EXPECT_TRUE(measure_topology(image).mates_bit_equal);
  image.cube.x(0, 3) = std::nextafter(image.cube.x(0, 3), 0.0F);
  EXPECT_FALSE(measure_topology(image).mates_bit_equal);
}

TEST(Convert, TorusStaysATorus) {
  ConvertOptions options;
  options.size = 65;
  options.normal_map_size = 33;
  const Conversion made = convert_mesh(test::torus(20, 20, 1, 0.4), "folder/ring.obj", options);
  EXPECT_EQ(made.map_quality.flipped, 0);
  EXPECT_EQ(made.map_quality.degenerate, 0);
  EXPECT_TRUE(made.quality.mates_bit_equal);
  EXPECT_EQ(made.quality.euler, 0);
  EXPECT_EQ(made.quality.boundaries, 0);
  EXPECT_GT(made.quality.psnr_db, 60);
  EXPECT_LT(made.quality.hausdorff_percent, 1);
  EXPECT_EQ(made.image.source, "ring.obj");
  EXPECT_EQ(made.image.source_hash.size(), 16U);
  ASSERT_TRUE(made.normals.has_value());
  EXPECT_EQ(made.normals->size(), 33);
}

TEST(Convert, NormalsFaceAsTheSurfaceDoes) {
  ConvertOptions options;
  options.size = 33;
  options.normal_map_size = 33;
  options.measure = false;
  const Conversion made = convert_mesh(test::torus(20, 20, 1, 0.4), "ring", options);
  for (int row = 1; row < 32; ++row)
    for (int col = 1; col < 32; ++col) {
      const auto step = [&](int r, int c) {
        return made.image.world_position(row + r, col + c) -
               made.image.world_position(row - r, col - c);
      };
      const Vec3d outwards = normalized(cross(step(0, 1), step(1, 0)));
      EXPECT_GT(dot(outwards, vec_cast<double>(made.normals->normal.at(row, col))), 0.3)
          << row << ' ' << col;
    }
}

TEST(Convert, HolesStayHoles) {
  ConvertOptions options;
  options.size = 33;
  options.measure = false;
  const Conversion made = convert_mesh(holed_torus(), "ring", options);
  EXPECT_EQ(made.input.counts.boundaries, 2);
  EXPECT_EQ(made.quality.boundaries, 2);
  EXPECT_EQ(made.quality.euler, -2);
}

TEST(Convert, SameInputGivesTheSameBits) {
  ConvertOptions options;
  options.size = 33;
  options.measure = false;
  const GeometryImage once = convert_mesh(holed_torus(), "ring", options).image;
  const GeometryImage again = convert_mesh(holed_torus(), "ring", options).image;
  EXPECT_EQ(hash_of(once), hash_of(again));
  EXPECT_EQ(once.mates.intervals(), again.mates.intervals());
  EXPECT_EQ(once.source_hash, again.source_hash);
}

TEST(Convert, SizeThatIsTooSmallForTheCutIsNamedWithTheMesh) {
  ConvertOptions options;
  options.size = 9;
  try {
    convert_mesh(plate_with_holes(21), "plate.obj", options);
    FAIL() << "accepted";
  } catch (const TopologyError& error) {
    const std::string line = error.what();
    EXPECT_TRUE(line.starts_with("plate.obj: ")) << line;
    EXPECT_NE(line.find("or more"), std::string::npos) << line;
  }
}

TEST(Convert, SizesThatNoImageHasAreAUsageError) {
  ConvertOptions options;
  for (const int size : {-1, 4, largest_image_size + 1}) {
    options.size = size;
    EXPECT_THROW(convert_mesh(test::torus(8, 8, 1, 0.4), "ring", options), UsageError) << size;
  }
}

TEST(Convert, AutomaticSizeHoldsTheVerticesOfTheMesh) {
  ConvertOptions options;
  options.size = automatic_size;
  options.measure = false;
  options.augment = false;
  EXPECT_EQ(convert_mesh(test::torus(8, 8, 1, 0.4), "ring", options).image.size(), 33);
  EXPECT_EQ(convert_mesh(test::torus(40, 30, 1, 0.4), "ring", options).image.size(), 65);
}

TEST(Convert, AutomaticSizeHoldsTheCutOfAPlateWithManyHoles) {
  const TriangleMesh plate = plate_with_holes(45);  // 11 x 11 holes
  ConvertOptions options;
  options.size = automatic_size;
  options.measure = false;
  options.augment = false;
  const Conversion made = convert_mesh(plate, "plate", options);
  EXPECT_EQ(made.image.size(), 513);
  EXPECT_EQ(made.quality.boundaries, 122);
}

TEST(Convert, InterruptedWorkUnwinds) {
  class Stop : public Progress {
    void update(std::string_view stage, double) override {
      if (stage == "sample") throw Interrupted();
    }
  } stop;
  ConvertOptions options;
  options.size = 33;
  options.progress = &stop;
  EXPECT_THROW(convert_mesh(test::torus(8, 8, 1, 0.4), "ring", options), Interrupted);
}

TEST(LoadSurface, ImagesByNatureAreSampledDirectly) {
  ConvertOptions options;
  options.size = 17;
  const LoadedSurface sheet = load_surface("builtin:sheet", options);
  EXPECT_EQ(hash_of(sheet.image), hash_of(make_image_shape("sheet", 17)));
  EXPECT_FALSE(sheet.normals.has_value());
}

TEST(LoadSurface, ImageFilesAreReadAndMeshFilesConverted) {
  const test::TemporaryFolder folder;
  const std::string mesh = (folder / "ring.obj").string();
  const std::string file = (folder / "ring.exr").string();
  write_mesh(mesh, holed_torus());
  ConvertOptions options;
  options.size = 33;
  options.normal_map_size = 33;
  const LoadedSurface converted = load_surface(mesh, options);
  EXPECT_TRUE(converted.normals.has_value());
  write_image(file, converted.image);
  const LoadedSurface read = load_surface(file, options);
  EXPECT_EQ(hash_of(read.image), hash_of(converted.image));
  EXPECT_EQ(read.image.source, "ring.obj");
  EXPECT_FALSE(read.normals.has_value());
}

// A scene that asks for 9 x 9 samples gets more than that, and is to know.
TEST(LoadSurface, TellsWhatConversionWarnsOf) {
  const test::TemporaryFolder folder;
  TriangleMesh tori;
  for (int k = 0; k < 6; ++k) {
    const TriangleMesh torus = test::torus(12, 8);
    const auto first = static_cast<int>(tori.positions.size());
    for (const Vec3d p : torus.positions) tori.positions.push_back(p + Vec3d{3.0 * k, 0, 0});
    for (const auto& [a, b, c] : torus.triangles)
      tori.triangles.push_back({first + a, first + b, first + c});
  }
  write_mesh(folder / "tori.obj", tori);
  const LoadedSurface loaded = load_surface({(folder / "tori.obj").string()}, test::unmeasured(9));
  ASSERT_EQ(loaded.image.size(), 33);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(loaded.notes[0], "6 pieces do not fit into 9 x 9 samples: 33 x 33 were taken");
}

TEST(LoadSurface, UnknownNamesAreRefused) {
  EXPECT_THROW(load_surface("builtin:shpere", {}), UsageError);
  EXPECT_THROW(load_surface("no/such/mesh.obj", {}), InputError);
  EXPECT_THROW(load_surface("no/such/image.exr", {}), InputError);
}

TEST(Convert, SharedMeshesKeepTheirTopology) {
  const fs::path folder = fs::path(WEFT_SHARED_DIR) / "meshes";
  if (!fs::exists(folder)) GTEST_SKIP() << "no folder " << folder;
  ConvertOptions options;
  options.size = 65;
  options.measure = false;
  for (const char* name :
       {"opt_cube.obj", "gpt_mannequin.off", "cgal_eight.off", "opt_torus_with_holes.obj",
        "dc_tshirt1000-tri.obj", "dc_sock1055-2081.obj"}) {
    const std::string path = (folder / name).string();
    const Conversion made = convert_mesh(load_mesh(path), path, options);
    EXPECT_EQ(made.map_quality.flipped, 0) << name;
    EXPECT_EQ(made.map_quality.degenerate, 0) << name;
    EXPECT_TRUE(made.quality.mates_bit_equal) << name;
    EXPECT_EQ(made.quality.euler, made.input.counts.euler) << name;
    EXPECT_EQ(made.quality.boundaries, made.input.counts.boundaries) << name;
  }
}

}  // namespace
}  // namespace weft
