#pragma once

#include <filesystem>
#include <memory>

#include "weft/view/picture.h"

namespace weft {

/// A movie that appears whole: frames go raw through a pipe to ffmpeg, which writes under a
/// temporary name. Odd sizes lose their last row or column in .mp4, as its colour format wants even
/// ones.
class MovieWriter {
 public:
  /// @param path  .mp4 or .gif  @param frame_rate  [1/s]
  /// @throws OutputError when ffmpeg is missing or the place cannot be written
  MovieWriter(const std::filesystem::path& path, int width, int height, double frame_rate);
  MovieWriter(const MovieWriter&) = delete;
  MovieWriter& operator=(const MovieWriter&) = delete;
  /// Without `finish` nothing is left behind.
  ~MovieWriter();
  /// @param picture  of the size that the writer was made for
  /// @throws OutputError with the last line that ffmpeg said when it has given up
  void add(const Picture& picture);
  /// Ends the movie and puts it in its place. @throws OutputError
  void finish();

 private:
  struct Pipe;
  std::unique_ptr<Pipe> pipe_;
};

}  // namespace weft
