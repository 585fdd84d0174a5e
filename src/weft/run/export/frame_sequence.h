#pragma once

#include <functional>
#include <string>

#include "weft/run/export/motion_writer.h"

namespace weft {

/// Removes the frames of a sequence from a number on.
/// @param place  their folder  @param format  their ending, without dot
void remove_frames(const std::filesystem::path& place, const std::string& name,
                   const std::string& format, int from);

/// Writes a file for each frame, in a folder of their own: DIR/NAME_ply/NAME_0000.ply. Each appears
/// whole.
class FrameSequence : public MotionWriter {
 public:
  struct Options {
    std::filesystem::path folder;  ///< DIR
    std::string name;              ///< of the surface
    std::string format;            ///< the ending, without dot
    std::function<std::string(const MotionFrame&)> encode;
    /// Ending of an index file DIR/NAME.ENDING, made of the names of all frames at the end; empty:
    /// none.
    std::string index_ending;
    std::function<std::string(const std::vector<std::string>&)> index;
  };
  explicit FrameSequence(Options options) : options_(std::move(options)) {}

  void start() override;
  void check_resumable(const MotionFrame& last) const override;
  void resume(const MotionFrame& last, bool finished) override;
  void add(const MotionFrame& frame) override;
  void flush() override {}  // every file is on the disk when it appears
  void finish() override;
  [[nodiscard]] std::vector<std::filesystem::path> outputs() const override;

  [[nodiscard]] std::filesystem::path file(int frame) const;

 private:
  [[nodiscard]] std::filesystem::path place() const;
  void drop_from(int frame) const { remove_frames(place(), options_.name, options_.format, frame); }

  Options options_;
  int frames_ = 0;
};

}  // namespace weft
