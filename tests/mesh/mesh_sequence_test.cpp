#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/point_cache.h"

namespace weft {
namespace {

class MeshSequence : public ::testing::Test {
 protected:
  /// A triangle, `height` above the ground, with further vertices.
  void write(const std::string& name, double height, int further = 0) const {
    TriangleMesh mesh{{{0, height, 0}, {1, height, 0}, {0, height, 1}}, {{0, 1, 2}}};
    for (int i = 0; i < further; ++i) mesh.positions.push_back({0, 0, 0});
    write_mesh(folder_ / name, mesh);
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] std::string error_of(const std::string& name) const {
    return test::message_of<InputError>([&] { read_point_cache(path(name)); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(MeshSequence, SamplesAreTheFilesByTheirNumbers) {
  write("body_0010.obj", 3);
  write("body_0008.obj", 1);
  write("body_0009.obj", 2);
  write("body_9.obj", 7);  // not of four digits
  write("body_000x.obj", 7);
  write("other_0011.obj", 7);
  const PointCache cache = read_point_cache(path("body_%04d.obj"));
  EXPECT_TRUE(cache.times_in_frames);
  EXPECT_EQ(cache.points, 3);
  EXPECT_EQ(cache.times, (std::vector<double>{0, 1, 2}));
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(cache.sample(k)[1], (Vec3f{1, static_cast<float>(k + 1), 0}));
  EXPECT_EQ(point_cache_files(path("body_%04d.obj")).size(), 3U);
}

TEST_F(MeshSequence, NumbersMayGoInSteps) {
  for (const int number : {5, 10, 15}) write("a" + std::to_string(number) + ".ply", number);
  const PointCache cache = read_point_cache(path("a%d.ply"));
  EXPECT_EQ(cache.times, (std::vector<double>{0, 5, 10}));
  EXPECT_EQ(cache.sample(2)[0], (Vec3f{0, 15, 0}));
}

TEST_F(MeshSequence, MissingNumbersAreNamed) {
  for (const int number : {1, 2, 4}) write("a" + std::to_string(number) + ".obj", 0);
  EXPECT_EQ(error_of("a%d.obj"), path("a%d.obj") +
                                     ": number 4 follows on 2; number 3, or the same step all "
                                     "along, is wanted");
  EXPECT_EQ(error_of("b_%04d.obj"),
            path("b_%04d.obj") + ": no such files; numbered files such as b_0001.obj are wanted");
}

TEST_F(MeshSequence, OtherNumbersOfVerticesAreNamed) {
  write("a1.obj", 0);
  write("a2.obj", 0, 2);
  EXPECT_EQ(error_of("a%d.obj"), path("a2.obj") + ": 5 vertices; 3, those of a1.obj, are wanted");
}

TEST_F(MeshSequence, NamesWithOnePlaceForANumberAreSequences) {
  for (const char* name : {"a%d.obj", "b/%04d.OBJ", "a%06d_x.ply", "%03d.off"})
    EXPECT_TRUE(is_point_cache_name(name)) << name;
  // Vertices of STL and glTF are joined by where they are, so they have no order that lasts.
  for (const char* name :
       {"a.obj", "a%.obj", "a%4d.obj", "a%x.obj", "a%d%d.obj", "a%04d.stl", "a%d"})
    EXPECT_FALSE(is_point_cache_name(name)) << name;
}

}  // namespace
}  // namespace weft
