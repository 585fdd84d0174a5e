#include "weft/sim/recorder.h"

#include <algorithm>
#include <ostream>

#include "weft/core/files.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/image_file.h"
#include "weft/sim/report.h"
#include "weft/sim/run_folder.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

bool asks_for(const RunOptions& options, std::string_view format) {
  return std::find(options.exports.begin(), options.exports.end(), format) != options.exports.end();
}

}  // namespace

Recorder::Recorder(const Simulation& simulation, const Scene& scene, const RunOptions& options)
    : simulation_(simulation), scene_(scene), options_(options) {
  for (const SimulatedCloth& cloth : simulation.cloths()) {
    cloths_.push_back(surface_points(cloth.image, options_.unwelded));
    write_surface(cloth.name, cloth.image, cloth.state.position, cloths_.back());
  }
  for (const PlacedBody& body : simulation.bodies()) write_body(body);
  if (!asks_for(options, "pc2")) return;
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    moving_.push_back(
        {simulation.cloths()[i].name, &cloths_[i], &simulation.cloths()[i].state.position});
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (simulation.bodies()[i].moves)
      moving_.push_back(
          {simulation.bodies()[i].name, &bodies_[i], &simulation.bodies()[i].positions});
}

fs::path Recorder::file(const std::string& name, const std::string& ending) const {
  return options_.folder / (name + ending);
}

void Recorder::write_surface(const std::string& name, const GeometryImage& image,
                             const Planes3& positions, const SurfacePoints& points) {
  write_image(file(name, ".exr"), image);
  outputs_.push_back(file(name, ".exr"));
  if (!asks_for(options_, "obj")) return;
  write_obj(file(name, ".obj"), points, positions);
  outputs_.push_back(file(name, ".obj"));
}

void Recorder::write_body(const PlacedBody& body) {
  bodies_.push_back(surface_points(body.image, options_.unwelded));
  write_surface(body.name, body.image, body.positions, bodies_.back());
  const fs::path path = normals_path(options_.folder, body.name);
  std::error_code ignored;
  fs::remove(path, ignored);  // of an earlier run
  if (!body.image_normals) return;
  const std::string bytes = encode_exr(body.image_normals->normal, "normals");
  write_file(path, [&](std::ostream& out) { out << bytes; });
  outputs_.push_back(path);
}

void Recorder::start() {
  for (const Moving& moving : moving_)
    caches_.push_back(std::make_unique<Pc2Writer>(file(moving.name, ".pc2"),
                                                  static_cast<int>(moving.points->sample_of.size()),
                                                  TemporaryName::of_the_file));
  add_frame();
}

void Recorder::resume(bool finished) {
  const int frames = simulation_.frame() + 1;
  const auto each = [&](const auto& visit) {
    for (const Moving& moving : moving_) visit(file(moving.name, ".pc2"), moving.gather());
  };
  // All are looked at before the first is cut back.
  each([&](const fs::path& path, const std::vector<Vec3f>& last) {
    Pc2Writer::check_resumable(path, frames, last);
  });
  each([&](const fs::path& path, const std::vector<Vec3f>& last) {
    if (finished && is_whole_pc2(path, frames, last)) {
      outputs_.push_back(path);
    } else {
      caches_.push_back(std::make_unique<Pc2Writer>(Pc2Writer::resume(path, frames, last)));
    }
  });
}

void Recorder::add_frame() {
  for (std::size_t i = 0; i < caches_.size(); ++i) caches_[i]->add(moving_[i].gather());
}

void Recorder::flush() {
  for (const auto& cache : caches_) cache->flush();
}

void Recorder::finish(RunReport& report) {
  for (const auto& cache : caches_) {
    cache->finish();
    outputs_.push_back(cache->path());
  }
  const fs::path table = options_.folder / "frames.csv";
  write_file(table, [&](std::ostream& out) {
    out << frames_csv_header();
    for (std::size_t i = 0; i < report.history.size(); ++i)
      out << frames_csv_line(static_cast<int>(i) + 1, report.history[i]);
  });
  outputs_.push_back(table);
  report.outputs = outputs_;
  const fs::path manifest = options_.folder / "weft-run.json";
  write_run_manifest(manifest, scene_, report, options_);
  report.outputs.push_back(manifest);
}

IntersectionCounts Recorder::intersections() {
  if (!check_) {
    std::vector<GridTriangles> cloths, bodies;
    for (std::size_t i = 0; i < cloths_.size(); ++i)
      cloths.push_back({&simulation_.cloths()[i].state.position, &cloths_[i].triangles});
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      bodies.push_back({&simulation_.bodies()[i].positions, &bodies_[i].triangles});
    check_.emplace(cloths, bodies, scene_.ground);
  }
  return check_->count();
}

}  // namespace weft
