#include "weft/run/export/surface_record.h"

#include <algorithm>
#include <ostream>
#include <vector>

#include "weft/files.h"
#include "weft/image/io/image_parts.h"
#include "weft/run/export/distinct_names.h"
#include "weft/run/export/exported_surface.h"
#include "weft/run/export/frame_files.h"

namespace weft {
namespace {

/// The panels of a garment as images of their own, as files hold them.
struct PanelImages {
  /// A part for each panel, under its name: R, G, B = x, y, z in the world [m], U, V = where the
  /// sample lies in the pattern's panel [cm]. float32.
  std::string exr;
  /// As numpy's arrays PANEL.position [rows x cols x 3] and PANEL.pattern [rows x cols x 2].
  std::string npz;
};

/// Names of panels as names of files, which unpacking may make of them.
std::vector<std::string> plain_names(const std::vector<Chart>& charts) {
  std::vector<std::string> names;
  DistinctNames distinct;
  for (const Chart& chart : charts) names.push_back(distinct.add(chart.name));
  return names;
}

ImagePart::Channel channel_of(const char* name, const Chart& chart, const Grid<float>& plane,
                              float scale) {
  ImagePart::Channel channel{name, {}};
  for (int r = 0; r < chart.rows; ++r)
    for (int c = 0; c < chart.cols; ++c)
      channel.values.push_back(scale * plane(chart.row + r, chart.col + c));
  return channel;
}

/// @param samples  of the garment's image, now [m]
PanelImages panel_images(const Garment& garment, const Planes3& samples) {
  const std::vector<Chart>& charts = garment.image.mates.charts();
  const std::vector<std::string> names = plain_names(charts);
  std::vector<ImagePart> parts, arrays;
  for (std::size_t p = 0; p < charts.size(); ++p) {
    const Chart& chart = charts[p];
    const ImagePart position{
        names[p] + ".position",
        chart.rows,
        chart.cols,
        {channel_of("R", chart, samples.x, 1), channel_of("G", chart, samples.y, 1),
         channel_of("B", chart, samples.z, 1)}};
    const ImagePart pattern{names[p] + ".pattern",
                            chart.rows,
                            chart.cols,
                            {channel_of("U", chart, garment.texture.x, pattern_units),
                             channel_of("V", chart, garment.texture.y, pattern_units)}};
    arrays.push_back(position);
    arrays.push_back(pattern);
    ImagePart both = position;
    both.name = names[p];
    both.channels.insert(both.channels.end(), pattern.channels.begin(), pattern.channels.end());
    parts.push_back(std::move(both));
  }
  return {encode_exr_parts(parts), encode_npz_parts(arrays)};
}

}  // namespace

SurfaceRecord::SurfaceRecord(const Subject& subject, const ExportOptions& options)
    : subject_(subject),
      options_(options),
      grid_(surface_points(*subject.image, options.unwelded)),
      on_image_(grid_, *subject.image, options.files) {
  if (subject.source != nullptr && !options.unwelded && options.on != WrittenOn::image)
    on_input_.emplace(
        grid_,
        ExportedSurface::Source{subject.image, subject.source, subject.rest, subject.placement},
        options.files);
  if (subject.garment != nullptr && !options.unwelded && options.on != WrittenOn::image) {
    sewn_ = sewn_points(*subject.image, subject.garment->sewn);
    on_input_.emplace(sewn_, *subject.garment, options.files);
  }
  if (subject.moves) add_writers();
}

std::vector<Vec3f> SurfaceRecord::points(bool on_input) const {
  const std::vector<Vec3d> known =
      on_input && subject_.vertices ? subject_.vertices() : std::vector<Vec3d>();
  if (known.empty()) return surface(on_input).points(*subject_.now);
  std::vector<Vec3f> points;
  points.reserve(known.size());
  for (const Vec3d& p : known) points.push_back(vec_cast<float>(in_frame(p, options_.files)));
  return points;
}

MotionPlace SurfaceRecord::place(bool on_input) const {
  // NAME.pc2 has the vertices of NAME.obj.
  const bool beside = !on_input && on_input_.has_value();
  return {options_.folder, subject_.name,
          options_.folder / (subject_.name + (beside ? ".image.pc2" : ".pc2")),
          options_.frame_rate};
}

void SurfaceRecord::add_writer(const std::string& format, bool on_input) {
  writers_.push_back(
      {format, on_input, make_motion_writer(format, place(on_input), surface(on_input))});
}

void SurfaceRecord::add_writers() {
  const auto cached = [](const std::string& format) {
    return format == "pc2" || is_made_of_cache(format);
  };
  bool input_cache = false, image_cache = false;
  for (const std::string& format : options_.formats) {
    if (!cached(format)) continue;
    image_cache = true;  // runs are drawn from it, too
    input_cache = input_cache || shows_input(format);
  }
  if (input_cache) add_writer("pc2", true);
  if (image_cache) {
    add_writer("pc2", false);
    image_cache_ = place(false).cache.filename().string();
  }
  for (const std::string& format : options_.formats)
    if (format != "pc2" && format != "obj") add_writer(format, shows_input(format));
}

void SurfaceRecord::write_still_files() {
  still_.clear();
  for (const std::string& format : options_.formats) {
    if (subject_.moves && format != "obj") continue;
    const bool on_input = shows_input(format);
    const MotionFrame now = frame(0, on_input);
    if (const auto path = write_still(format, place(on_input), now))
      still_.push_back({*path, format, on_input, surface(on_input).vertices()});
  }
}

template <class Visit>
void SurfaceRecord::each_frame(int frame, const Visit& visit) const {
  for (const bool on_input : {true, false}) {
    std::optional<MotionFrame> now;  // shared by all writers of these vertices
    for (const Writer& writer : writers_) {
      if (writer.on_input != on_input) continue;
      if (!now) now.emplace(this->frame(frame, on_input));
      visit(*writer.files, *now);
    }
  }
}

void SurfaceRecord::start() {
  for (const Writer& writer : writers_) writer.files->start();
  add(0);
}

void SurfaceRecord::check_resumable(int frame) const {
  each_frame(frame,
             [](const MotionWriter& files, const MotionFrame& now) { files.check_resumable(now); });
}

void SurfaceRecord::resume(int frame, bool finished) {
  each_frame(frame,
             [&](MotionWriter& files, const MotionFrame& now) { files.resume(now, finished); });
}

void SurfaceRecord::add(int frame) {
  each_frame(frame, [](MotionWriter& files, const MotionFrame& now) { files.add(now); });
}

void SurfaceRecord::flush() {
  for (const Writer& writer : writers_) writer.files->flush();
}

void SurfaceRecord::finish() {
  for (const Writer& writer : writers_)
    if (!is_made_of_cache(writer.format)) writer.files->finish();
  if (subject_.garment != nullptr) write_draped();
}

void SurfaceRecord::write_draped() {
  const auto named = [&](const char* ending) { return options_.folder / (subject_.name + ending); };
  const auto& formats = options_.formats;
  if (std::find(formats.begin(), formats.end(), "obj") != formats.end()) {
    const bool on_input = shows_input("obj");
    const ExportedSurface& mesh = surface(on_input);
    write_obj(named(".draped.obj"), mesh, mesh.points(*subject_.now));
    still_.push_back({named(".draped.obj"), "obj", on_input, mesh.vertices()});
  }
  const PanelImages panels = panel_images(*subject_.garment, *subject_.now);
  for (const auto& [ending, bytes] :
       {std::pair{".panels.exr", panels.exr}, {".panels.npz", panels.npz}}) {
    write_file(named(ending), [&text = bytes](std::ostream& out) { out << text; });
    images_.push_back(named(ending));
  }
}

void SurfaceRecord::make_of_caches() {
  for (const Writer& writer : writers_)
    if (is_made_of_cache(writer.format)) writer.files->finish();
}

std::vector<WrittenFile> SurfaceRecord::written() const {
  std::vector<WrittenFile> all = still_;
  for (const Writer& writer : writers_)
    for (const std::filesystem::path& path : writer.files->outputs())
      all.push_back({path, writer.format, writer.on_input, surface(writer.on_input).vertices()});
  return all;
}

std::vector<std::filesystem::path> SurfaceRecord::outputs() const {
  std::vector<std::filesystem::path> paths;
  for (const WrittenFile& file : written()) paths.push_back(file.path);
  paths.insert(paths.end(), images_.begin(), images_.end());
  return paths;
}

}  // namespace weft
