#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "weft/run/export/exported_surface.h"

namespace weft {

/// One moment of a surface that is written.
class MotionFrame {
 public:
  /// All by reference. @param samples  of the image, world [m]
  MotionFrame(int number, const Planes3& samples, const ExportedSurface& surface)
      : number_(number), samples_(samples), surface_(surface), points_(surface.points(samples)) {}

  [[nodiscard]] int number() const { return number_; }  ///< from 0, the start
  [[nodiscard]] const Planes3& samples() const { return samples_; }
  [[nodiscard]] const ExportedSurface& surface() const { return surface_; }
  [[nodiscard]] const std::vector<Vec3f>& points() const { return points_; }

 private:
  int number_;
  const Planes3& samples_;
  const ExportedSurface& surface_;
  std::vector<Vec3f> points_;
};

/// Writes the motion of one surface in one format, frame by frame. What is finished appears whole;
/// what a killed run left is where `resume` finds it.
class MotionWriter {
 public:
  MotionWriter() = default;
  MotionWriter(const MotionWriter&) = delete;
  MotionWriter& operator=(const MotionWriter&) = delete;
  virtual ~MotionWriter() = default;

  /// Begins, before frame 0 is added. @throws OutputError, as everything that writes
  virtual void start() = 0;
  /// @throws InputError unless there are all frames up to `last`, that one with the same bits
  virtual void check_resumable(const MotionFrame& last) const = 0;
  /// Goes on behind a frame. @param finished  nothing will be added
  virtual void resume(const MotionFrame& last, bool finished) = 0;
  virtual void add(const MotionFrame& frame) = 0;
  /// Waits until all frames are on the disk.
  virtual void flush() = 0;
  /// Puts everything in its place, with the frames that there are.
  virtual void finish() = 0;
  /// What `finish` leaves.
  [[nodiscard]] virtual std::vector<std::filesystem::path> outputs() const = 0;
};

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
