#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

#include "weft/core/files.h"
#include "weft/core/vec.h"

namespace weft {

/// A point cache (PC2) that appears whole, with the frames there are: version 1, one sample a frame
/// from frame 0, little-endian floats x y z a point.
class Pc2Writer {
 public:
  /// @throws OutputError when the place cannot be written
  Pc2Writer(const std::filesystem::path& path, int points);
  /// Appends a frame. @param points  [points] [m]  @throws OutputError when the disk is full
  void add(std::span<const Vec3f> points);
  /// Sets the count of frames and puts the file in its place. @throws OutputError
  void finish();
  [[nodiscard]] int frames() const { return frames_; }

 private:
  void write_header();

  std::filesystem::path path_;
  NewFile file_;
  std::ofstream out_;
  int points_ = 0, frames_ = 0;
};

}  // namespace weft
