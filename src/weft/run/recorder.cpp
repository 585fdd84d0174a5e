#include "weft/run/recorder.h"

#include <ostream>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/garment.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/metadata.h"
#include "weft/image_file.h"
#include "weft/mesh.h"
#include "weft/mesh/crossings.h"
#include "weft/run.h"
#include "weft/run/export/cache_manifest.h"
#include "weft/run/run_identity.h"
#include "weft/run/run_manifest.h"
#include "weft/run_folder.h"

namespace weft {

namespace fs = std::filesystem;

namespace {

/// Tells triangles of panels that are neighbours across a seam which is open between them.
std::function<bool(int, int)> at_open_seam(const Garment& garment, const SurfacePoints& grid,
                                           const std::vector<Triangle>& triangles,
                                           const std::vector<Vec3f>& points) {
  return [&garment, &grid, triangles, points](int s, int t) {
    for (const int a : triangles[s])
      for (const int b : triangles[t])
        if (garment.sewn.representative(grid.sample_of[a]) ==
                garment.sewn.representative(grid.sample_of[b]) &&
            !(points[a] == points[b]))
          return true;
    return false;
  };
}

}  // namespace

Recorder::Recorder(const Simulation& simulation, const Scene& scene, const RunOptions& options)
    : simulation_(simulation), scene_(scene), options_(options) {
  const ExportOptions exports{options.folder,   options.exports,  options.on,
                              options.unwelded, scene.frame_rate, scene.files};
  record_cloths(exports);
  record_bodies(exports);
}

void Recorder::record_cloths(const ExportOptions& options) {
  for (std::size_t i = 0; i < simulation_.cloths().size(); ++i) {
    const SimulatedCloth& cloth = simulation_.cloths()[i];
    const SurfaceRecord::Subject subject{cloth.name,
                                         &cloth.image,
                                         &cloth.state.position,
                                         &cloth.model->start_positions(),
                                         cloth.source ? &*cloth.source : nullptr,
                                         placement_map(scene_.cloths[i].placement),
                                         true,
                                         cloth.garment.get()};
    write_image_of(subject);
    write_rest(cloth, scene_.cloths[i].placement);
    cloths_.push_back(std::make_unique<SurfaceRecord>(subject, options));
    cloths_.back()->write_still_files();
  }
}

void Recorder::record_bodies(const ExportOptions& options) {
  body_rests_.reserve(simulation_.bodies().size());
  for (std::size_t i = 0; i < simulation_.bodies().size(); ++i) {
    const PlacedBody& body = simulation_.bodies()[i];
    const PlacementMap placement = placement_map(scene_.bodies[i].placement);
    body_rests_.push_back(placed_positions(body.image, placement));
    const SurfaceRecord::Subject subject{body.name,
                                         &body.image,
                                         &body.positions,
                                         &body_rests_.back(),
                                         body.source ? &*body.source : nullptr,
                                         placement,
                                         body.moves,
                                         nullptr,
                                         [this, i] { return simulation_.body_vertices(i); }};
    write_image_of(subject);
    write_normals(body);
    bodies_.push_back(std::make_unique<SurfaceRecord>(subject, options));
    bodies_.back()->write_still_files();
  }
}

fs::path Recorder::file(const std::string& name, const std::string& ending) const {
  return options_.folder / (name + ending);
}

void Recorder::write_image_of(const SurfaceRecord::Subject& subject) {
  write_image(file(subject.name, ".exr"), *subject.image);
  rests_.push_back(file(subject.name, ".exr"));
}

void Recorder::write_rest(const SimulatedCloth& cloth, const Placement& placement) {
  const fs::path path = rest_path(options_.folder, cloth.name);
  std::error_code ignored;
  fs::remove(path, ignored);  // of an earlier run
  if (!cloth.model->start && placement.scale == Vec3d{1, 1, 1}) return;
  GeometryImage sewn = cloth.image;
  sewn.mates = cloth.model->mates;
  const std::string bytes = encode_exr(cloth.model->rest, metadata_text(sewn));
  write_file(path, [&](std::ostream& out) { out << bytes; });
  rests_.push_back(path);
}

void Recorder::write_normals(const PlacedBody& body) {
  const fs::path path = normals_path(options_.folder, body.name);
  std::error_code ignored;
  fs::remove(path, ignored);  // of an earlier run
  if (!body.image_normals) return;
  const std::string bytes = encode_exr(body.image_normals->normal, "normals");
  write_file(path, [&](std::ostream& out) { out << bytes; });
  rests_.push_back(path);
}

template <class Visit>
void Recorder::each(const Visit& visit) const {
  for (const Records* records : {&cloths_, &bodies_})
    for (const auto& record : *records) visit(*record);
}

void Recorder::start() {
  each([](SurfaceRecord& record) { record.start(); });
}

void Recorder::resume(bool finished) {
  const int frame = simulation_.frame();
  // All are checked before the first is truncated.
  each([&](const SurfaceRecord& record) { record.check_resumable(frame); });
  each([&](SurfaceRecord& record) { record.resume(frame, finished); });
}

void Recorder::add_frame() {
  each([&](SurfaceRecord& record) { record.add(simulation_.frame()); });
}

void Recorder::flush() {
  each([](SurfaceRecord& record) { record.flush(); });
}

void Recorder::finish(RunReport& report) {
  each([](SurfaceRecord& record) { record.finish(); });
  report.outputs = rests_;
  each([&](const SurfaceRecord& record) {
    for (const fs::path& path : record.outputs()) report.outputs.push_back(path);
  });
  const fs::path table = options_.folder / "frames.csv";
  write_file(table, [&](std::ostream& out) {
    out << frames_csv_header();
    for (std::size_t i = 0; i < report.history.size(); ++i)
      out << frames_csv_line(static_cast<int>(i) + 1, report.history[i], report.particles);
  });
  report.outputs.push_back(table);
  write_manifests(report);
}

void Recorder::make_of_caches() {
  each([](SurfaceRecord& record) { record.make_of_caches(); });
}

void Recorder::write_manifests(RunReport& report) {
  CacheManifest exports{scene_.files, scene_.frame_rate,
                        static_cast<int>(report.centre_of_mass.size())};
  RunCaches caches{options_.folder, options_.unwelded, {}, {}};
  for (const auto& record : cloths_) {
    exports.cloths.push_back(record.get());
    caches.cloths.push_back(record->image_cache());
  }
  for (const auto& record : bodies_) {
    exports.bodies.push_back(record.get());
    caches.bodies.push_back(record->image_cache());
  }
  const fs::path shown = options_.folder / "caches.json";
  write_cache_manifest(shown, exports, input_files(scene_));
  const fs::path manifest = options_.folder / "weft-run.json";
  write_run_manifest(manifest, scene_, report, caches);
  report.outputs.push_back(shown);
  report.outputs.push_back(manifest);
}

bool Recorder::is_open(const SurfaceRecord& record) const {
  for (const SimulatedCloth& cloth : simulation_.cloths())
    if (&cloth.state.position == record.subject().now) return cloth.model->apart.has_value();
  return false;
}

std::int64_t Recorder::written_crossings() {
  std::vector<CrossingSurface> surfaces;  // cloths first
  std::vector<std::function<bool(int, int)>> left_out;
  each([&](const SurfaceRecord& record) {
    // What spans an open seam is no cloth.
    const bool open = is_open(record);
    const ExportedSurface& written = open ? record.samples() : record.shown();
    const std::vector<Vec3f> points =
        open ? written.points(*record.subject().now) : record.points();
    std::vector<Corners> corners;
    const std::vector<Triangle> triangles = fans_of(written.faces()).triangles;
    corners.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles)
      corners.push_back(
          {vec_cast<double>(points[a]), vec_cast<double>(points[b]), vec_cast<double>(points[c])});
    left_out.push_back(
        open ? at_open_seam(*record.subject().garment, record.grid(), triangles, points)
             : [](int, int) { return false; });
    surfaces.emplace_back(std::move(corners), Neighbours(triangles));
  });
  std::int64_t count = 0;
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    count += surfaces[i].count_self_crossings(left_out[i]);
    for (std::size_t j = i + 1; j < surfaces.size(); ++j)
      count += surfaces[i].count_crossings(surfaces[j]);
  }
  return count;
}

}  // namespace weft
