#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/random.h"
#include "weft/mesh.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

TEST(WriteMesh, ReadsBackBitForBit) {
  const test::TemporaryFolder folder;
  Random random(7);
  TriangleMesh mesh = test::torus(6, 9);
  for (Vec3d& p : mesh.positions) p = random.uniform(1e-12, 1e12) * p;
  mesh.positions[0] = {-0.0, 5e-324, 1e30};
  for (const char* name : {"a.obj", "a.ply", "A.PLY"}) {
    write_mesh(folder / name, mesh);
    const TriangleMesh back = read_mesh(folder / name);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.triangles, mesh.triangles) << name;
    EXPECT_TRUE(std::signbit(back.positions[0].x)) << name;
  }
}

TEST(WriteMesh, UnknownEndingIsAUsageErrorAndWritesNothing) {
  const test::TemporaryFolder folder;
  const std::string message =
      test::message_of<UsageError>([&] { write_mesh(folder / "a.fbx", test::tetrahedron()); });
  EXPECT_NE(message.find(".obj or .ply"), std::string::npos) << message;
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WriteMesh, MissingFolderIsAnOutputError) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_mesh(folder / "none/a.obj", test::tetrahedron()), OutputError);
}

TEST(WriteMesh, ReadMeshTellsMissingFilesFoldersAndEndings) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const fs::path& path) {
    return test::message_of<InputError>([&] { read_mesh(path); });
  };
  EXPECT_NE(refusal(folder / "none.obj").find("cannot be opened"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("is a folder"), std::string::npos);
  write_mesh(folder / "a.obj", test::tetrahedron());
  fs::rename(folder / "a.obj", folder / "a.txt");
  EXPECT_NE(refusal(folder / "a.txt").find("'.txt'"), std::string::npos);
}

}  // namespace
}  // namespace weft
