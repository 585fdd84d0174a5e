#include <chrono>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/drawing.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/drape_scene.h"
#include "weft/drawing.h"
#include "weft/files.h"
#include "weft/image_file.h"
#include "weft/run.h"
#include "weft/scene_file.h"

namespace weft::app {
namespace {
namespace fs = std::filesystem;

/// State of the demo: its report and outputs so far.
struct Demo {
  fs::path folder;
  const Context& context;
  TerminalProgress progress;
  Json report = Json::object();
  std::vector<fs::path> outputs;

  Demo(fs::path where, const Context& with)
      : folder(std::move(where)), context(with), progress(with.quiet || with.json) {}

  /// Writes a file and prints its name.
  template <class Write>
  void add(const fs::path& name, const Write& write) {
    write(folder / name);
    outputs.push_back(folder / name);
    say(context, "wrote   " + outputs.back().string());
  }
};

// Converts the figure to a geometry image: both files, its normal map, and pictures of the image
// and of the cut.
void show_image(Demo& demo) {
  const std::string name = "builtin:mannequin";
  ConvertOptions options;
  options.normal_map_size = 512;
  options.threads = demo.context.threads;
  options.seed = demo.context.seed;
  options.progress = &demo.progress;
  const Conversion conversion = convert_mesh(load_mesh(name), name, options);
  for (const char* file : {"mannequin.exr", "mannequin.png"})
    demo.add(file, [&](const fs::path& path) { write_image(path, conversion.image); });
  demo.add("mannequin-normals.png",
           [&](const fs::path& path) { write_normal_map(path, *conversion.normals); });
  demo.add("mannequin-colours.png",
           [&](const fs::path& path) { write_png(path, colours_of(conversion.image, 512)); });
  demo.add("mannequin-map.png", [&](const fs::path& path) {
    write_png(path, draw_map(*conversion.charts[0].mapped, {.side = 512}));
  });
  demo.report["convert"] = conversion_json(name, conversion, {});
  say(demo.context,
      fmt::format(
          "image   {0} x {0} of {1}: stretch {2:.2f}, PSNR {3:.1f} dB, {4} flipped triangles",
          conversion.image.size(), name, conversion.map_quality.stretch_l2,
          conversion.quality.psnr_db, conversion.map_quality.flipped));
}

/// A cloth to show on the figure.
struct DemoDrape {
  std::string name, cloth;
  int frames = 120;
  double elevation = 0.2;  // of the eye [rad]
};

// Drapes one cloth on the figure: its scene, caches, last frame and movie.
void show_drape(Demo& demo, const DemoDrape& shown) {
  const std::string& name = shown.name;
  const ViewFrom view{960, 720, 0.45, shown.elevation};
  const fs::path run_folder = demo.folder / name;
  make_folder(run_folder);
  DrapeOptions placing;
  placing.frames = shown.frames;
  const Scene scene = make_drape_scene(shown.cloth, "builtin:mannequin", placing);
  write_scene(run_folder / "scene.json", scene);
  RunOptions options;
  options.folder = run_folder;
  options.threads = demo.context.threads;
  options.instructions = demo.context.instructions;
  options.progress = &demo.progress;
  options.checkpoint_frames = 0;
  const RunReport run = run_scene(scene, (run_folder / "scene.json").string(), options);
  demo.report[name] = Json::parse(to_json(run));
  for (const fs::path& path : run.outputs)
    demo.add(path.lexically_relative(demo.folder), [](const fs::path&) {});
  const RunFolder recorded = open_run_folder(run_folder);
  demo.add(name + ".png", [&](const fs::path& path) { write_png(path, draw_run(recorded, view)); });
  ViewFrom smaller = view;
  smaller.width = 640;
  smaller.height = 480;
  demo.add(name + ".mp4",
           [&](const fs::path& path) { film_run(recorded, path, smaller, &demo.progress); });
  say(demo.context,
      fmt::format(
          "cloth   {}: {} particles, {} frames, strain p99 {:.2f} %, {} intersections at the end",
          name, run.particles, run.frames, 100 * run.strain.p99, run.intersections.counts.total()));
}

void run_demo(const fs::path& folder, const Context& context) {
  const auto start = std::chrono::steady_clock::now();
  make_folder(folder);
  Demo demo(folder, context);
  show_image(demo);
  show_drape(demo, {"sheet", "builtin:sheet", 120, 0.2});
  show_drape(demo, {"tshirt", "builtin:tshirt", 120, 0.1});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  demo.report["seconds"] = seconds.count();
  demo.report["outputs"] = paths_json(demo.outputs);
  demo.report["outputs"].push_back((folder / "report.json").string());
  demo.add("report.json", [&](const fs::path& path) {
    write_file(path, [&](std::ostream& out) { out << text_of(demo.report) << "\n"; });
  });
  say(context, fmt::format("done    in {:.0f} s; look at {}", seconds.count(),
                           (folder / "sheet.png").string()));
  print_report(context, demo.report);
}

}  // namespace

void add_demo(CLI::App& program, const Context& context) {
  auto folder = std::make_shared<std::string>("out/demo");
  CLI::App* command =
      program.add_subcommand("demo", "Convert a figure, drape cloth over it, draw it all");
  command->add_option("-o,--output", *folder, "Folder for everything that is written")
      ->capture_default_str();
  command->footer("Example: weft demo -o out/demo");
  command->callback([folder, &context] { run_demo(*folder, context); });
}

}  // namespace weft::app
