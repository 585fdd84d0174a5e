#include "weft/mesh/io/write_mesh.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "weft/core/random.h"
#include "weft/mesh/io/read_mesh.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, removed afterwards.
class WriteMesh : public ::testing::Test {
 protected:
  WriteMesh()
      : folder_(fs::temp_directory_path() /
                (std::string("weft_write_mesh_") +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~WriteMesh() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path folder_;
};

TEST_F(WriteMesh, ReadsBackBitForBit) {
  Random random(7);
  TriangleMesh mesh = testing::torus(6, 9);
  for (Vec3d& p : mesh.positions) p = random.uniform(1e-12, 1e12) * p;
  mesh.positions[0] = {-0.0, 5e-324, 1e30};
  for (const char* name : {"a.obj", "a.ply", "A.PLY"}) {
    write_mesh(folder_ / name, mesh);
    const TriangleMesh back = read_mesh(folder_ / name);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.triangles, mesh.triangles) << name;
    EXPECT_TRUE(std::signbit(back.positions[0].x)) << name;
  }
}

TEST_F(WriteMesh, UnknownEndingIsAUsageErrorAndWritesNothing) {
  const std::string message = testing::message_of<UsageError>(
      [&] { write_mesh(folder_ / "a.fbx", testing::tetrahedron()); });
  EXPECT_NE(message.find(".obj or .ply"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(WriteMesh, MissingFolderIsAnOutputError) {
  EXPECT_THROW(write_mesh(folder_ / "none" / "a.obj", testing::tetrahedron()), OutputError);
}

TEST_F(WriteMesh, ReadMeshTellsMissingFilesFoldersAndEndings) {
  const auto refusal = [&](const fs::path& path) {
    return testing::message_of<InputError>([&] { read_mesh(path); });
  };
  EXPECT_NE(refusal(folder_ / "none.obj").find("cannot be opened"), std::string::npos);
  EXPECT_NE(refusal(folder_).find("is a folder"), std::string::npos);
  write_mesh(folder_ / "a.obj", testing::tetrahedron());
  fs::rename(folder_ / "a.obj", folder_ / "a.txt");
  EXPECT_NE(refusal(folder_ / "a.txt").find("'.txt'"), std::string::npos);
}

}  // namespace
}  // namespace weft
