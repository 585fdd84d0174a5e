#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "weft/run.h"
#include "weft/run/export/exported_surface.h"

namespace weft {

/// One frame of a surface to be written.
class MotionFrame {
 public:
  /// All by reference. @param samples  of the image, world [m]
  MotionFrame(int number, const Planes3& samples, const ExportedSurface& surface)
      : MotionFrame(number, samples, surface, surface.points(samples)) {}
  /// @param points  [surface.vertices()] of it, in the unit and axes of files
  MotionFrame(int number, const Planes3& samples, const ExportedSurface& surface,
              std::vector<Vec3f> points)
      : number_(number), samples_(samples), surface_(surface), points_(std::move(points)) {}

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

/// Writes the motion of one surface in one format, frame by frame. Finished files appear whole;
/// `resume` continues what a killed run left.
class MotionWriter {
 public:
  MotionWriter() = default;
  MotionWriter(const MotionWriter&) = delete;
  MotionWriter& operator=(const MotionWriter&) = delete;
  virtual ~MotionWriter() = default;

  /// Starts the output, before frame 0 is added. @throws OutputError, as everything that writes
  virtual void start() = 0;
  /// Checks that `resume` is possible.
  /// @throws InputError unless there are all frames up to `last`, that one with the same bits
  virtual void check_resumable(const MotionFrame& last) const = 0;
  /// Continues after a frame. @param finished  nothing will be added
  virtual void resume(const MotionFrame& last, bool finished) = 0;
  virtual void add(const MotionFrame& frame) = 0;
  /// Waits until all frames are on the disk.
  virtual void flush() = 0;
  /// Finishes the files with the frames added so far.
  virtual void finish() = 0;
  /// Paths of the files that `finish` leaves.
  [[nodiscard]] virtual std::vector<std::filesystem::path> outputs() const = 0;
};

/// A complete motion, for formats whose files cannot grow frame by frame.
struct FinishedMotion {
  std::string name;  ///< of the surface
  const ExportedSurface* surface = nullptr;
  int frames = 1;
  double frame_rate = 60;  ///< [1/s]
  /// The points of a frame; frames may be read in any order. [vertices]
  std::function<std::vector<Vec3f>(int frame)> points;
};

/// Lightwave's point cache: big-endian, the time of each frame [s]. @throws OutputError
void write_mdd(const std::filesystem::path& path, const FinishedMotion& motion);

/// Binary glTF 2.0: positions, normals and texture coordinates at frame 0, a morph target for each
/// later frame, and the animation of their weights, linear between frames. Vertices at texture
/// seams are repeated for each further coordinate, after the mesh's own vertices in their order.
/// The node has unit and axes, so that the scene is in metres, y up.
/// @throws OutputError, also above 4 GB, which the format cannot hold
void write_glb(const std::filesystem::path& path, const FinishedMotion& motion);

/// USD as text: a mesh with time samples of points and normals. @throws OutputError
void write_usda(const std::filesystem::path& path, const FinishedMotion& motion);

/// Whether files of a format are converted from a point cache after the run.
bool is_made_of_cache(std::string_view format);

/// Destination of a surface's motion.
struct MotionPlace {
  std::filesystem::path folder;  ///< DIR
  std::string name;              ///< of the surface
  std::filesystem::path cache;   ///< PC2 of the same vertices
  double frame_rate = 60;        ///< [1/s]
};
/// A writer of a format that holds motion: all but OBJ.
/// @param surface  must outlive it
std::unique_ptr<MotionWriter> make_motion_writer(std::string_view format, const MotionPlace& place,
                                                 const ExportedSurface& surface);

/// Writes a single frame as DIR/NAME.FORMAT, where the format can hold it.
/// @return its path, or nothing for caches and images  @throws OutputError
std::optional<std::filesystem::path> write_still(std::string_view format, const MotionPlace& place,
                                                 const MotionFrame& frame);

}  // namespace weft
