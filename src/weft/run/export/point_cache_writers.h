#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>

#include "weft/files.h"
#include "weft/vec.h"

namespace weft {

/// Writes a point cache (PC2), which appears whole, with the frames added so far: version 1, one
/// sample a frame from frame 0, little-endian floats x y z a point.
class Pc2Writer {
 public:
  /// @param name  of_the_file: a process that is killed leaves what it wrote, for `resume`
  /// @throws OutputError when the place cannot be written
  Pc2Writer(const std::filesystem::path& path, int points,
            TemporaryName name = TemporaryName::of_this_process);
  /// Continues after `frames` frames of an earlier writer, unfinished or finished; later frames are
  /// dropped. A finished file stays as it is until this one is finished.
  /// @param last  the last of those frames, by which a file of another run is told apart
  /// @throws InputError when neither holds those frames; OutputError
  static Pc2Writer resume(const std::filesystem::path& path, int frames,
                          std::span<const Vec3f> last);

  /// Throws where `resume` would refuse. @throws InputError
  static void check_resumable(const std::filesystem::path& path, int frames,
                              std::span<const Vec3f> last);

  /// Appends a frame. @param points  [points] [m]  @throws OutputError when the disk is full
  void add(std::span<const Vec3f> points);
  /// Waits until all frames are on the disk. @throws OutputError
  void flush();
  /// Writes the frame count and renames the file to its path, with the whole frames that there was
  /// room for. @throws OutputError
  void finish();
  [[nodiscard]] int frames() const { return frames_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  Pc2Writer(std::filesystem::path path, std::unique_ptr<NewFile> file, int points);
  void open(std::ios::openmode how);
  void write_header();
  [[nodiscard]] std::uintmax_t bytes(int frames) const;
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::unique_ptr<NewFile> file_;
  std::ofstream out_;
  int points_ = 0, frames_ = 0;
};

/// Whether a file is a finished cache of exactly these frames.
bool is_whole_pc2(const std::filesystem::path& path, int frames, std::span<const Vec3f> last);

}  // namespace weft
