#include "weft/convert/fit_samples.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/convert/maps.h"
#include "weft/convert/sample.h"
#include "weft/geometry_image.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

double rms_distance(const MappedDisk& mapped, const GeometryImage& image) {
  const TriangleMesh surface{mapped.cut.disk.positions, mapped.cut.disk.triangles};
  return surface_distance(surface, rebuild_mesh(image).mesh, {.samples = 4000}).rms;
}

Vec3d wave(double u, double v) { return {u, 0.1 * sine(7 * u) * cosine(5 * v), -v}; }

TEST(FitSamples, BringsTheSurfaceNearer) {
  const MappedDisk torus = maps::torus(17, 65);
  const GeometryImage plain = sample_image(torus);
  EXPECT_LT(rms_distance(torus, fit_samples(torus, plain)), 0.7 * rms_distance(torus, plain));
  const MappedDisk sheet = maps::sheet(17, 65, wave);
  const GeometryImage of_sheet = sample_image(sheet);
  EXPECT_LT(rms_distance(sheet, fit_samples(sheet, of_sheet)), 0.7 * rms_distance(sheet, of_sheet));
}

TEST(FitSamples, KeepsMatesBitEqualAndTheTopology) {
  for (const MappedDisk& mapped : {maps::torus(17, 33), maps::pillow(17, 33)}) {
    const GeometryImage plain = sample_image(mapped);
    const GeometryImage fitted = fit_samples(mapped, plain);
    EXPECT_TRUE(mates_bit_equal(fitted));
    EXPECT_EQ(fitted.mates.intervals(), plain.mates.intervals());
    const TriangleMesh before = rebuild_mesh(plain).mesh;
    const TriangleMesh after = rebuild_mesh(fitted).mesh;
    const auto euler = [](const TriangleMesh& mesh) {
      return count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles).euler;
    };
    EXPECT_EQ(euler(after), euler(before));
  }
}

TEST(FitSamples, LeavesTheTrueBorderInPlace) {
  const MappedDisk mapped = maps::sheet(17, 33, wave);
  const GeometryImage plain = sample_image(mapped);
  const GeometryImage fitted = fit_samples(mapped, plain);
  for (int t = 0; t < 64; ++t) {
    const int s = border_sample(17, t);
    const Vec3d apart =
        fitted.world_position(s / 17, s % 17) - plain.world_position(s / 17, s % 17);
    EXPECT_LT(length(apart), 1e-6);
  }
}

TEST(FitSamples, LeavesAFlatSheetAsItIs) {
  const MappedDisk mapped = maps::sheet(9, 17, maps::flat);
  const GeometryImage plain = sample_image(mapped);
  const GeometryImage fitted = fit_samples(mapped, plain);
  for (int row = 0; row < 9; ++row)
    for (int col = 0; col < 9; ++col)
      EXPECT_LT(length(fitted.world_position(row, col) - plain.world_position(row, col)), 1e-6);
}

TEST(FitSamples, HoldsSamplesOutsideTheSurfacesBox) {
  // Flat triangles over a bulge touch it at best where they rise above it: the fit leaves the box.
  const MappedDisk mapped = maps::sheet(9, 65, [](double u, double v) {
    return Vec3d{u, u * (1 - u) * v * (1 - v), -v};
  });
  const GeometryImage plain = sample_image(mapped);
  const GeometryImage fitted = fit_samples(mapped, plain);
  double highest = 0;
  for (int s = 0; s < 81; ++s) highest = std::max(highest, fitted.world_position(s / 9, s % 9).y);
  EXPECT_GT(highest, 1.0 / 16);
  for (int s = 0; s < 81; ++s) {
    const Vec3f p = fitted.cube.at(s);
    EXPECT_TRUE(min(p, Vec3f{0, 0, 0}) == Vec3f({0, 0, 0}) &&
                max(p, Vec3f{1, 1, 1}) == Vec3f({1, 1, 1}));
  }
}

TEST(FitSamples, GivesTheSameBitsTwice) {
  const MappedDisk mapped = maps::torus(17, 33);
  const GeometryImage plain = sample_image(mapped);
  const GeometryImage a = fit_samples(mapped, plain);
  const GeometryImage b = fit_samples(mapped, plain);
  for (int s = 0; s < 17 * 17; ++s) EXPECT_EQ(a.cube.at(s), b.cube.at(s));
}

}  // namespace
}  // namespace weft
