#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "weft/vec.h"

namespace weft {

/// The frames of a point cache, read one at a time.
class PointFrames {
 public:
  /// @throws InputError for what is no PC2 file or does not hold what it says
  explicit PointFrames(const std::filesystem::path& path);

  [[nodiscard]] int points() const { return points_; }
  [[nodiscard]] int frames() const { return frames_; }
  /// @pre 0 <= frame < frames()  @throws InputError when the file was cut since
  [[nodiscard]] std::vector<Vec3f> read(int frame);

 private:
  std::filesystem::path path_;
  std::ifstream in_;
  int points_ = 0, frames_ = 0;
};

}  // namespace weft
