#pragma once

#include <filesystem>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "weft/point_cache.h"
#include "weft/run.h"

namespace weft::test {

inline constexpr int exported_frames = 3;

/// A ring that is thrown into the air, placed so that no coordinates are alike: 256 vertices, 512
/// triangles.
inline Scene thrown_ring() {
  Scene scene;
  scene.frames = exported_frames;
  SceneCloth cloth;
  cloth.name = "ring";
  cloth.surface = "builtin:torus";
  cloth.size = 17;
  cloth.placement = {{1, 1, 1}, {10, 20, 30}, {0, 2, 0.5}};
  cloth.velocity = {1, 2, 3};
  scene.cloths = {cloth};
  return scene;
}

/// A run that exports everything, and the cache of its first cloth.
struct ExportedRun {
  explicit ExportedRun(const Scene& scene, WrittenOn on = WrittenOn::automatic) {
    run_scene(scene, "scene.json",
              {.folder = folder.path(),
               .exports = {"obj", "pc2", "mdd", "glb", "ply", "vtp", "exr", "usda"},
               .on = on});
    cache = read_point_cache(folder / (scene.cloths[0].name + ".pc2"));
  }
  [[nodiscard]] std::vector<Vec3f> points(int frame) const {
    const auto sample = cache.sample(frame);
    return {sample.begin(), sample.end()};
  }
  TemporaryFolder folder;
  PointCache cache;
};

inline std::vector<Vec3f> as_floats(const std::vector<Vec3d>& points) {
  std::vector<Vec3f> floats;
  for (const Vec3d& p : points) floats.push_back(vec_cast<float>(p));
  return floats;
}

}  // namespace weft::test
