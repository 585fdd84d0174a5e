#include "weft/sim/run.h"

#include <algorithm>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "weft/collide/intersections.h"
#include "weft/core/error.h"
#include "weft/core/files.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/image_file.h"
#include "weft/sim/export/pc2_writer.h"
#include "weft/sim/export/surface_points.h"
#include "weft/sim/report.h"
#include "weft/sim/run_folder.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

bool asks_for(const RunOptions& options, std::string_view format) {
  return std::find(options.exports.begin(), options.exports.end(), format) != options.exports.end();
}

void check_exports(const RunOptions& options) {
  for (const std::string& format : options.exports)
    if (format != "obj" && format != "pc2")
      throw UsageError("--export", fmt::format("unknown format '{}'", format),
                       "known are: obj, pc2");
}

/// Everything that is written while a run goes on. Files that grow appear under their names at
/// `finish`.
class Recorder {
 public:
  Recorder(const Simulation& simulation, const Scene& scene, const RunOptions& options)
      : simulation_(simulation),
        scene_(scene),
        options_(options),
        csv_file_(options.folder / "frames.csv"),
        csv_(csv_file_.temporary()) {
    csv_ << frames_csv_header();
    for (const SimulatedCloth& cloth : simulation.cloths()) start_cloth(cloth);
    for (const PlacedBody& body : simulation.bodies()) write_body(body);
    add_positions();
  }

  void add_frame(const FrameReport& frame) {
    csv_ << frames_csv_line(simulation_.frame(), frame) << std::flush;
    add_positions();
  }

  /// Puts the files that grew in their places and names everything in the report.
  void finish(RunReport& report) {
    for (std::size_t i = 0; i < caches_.size(); ++i) {
      caches_[i]->finish();
      outputs_.push_back(file(simulation_.cloths()[i].name, ".pc2"));
    }
    csv_.close();
    if (!csv_)
      throw OutputError((options_.folder / "frames.csv").string(), "cannot be written whole", "");
    csv_file_.commit();
    outputs_.push_back(options_.folder / "frames.csv");
    report.outputs = outputs_;
    const fs::path manifest = options_.folder / "weft-run.json";
    write_run_manifest(manifest, scene_, report, options_);
    report.outputs.push_back(manifest);
  }

  /// Pairs of crossing triangles between cloths and bodies, and between different cloths, as they
  /// stand now.
  [[nodiscard]] int intersections() const {
    int total = 0;
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
      const GridTriangles cloth{&simulation_.cloths()[i].state.position, &cloths_[i].triangles};
      for (std::size_t b = 0; b < bodies_.size(); ++b)
        total +=
            count_intersections(cloth, {&simulation_.bodies()[b].positions, &bodies_[b].triangles});
      for (std::size_t other = 0; other < i; ++other)
        total += count_intersections(
            cloth, {&simulation_.cloths()[other].state.position, &cloths_[other].triangles});
    }
    return total;
  }

 private:
  [[nodiscard]] fs::path file(const std::string& name, const std::string& ending) const {
    return options_.folder / (name + ending);
  }

  void write_surface(const std::string& name, const GeometryImage& image, const Planes3& positions,
                     const SurfacePoints& points) {
    write_image(file(name, ".exr"), image);
    outputs_.push_back(file(name, ".exr"));
    if (!asks_for(options_, "obj")) return;
    write_obj(file(name, ".obj"), points, positions);
    outputs_.push_back(file(name, ".obj"));
  }

  void start_cloth(const SimulatedCloth& cloth) {
    cloths_.push_back(surface_points(cloth.image, options_.unwelded));
    write_surface(cloth.name, cloth.image, cloth.state.position, cloths_.back());
    if (asks_for(options_, "pc2"))
      caches_.push_back(std::make_unique<Pc2Writer>(
          file(cloth.name, ".pc2"), static_cast<int>(cloths_.back().sample_of.size())));
  }

  void write_body(const PlacedBody& body) {
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

  void add_positions() {
    for (std::size_t i = 0; i < caches_.size(); ++i)
      caches_[i]->add(cloths_[i].gather(simulation_.cloths()[i].state.position));
  }

  const Simulation& simulation_;
  const Scene& scene_;
  const RunOptions& options_;
  NewFile csv_file_;
  std::ofstream csv_;
  std::vector<SurfacePoints> cloths_, bodies_;
  std::vector<std::unique_ptr<Pc2Writer>> caches_;
  std::vector<fs::path> outputs_;
};

/// What is known before the first frame.
RunReport start_report(const Simulation& simulation, const Scene& scene, const std::string& name,
                       int threads) {
  RunReport report;
  report.scene = name;
  report.particles = simulation.particles();
  report.threads = threads;
  report.substeps = scene.substeps;
  report.integrator = name_of(scene.integrator);
  report.time_step = 1 / (scene.frame_rate * scene.substeps);
  report.notes = simulation.notes();
  report.centre_of_mass.push_back(simulation.centre_of_mass());
  return report;
}

void add_to_report(RunReport& report, const FrameReport& frame) {
  ++report.frames;
  report.history.push_back(frame);
  report.strain = frame.strain;
  report.contacts_max = std::max(report.contacts_max, frame.contacts);
  report.centre_of_mass.push_back(frame.centre_of_mass);
}

}  // namespace

RunReport run_scene(const Scene& scene, const std::string& name, const RunOptions& options) {
  check_exports(options);
  make_folder(options.folder);
  Simulation simulation(scene, name, options.threads, options.progress);
  RunReport report = start_report(simulation, scene, name, options.threads);
  Recorder recorder(simulation, scene, options);
  try {
    for (int frame = 0; frame < scene.frames; ++frame) {
      const FrameReport done = simulation.advance();
      recorder.add_frame(done);
      add_to_report(report, done);
      if (options.verify)
        report.intersections = std::max(report.intersections, recorder.intersections());
    }
    update(options.progress, "simulate", 1);
  } catch (...) {
    recorder.finish(report);
    throw;
  }
  if (!options.verify) report.intersections = recorder.intersections();
  report.state_hash = simulation.state_hash();
  recorder.finish(report);
  return report;
}

}  // namespace weft
