#include "weft/run/export/point_cache_writers.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <ostream>
#include <vector>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/pc2_header.h"
#include "weft/run.h"
#include "weft/run/bytes.h"
#include "weft/run/export/motion_writer.h"

namespace weft {

namespace {

namespace fs = std::filesystem;

fs::path unfinished(const fs::path& path) {
  return temporary_path(path, TemporaryName::of_the_file);
}

/// State of a file of an earlier writer: `frames` of its header is 0 until it is finished.
struct Left {
  bool holds = false;  ///< whether the wanted frames are there, the last of them equal
  int frames = 0;
};

Left examine(const fs::path& path, int frames, std::span<const Vec3f> last) {
  std::ifstream in(path, std::ios::binary);
  Pc2Header header;
  if (!in.read(reinterpret_cast<char*>(&header), sizeof(header)) || !header.is_known() ||
      frames < 1 || header.points != static_cast<std::int32_t>(last.size()))
    return {};
  std::vector<Vec3f> found(last.size());
  const auto bytes = static_cast<std::streamoff>(last.size_bytes());
  in.seekg(static_cast<std::streamoff>(header.file_bytes(frames - 1)));
  if (!in.read(reinterpret_cast<char*>(found.data()), bytes)) return {};
  // Bits, not values: resuming gives the same file.
  return {std::memcmp(found.data(), last.data(), last.size_bytes()) == 0, header.samples};
}

}  // namespace

Pc2Writer::Pc2Writer(const fs::path& path, int points, TemporaryName name)
    : path_(path), file_(std::make_unique<NewFile>(path, name)), points_(points) {
  if (name == TemporaryName::of_the_file) file_->keep_unfinished();
  open(std::ios::trunc);
  write_header();
}

void Pc2Writer::check_resumable(const fs::path& path, int frames, std::span<const Vec3f> last) {
  for (const fs::path& left : {unfinished(path), path})
    if (examine(left, frames, last).holds) return;
  throw InputError(path.string(),
                   fmt::format("does not hold the {} frames that the checkpoint follows", frames),
                   "the file that the run left, or a run without --resume, is wanted");
}

Pc2Writer Pc2Writer::resume(const fs::path& path, int frames, std::span<const Vec3f> last) {
  check_resumable(path, frames, last);
  const bool goes_on = examine(unfinished(path), frames, last).holds;
  auto file = std::make_unique<NewFile>(path, TemporaryName::of_the_file);
  file->keep_unfinished();
  std::error_code error;
  if (!goes_on) fs::copy_file(path, unfinished(path), fs::copy_options::overwrite_existing, error);
  Pc2Writer writer(path, std::move(file), static_cast<int>(last.size()));
  writer.frames_ = frames;
  if (!error) fs::resize_file(writer.file_->temporary(), writer.bytes(frames), error);
  if (error)
    throw OutputError(path.string(), "cannot be written: " + error.message(),
                      "more room is wanted");
  writer.open(std::ios::in);
  writer.out_.seekp(0, std::ios::end);
  return writer;
}

Pc2Writer::Pc2Writer(fs::path path, std::unique_ptr<NewFile> file, int points)
    : path_(std::move(path)), file_(std::move(file)), points_(points) {}

void Pc2Writer::open(std::ios::openmode how) {
  out_.open(file_->temporary(), std::ios::binary | std::ios::out | how);
  if (!out_) fail();
}

void Pc2Writer::fail() const {
  throw OutputError(path_.string(), "cannot be written whole", "more room is wanted");
}

std::uintmax_t Pc2Writer::bytes(int frames) const {
  return Pc2Header{.points = points_}.file_bytes(frames);
}

void Pc2Writer::write_header() {
  const Pc2Header header{.points = points_, .samples = frames_};
  out_.write(reinterpret_cast<const char*>(&header), sizeof(header));
}

void Pc2Writer::add(std::span<const Vec3f> points) {
  WEFT_ASSERT(static_cast<int>(points.size()) == points_);
  const auto bytes = std::as_bytes(points);
  out_.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  // Flushed, so that whole frames never stay in a buffer that a full disk would not take.
  if (!out_.flush()) fail();
  ++frames_;
}

void Pc2Writer::flush() { flush_to_disk(file_->temporary()); }

void Pc2Writer::finish() {
  out_.close();
  out_.clear();
  std::error_code error;
  fs::resize_file(file_->temporary(), bytes(frames_), error);
  if (error)
    throw OutputError(path_.string(), "cannot be written: " + error.message(),
                      "more room is wanted");
  open(std::ios::in);
  write_header();
  out_.close();
  if (!out_) fail();
  file_->commit();
}

bool is_whole_pc2(const fs::path& path, int frames, std::span<const Vec3f> last) {
  const Left left = examine(path, frames, last);
  std::error_code ignored;
  const Pc2Header wanted{.points = static_cast<std::int32_t>(last.size())};
  return left.holds && left.frames == frames &&
         fs::file_size(path, ignored) == wanted.file_bytes(frames);
}

void write_pc2(const fs::path& path, const PointCache& cache) {
  check_point_cache(cache, path.string());
  Pc2Writer writer(path, cache.points);
  for (int frame = 0; frame < cache.samples(); ++frame) writer.add(cache.sample(frame));
  writer.finish();
}

void write_mdd(const std::filesystem::path& path, const FinishedMotion& motion) {
  write_file(path, [&](std::ostream& out) {
    std::string bytes;
    append_big_endian(bytes, std::int32_t{motion.frames});
    append_big_endian(bytes, std::int32_t{motion.surface->vertices()});
    for (int frame = 0; frame < motion.frames; ++frame)
      append_big_endian(bytes, static_cast<float>(frame / motion.frame_rate));
    for (int frame = 0; frame < motion.frames; ++frame) {
      for (const Vec3f p : motion.points(frame))
        for (const float x : {p.x, p.y, p.z}) append_big_endian(bytes, x);
      out << bytes;
      bytes.clear();
    }
  });
}

}  // namespace weft
