#include "weft/run/export/frame_sequence.h"

#include <charconv>
#include <optional>
#include <ostream>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// The number in NAME_0012.ending; nothing for what is not a frame of that name.
std::optional<int> number_of(const std::string& file, const std::string& name,
                             const std::string& format) {
  const std::string head = name + "_", tail = "." + format;
  if (!file.starts_with(head) || !file.ends_with(tail) || file.size() <= head.size() + tail.size())
    return std::nullopt;
  const char* begin = file.data() + head.size();
  const char* end = file.data() + file.size() - tail.size();
  int number = 0;
  const auto [stopped, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

}  // namespace

void remove_frames(const fs::path& place, const std::string& name, const std::string& format,
                   int from) {
  std::vector<fs::path> dropped;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(place, error)) {
    const auto number = number_of(entry.path().filename().string(), name, format);
    if (number && *number >= from) dropped.push_back(entry.path());
  }
  for (const fs::path& path : dropped) fs::remove(path, error);
}

fs::path FrameSequence::place() const {
  return options_.folder / fmt::format("{}_{}", options_.name, options_.format);
}

fs::path FrameSequence::file(int frame) const {
  return place() / fmt::format("{}_{:04}.{}", options_.name, frame, options_.format);
}

void FrameSequence::start() {
  make_folder(place());
  drop_from(0);
}

void FrameSequence::check_resumable(const MotionFrame& last) const {
  for (int frame = 0; frame < last.number(); ++frame)
    if (!fs::exists(file(frame)))
      throw InputError(file(frame).string(), "is not there",
                       "the files that the run left, or a run without --resume, are wanted");
  // Bytes, not values: resuming gives the same files.
  if (read_file(file(last.number())) != options_.encode(last))
    throw InputError(file(last.number()).string(), "is of another run",
                     "the file that the run left, or a run without --resume, is wanted");
}

void FrameSequence::resume(const MotionFrame& last, bool /*finished*/) {
  frames_ = last.number() + 1;
  drop_from(frames_);
}

void FrameSequence::add(const MotionFrame& frame) {
  const std::string bytes = options_.encode(frame);
  write_file(file(frame.number()), [&](std::ostream& out) { out << bytes; });
  frames_ = frame.number() + 1;
}

void FrameSequence::finish() {
  if (options_.index_ending.empty()) return;
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(frames_));
  for (int frame = 0; frame < frames_; ++frame) names.push_back(file(frame).filename().string());
  const std::string text = options_.index(names);
  write_file(options_.folder / (options_.name + options_.index_ending),
             [&](std::ostream& out) { out << text; });
}

std::vector<fs::path> FrameSequence::outputs() const {
  std::vector<fs::path> paths{place()};
  if (!options_.index_ending.empty())
    paths.push_back(options_.folder / (options_.name + options_.index_ending));
  return paths;
}

}  // namespace weft
