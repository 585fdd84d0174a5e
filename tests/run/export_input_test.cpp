// What is written on the mesh that a cloth came from.
#include <cmath>
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "tests/run/exported_runs.h"
#include "tests/support/errors.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/run_folder.h"
#include "weft/shapes.h"

namespace weft::export_input_test {
namespace {

namespace fs = std::filesystem;

using test::as_floats;
using test::exported_frames;
using test::ExportedRun;
using test::thrown_ring;

/// A scene whose cloth is a quad tube from a file, in its unit.
Scene tube(const fs::path& path, double unit) {
  std::string text;
  constexpr int around = 12, along = 6;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around, radius = 0.2 + 0.03 * std::sin(3 * angle + j);
      text += std::to_string(radius * std::cos(angle) / unit).insert(0, "v ") + " " +
              std::to_string(0.1 * j / unit) + " " +
              std::to_string(-radius * std::sin(angle) / unit) + "\n";
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i + 1, b = j * around + (i + 1) % around + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
              std::to_string(b + around) + " " + std::to_string(a + around) + "\n";
    }
  write_file(path, [&](std::ostream& out) { out << text; });
  Scene scene = thrown_ring();
  scene.cloths[0].surface = path.string();
  scene.cloths[0].placement = {};
  return scene;
}

TEST(Exports, OnInputWritesTheUsersVerticesAndQuads) {
  const test::TemporaryFolder folder;
  const ExportedRun run(tube(folder / "tube.obj", 1));
  const TriangleMesh mesh = read_mesh(folder / "tube.obj");
  EXPECT_EQ(run.points(0), as_floats(mesh.positions));
  const TriangleMesh written = read_mesh(run.folder / "ring.obj");
  EXPECT_EQ(written.positions.size(), mesh.positions.size());
  EXPECT_EQ(written.triangles, mesh.triangles);
  const std::string text = read_file(run.folder / "ring.obj");
  EXPECT_NE(text.find("\nf 1//1 2//2 14//14 13//13\n"), text.npos);
  // What is not a mesh's by habit shows the samples, whose cache lies beside.
  EXPECT_EQ(read_mesh(run.folder / "ring_ply/ring_0000.ply").positions.size(),
            read_point_cache(run.folder / "ring.image.pc2").points);
}

TEST(Exports, OnInputHoldsForEveryFormatThatIsAskedFor) {
  const test::TemporaryFolder folder;
  const ExportedRun run(tube(folder / "tube.obj", 1), WrittenOn::input);
  const TriangleMesh ply = read_mesh(run.folder / "ring_ply/ring_0002.ply");
  EXPECT_EQ(as_floats(ply.positions), run.points(2));
  const std::string usda = read_file(run.folder / "ring.usda");
  EXPECT_NE(usda.find("faceVertexCounts = [4, 4,"), usda.npos);
  EXPECT_EQ(read_mesh(run.folder / "ring.glb").positions.size(), 84);
}

TEST(Exports, AnimatedMeshesAreWrittenAsTheirAnimationHasThem) {
  const test::TemporaryFolder folder;
  Scene scene = tube(folder / "tube.obj", 1);
  SceneBody body;
  body.name = "figure";
  body.surface = scene.cloths[0].surface;
  body.size = 9;  // so coarse that the image is no good copy
  body.animation = (folder / "moves.pc2").string();
  body.placement.translate = {8, 0, 0};
  const std::vector<Vec3d> rest = read_mesh(body.surface.name).positions;
  PointCache moves;
  moves.points = static_cast<int>(rest.size());
  moves.times_in_frames = true;
  for (int k = 0; k < 3; ++k) {
    moves.times.push_back(k);
    for (const Vec3d& p : rest)
      moves.positions.push_back(vec_cast<float>(Vec3d{p.x, p.y + 0.25 * k * p.x * p.x, p.z}));
  }
  write_pc2(body.animation.name, moves);
  for (const double lead_in : {0.0, 2 / scene.frame_rate}) {
    body.lead_in = lead_in;
    scene.bodies = {body};
    const ExportedRun run(scene);
    const PointCache written = read_point_cache(run.folder / "figure.pc2");
    ASSERT_EQ(written.points, moves.points);
    for (int frame = 0; frame <= 2; ++frame)
      for (std::size_t v = 0; v < rest.size(); ++v) {
        // In two frames of lead-in: at rest, half way, at the first sample.
        const Vec3d first = vec_cast<double>(moves.sample(0)[v]);
        const Vec3d wanted = lead_in > 0 ? rest[v] + 0.5 * frame * (first - rest[v])
                                         : vec_cast<double>(moves.sample(frame)[v]);
        EXPECT_LT(length(vec_cast<double>(written.sample(frame)[v]) - wanted - Vec3d{8, 0, 0}),
                  1e-6);
      }
  }
}

TEST(Exports, OnImageWritesTheSamplesOfAMesh) {
  const test::TemporaryFolder folder;
  const ExportedRun run(tube(folder / "tube.obj", 1), WrittenOn::image);
  EXPECT_GT(run.cache.points, 200);
  EXPECT_FALSE(fs::exists(run.folder / "ring.image.pc2"));
}

TEST(Exports, UnitsOfFilesChangeNothingButTheNumbers) {
  const test::TemporaryFolder folder;
  const ExportedRun metres(tube(folder / "tube.obj", 1));
  Scene scene = tube(folder / "centimetres.obj", 0.01);
  scene.files.unit = *find_length_unit("cm");
  const ExportedRun centimetres(scene);
  EXPECT_EQ(centimetres.points(0), as_floats(read_mesh(folder / "centimetres.obj").positions));
  for (int frame = 0; frame <= exported_frames; ++frame) {
    const std::vector<Vec3f> a = metres.points(frame), b = centimetres.points(frame);
    for (std::size_t v = 0; v < a.size(); ++v) EXPECT_LT(length(a[v] - 0.01F * b[v]), 2e-5);
  }
}

TEST(Exports, FoldersOfRunsInOtherUnitsOpenInMetres) {
  const test::TemporaryFolder folder;
  Scene scene = tube(folder / "inches.obj", 0.0254);
  scene.files = {*find_length_unit("in"), false};
  const ExportedRun run(scene);
  Simulation again(scene, "scene.json", 1);
  again.advance();
  const Planes3 found = open_run_folder(run.folder.path()).cloths.at(0).recorded.positions(1);
  const Planes3& wanted = again.cloths()[0].state.position;
  for (int s = 0; s < 17 * 17; ++s) EXPECT_LT(length(found.at(s) - wanted.at(s)), 1e-6);
}

TEST(Exports, MeshesOfImagesAreRefusedByName) {
  const test::TemporaryFolder place;
  Scene scene = thrown_ring();
  scene.cloths[0].surface = "shirt.exr";
  const auto message = [&](bool unwelded) {
    return test::message_of<UsageError>([&] {
      run_scene(scene, "scene.json",
                {.folder = place / "run", .on = WrittenOn::input, .unwelded = unwelded});
    });
  };
  EXPECT_EQ(message(false),
            "--on input: the cloth 'ring' is a geometry image, shirt.exr, which holds no mesh; the "
            "mesh that it was made from in its place, or --on image, is wanted");
  EXPECT_NE(message(true).find("--unwelded"), std::string::npos);
  EXPECT_FALSE(fs::exists(place / "run"));
}

TEST(Exports, BodiesAreWrittenWithTheMeshThatTheyCameFrom) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = make_shape("box");
  write_mesh(folder / "box.obj", box);
  Scene scene = thrown_ring();
  SceneBody body;
  body.surface = (folder / "box.obj").string();
  body.size = 33;
  body.placement.translate = {0, 0.25, 0};
  scene.bodies = {body};
  const ExportedRun run(scene);
  const TriangleMesh written = read_mesh(run.folder / "body.obj");
  ASSERT_EQ(written.positions.size(), box.positions.size());
  for (std::size_t v = 0; v < box.positions.size(); ++v)
    EXPECT_EQ(vec_cast<float>(written.positions[v]),
              vec_cast<float>(box.positions[v] + Vec3d{0, 0.25, 0}));
  EXPECT_TRUE(fs::exists(run.folder / "body.glb"));
  EXPECT_FALSE(fs::exists(run.folder / "body.pc2"));  // it stands still
}

}  // namespace
}  // namespace weft::export_input_test
