#pragma once

#include <filesystem>
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

}  // namespace weft
