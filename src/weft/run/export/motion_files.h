#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "weft/run/export/exported_surface.h"

namespace weft {

/// A motion that is over, for formats whose files cannot grow frame by frame.
struct FinishedMotion {
  std::string name;  ///< of the surface
  const ExportedSurface* surface = nullptr;
  int frames = 1;
  double frame_rate = 60;  ///< [1/s]
  /// The points of a frame, any of them at any time. [vertices]
  std::function<std::vector<Vec3f>(int frame)> points;
};

/// Lightwave's point cache: big-endian, the time of each frame [s]. @throws OutputError
void write_mdd(const std::filesystem::path& path, const FinishedMotion& motion);

/// Binary glTF 2.0: positions, normals and texture coordinates at frame 0, a morph target for each
/// later frame, and the animation of their weights, linear between frames. Vertices at seams of the
/// texture are there once for each of their coordinates: the mesh's own vertices come first, in
/// their order. Unit and axes are those of the node, so that the scene is in metres, y up.
/// @throws OutputError, also above 4 GB, which the format cannot hold
void write_glb(const std::filesystem::path& path, const FinishedMotion& motion);

/// USD as text: a mesh with time samples of points and normals. @throws OutputError
void write_usda(const std::filesystem::path& path, const FinishedMotion& motion);

}  // namespace weft
