#include "weft/run/export/motion_writer.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <utility>

#include "weft/core/assert.h"
#include "weft/files.h"
#include "weft/run/export/frame_files.h"
#include "weft/run/export/frame_sequence.h"
#include "weft/run/export/motion_writer.h"
#include "weft/run/export/point_cache_writers.h"
#include "weft/run/export/surface_points.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> formats{"obj", "pc2", "mdd", "glb",
                                                  "ply", "vtp", "exr", "usda"};

class Pc2Motion : public MotionWriter {
 public:
  Pc2Motion(fs::path path, int points) : path_(std::move(path)), points_(points) {}

  void start() override { open(Pc2Writer(path_, points_, TemporaryName::of_the_file)); }
  void check_resumable(const MotionFrame& last) const override {
    Pc2Writer::check_resumable(path_, last.number() + 1, last.points());
  }
  void resume(const MotionFrame& last, bool finished) override {
    const int frames = last.number() + 1;
    if (finished && is_whole_pc2(path_, frames, last.points())) return;
    open(Pc2Writer::resume(path_, frames, last.points()));
  }
  void add(const MotionFrame& frame) override { writer_->add(frame.points()); }
  void flush() override {
    if (writer_) writer_->flush();
  }
  void finish() override {
    if (writer_) writer_->finish();
  }
  [[nodiscard]] std::vector<fs::path> outputs() const override { return {path_}; }

 private:
  void open(Pc2Writer writer) { writer_ = std::make_unique<Pc2Writer>(std::move(writer)); }

  fs::path path_;
  int points_;
  std::unique_ptr<Pc2Writer> writer_;  // none where the file is whole
};

/// Converts the point cache of the same vertices, once that is finished.
class MadeOfCache : public MotionWriter {
 public:
  using Write = void (*)(const fs::path&, const FinishedMotion&);
  MadeOfCache(fs::path path, Write write, MotionPlace place, const ExportedSurface& surface)
      : path_(std::move(path)), write_(write), place_(std::move(place)), surface_(surface) {}

  void start() override {}
  void check_resumable(const MotionFrame& /*last*/) const override {}
  void resume(const MotionFrame& /*last*/, bool /*finished*/) override {}
  void add(const MotionFrame& /*frame*/) override {}
  void flush() override {}
  void finish() override {
    PointFrames cache(place_.cache);
    write_(path_, {place_.name, &surface_, cache.frames(), place_.frame_rate,
                   [&](int frame) { return cache.read(frame); }});
  }
  [[nodiscard]] std::vector<fs::path> outputs() const override { return {path_}; }

 private:
  fs::path path_;
  Write write_;
  MotionPlace place_;
  const ExportedSurface& surface_;
};

fs::path file(const MotionPlace& place, std::string_view format) {
  return place.folder / std::string(place.name).append(".").append(format);
}

FrameSequence::Options sequence(std::string_view format, const MotionPlace& place,
                                const ExportedSurface& surface) {
  FrameSequence::Options options{place.folder, place.name, std::string(format), exr_frame, {}, {}};
  if (format == "ply")
    options.encode = [frames = PlyFrames(surface)](const MotionFrame& frame) {
      return frames.encode(frame);
    };
  if (format == "vtp") {
    options.encode = [frames = VtpFrames(surface, place.frame_rate)](const MotionFrame& frame) {
      return frames.encode(frame);
    };
    options.index_ending = ".pvd";
    options.index = [folder = place.name + "_vtp",
                     rate = place.frame_rate](const std::vector<std::string>& files) {
      return pvd_text(folder, files, rate);
    };
  }
  return options;
}

MadeOfCache::Write writer_of(std::string_view format) {
  return format == "mdd" ? write_mdd : format == "glb" ? write_glb : write_usda;
}

}  // namespace

std::span<const std::string_view> export_formats() { return formats; }

std::string_view name_of(WrittenOn on) {
  return on == WrittenOn::image ? "image" : on == WrittenOn::input ? "input" : "auto";
}

bool is_on_input(std::string_view format, WrittenOn on) {
  if (on == WrittenOn::image || format == "exr") return false;
  return on == WrittenOn::input || format == "obj" || format == "pc2" || format == "mdd" ||
         format == "glb";
}

bool is_made_of_cache(std::string_view format) {
  return format == "mdd" || format == "glb" || format == "usda";
}

std::unique_ptr<MotionWriter> make_motion_writer(std::string_view format, const MotionPlace& place,
                                                 const ExportedSurface& surface) {
  WEFT_ASSERT(format != "obj");
  if (format == "pc2") return std::make_unique<Pc2Motion>(place.cache, surface.vertices());
  if (is_made_of_cache(format))
    return std::make_unique<MadeOfCache>(file(place, format), writer_of(format), place, surface);
  return std::make_unique<FrameSequence>(sequence(format, place, surface));
}

std::optional<fs::path> write_still(std::string_view format, const MotionPlace& place,
                                    const MotionFrame& frame) {
  if (format == "pc2" || format == "mdd" || format == "exr") return std::nullopt;
  const fs::path path = file(place, format);
  const ExportedSurface& surface = frame.surface();
  const auto write = [&](const std::string& bytes) {
    write_file(path, [&](std::ostream& out) { out << bytes; });
  };
  if (format == "obj") {
    write_obj(path, surface, frame.points());
  } else if (format == "ply") {
    write(PlyFrames(surface).encode(frame));
  } else if (format == "vtp") {
    write(VtpFrames(surface, place.frame_rate).encode(frame));
  } else {
    writer_of(format)(
        path, {place.name, &surface, 1, place.frame_rate, [&](int) { return frame.points(); }});
  }
  return path;
}

}  // namespace weft
