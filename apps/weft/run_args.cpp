#include "apps/weft/run_args.h"

#include <algorithm>
#include <climits>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/error.h"
#include "weft/fabric.h"
#include "weft/run.h"

namespace weft::app {
namespace {

constexpr std::uint64_t much_memory = 500'000'000;

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  // Of an even number the lower one, as in the report.
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Warns of motion that nothing explains, beside what cloth that large has to fall.
void tell_gain(const Context& context, const RunReport& report) {
  constexpr double worth_telling = 0.01, usual_height = 1;  // [m]
  const double height = std::max(usual_height, report.side);
  const double gain = relative_energy_gained(report) * usual_height / height;
  if (gain <= worth_telling) return;
  const bool by_default = report.integrator == name_of(Scene{}.integrator);
  warn(context, fmt::format("energy gained that nothing put in: {:.2g} times the weight times "
                            "{:.3g} m; more substeps{} are wanted",
                            gain, height, by_default ? "" : " or the default integrator"));
}

/// The first of some seams, each as `text` gives it.
template <class Seam, class Text>
std::string first_of(const std::vector<Seam>& seams, const Text& text) {
  constexpr std::size_t most = 3;
  std::string listed;
  for (std::size_t k = 0; k < std::min(most, seams.size()); ++k)
    listed += (k == 0 ? "" : ", ") + text(seams[k]);
  return seams.size() > most ? listed + ", ..." : listed;
}

/// How many seams are open, and the names of the widest.
std::string open_seams(const SeamsReport& seams) {
  return fmt::format("{} of {} seams are open, by up to {:.2f} mm ({})", seams.open.size(),
                     seams.count, 1000 * seams.largest_gap,
                     first_of(seams.open, [](const OpenSeam& seam) {
                       return fmt::format("{} {:.2f}", seam.name, 1000 * seam.gap);
                     }));
}

/// How many seams are stretched, and the names of the tightest.
std::string tight_seams(const SeamsReport& seams) {
  return fmt::format("{} of {} seams are too narrow for what they go round ({})",
                     seams.tight.size(), seams.count,
                     first_of(seams.tight, [](const TightSeam& seam) {
                       return fmt::format("{} {:.0f} %", seam.name, 100 * seam.stretch);
                     }));
}

/// Warns of seams that are open at the end, and of garments that nobody wears any more.
void tell_garments(const Context& context, const RunReport& report) {
  if (report.seams && !report.seams->tight.empty()) warn(context, tight_seams(*report.seams));
  // With verify it is an error that says the same.
  if (report.seams && !report.seams->open.empty() && !report.verification)
    warn(context, open_seams(*report.seams) +
                      "; more frames or a smaller spacing may close them, unless the body is too "
                      "wide there or lies between their edges");
  for (const std::string& name : report.fell_off) warn(context, name + ": fell off");
}

/// @param told  the notes that were printed before the first frame
void print_summary(const Context& context, const RunReport& report,
                   const std::set<std::string>& told) {
  std::vector<double> milliseconds;
  for (const FrameReport& frame : report.history) milliseconds.push_back(frame.milliseconds);
  for (const std::string& line : report.notes)
    if (told.count(line) == 0) note(context, line);
  say(context, fmt::format("ran     {} frames of {} particles, {} with {} substeps, {} thread(s)",
                           report.frames, report.particles, report.integrator, report.substeps,
                           report.threads));
  say(context, fmt::format("time    {:.1f} ms a frame (median)", median(milliseconds)));
  say(context,
      fmt::format("strain  mean {:.2f} %, p99 {:.2f} %, largest {:.2f} %", 100 * report.strain.mean,
                  100 * report.strain.p99, 100 * report.strain.max));
  say(context, fmt::format("touch   {} contacts at most, {} intersections", report.contacts_max,
                           report.intersections.counts.total()));
  if (report.seams)
    say(context, fmt::format("seams   {} of {} closed, largest gap {:.2f} mm", report.seams->closed,
                             report.seams->count, 1000 * report.seams->largest_gap));
  tell_garments(context, report);
  tell_gain(context, report);
  say(context, "state   " + report.state_hash);
  for (const auto& path : report.outputs) say(context, "wrote   " + path.string());
}

// Prints the memory that a large run needs, warns where it may not fit, and refuses what certainly
// does not.
void tell_memory(const Scene& scene, const std::string& name, const Context& context) {
  const std::uint64_t bytes = estimate_memory(scene);
  const std::optional<std::uint64_t> available = available_memory();
  if (available) check_memory(bytes, *available, name);
  if (available && is_memory_short(bytes, *available)) {
    warn(context, fmt::format("about {} of memory are needed, {} are there", memory_text(bytes),
                              memory_text(*available)));
  } else if (bytes >= much_memory) {
    say(context, "memory  about " + memory_text(bytes));
  }
}

/// Fails where a whole cloth was put back: it stands still while the scene goes on.
void check_whole_cloths(const RunReport& report, const std::string& name) {
  const auto fell = [](const FrameReport& frame) { return frame.whole_fell_back > 0; };
  const auto first = std::find_if(report.history.begin(), report.history.end(), fell);
  if (first == report.history.end()) return;
  throw Error(ExitCode::check_failed, name,
              fmt::format("a whole cloth was put back to where its step began in frame {}",
                          first - report.history.begin() + 1),
              "more substeps are wanted");
}

/// Fails where a garment is not sewn or not worn.
void check_garments(const RunReport& report, const std::string& name) {
  if (report.seams && !report.seams->open.empty())
    throw Error(ExitCode::check_failed, name, open_seams(*report.seams), "all closed is wanted");
  if (!report.fell_off.empty())
    throw Error(ExitCode::check_failed, name, fmt::format("'{}' fell off", report.fell_off.front()),
                "a garment worn is wanted");
}

void check_verification(const Verification& found, const std::string& name) {
  const auto check = [&](const WorstCount& worst, const char* what) {
    if (worst.count > 0)
      throw Error(ExitCode::check_failed, name,
                  fmt::format("{} {} in frame {}", worst.count, what, worst.frame),
                  "none is wanted");
  };
  check(found.swallowed, "points were swallowed by closed bodies");
  check(found.passed, "pairs of vertices and faces or of edges met within steps");
  check(found.written, "pairs of triangles cross in the meshes that are written");
}

RunOptions options_of(const RunArgs& args, const Context& context, TerminalProgress& progress,
                      std::set<std::string>& told) {
  RunOptions options;
  options.folder = args.folder;
  options.exports = args.exports;
  options.unwelded = args.unwelded;
  for (const WrittenOn on : {WrittenOn::image, WrittenOn::input})
    if (args.on == name_of(on)) options.on = on;
  options.verify = args.verify;
  options.threads = context.threads;
  options.instructions = context.instructions;
  options.progress = &progress;
  options.tell = [&](const std::string& line) {
    progress.clear();
    note(context, line);
    told.insert(line);
  };
  options.checkpoint_frames = args.checkpoint;
  options.resume = args.resume;
  options.until_rest = args.until_rest;
  options.scene_file = args.scene_file;
  return options;
}

std::vector<std::string_view> material_names() {
  std::vector<std::string_view> names;
  for (const NamedMaterial& material : named_materials()) names.push_back(material.name);
  return names;
}

CLI::IsMember is_one_of(const std::vector<std::string_view>& names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace

void add_run_options(CLI::App& command, RunArgs& args) {
  command.add_option("-o,--output", args.folder, "Folder for everything that is written")
      ->required();
  command.add_option("--frames", args.frames, "Frames to run instead of the scene's")
      ->check(CLI::Range(1, INT_MAX));
  command.add_option("--substeps", args.substeps, "Steps a frame instead of the scene's")
      ->check(CLI::Range(1, INT_MAX));
  command
      .add_option("--material", args.material,
                  "Named material of all cloths instead of the scene's: cotton, silk, ...")
      ->check(is_one_of(material_names()));
  command
      .add_option("--integrator", args.integrator, "Instead of the scene's, with default options")
      ->check(is_one_of(Integrators::names()));
  command.add_option("--collider", args.collider, "Instead of the scene's")
      ->check(is_one_of(Colliders::names()));
  command.add_option("--export", args.exports, "What to write, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"obj", "pc2", "mdd", "glb", "ply", "vtp", "exr", "usda"}))
      ->capture_default_str();
  command
      .add_option("--on", args.on,
                  "Whose vertices are written: the image's samples, the input mesh's own, or what "
                  "suits the format")
      ->check(CLI::IsMember({"auto", "image", "input"}))
      ->capture_default_str();
  command.add_flag("--unwelded", args.unwelded, "Keep every sample apart instead of joining mates");
  command
      .add_option("--unit", args.unit,
                  "What the numbers of meshes and caches mean, read and written, instead of what "
                  "the scene says")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}));
  command.add_option("--up", args.up, "Which of their axes points up")
      ->check(CLI::IsMember({"y", "z"}));
  command
      .add_option("--checkpoint", args.checkpoint,
                  "Frames between two checkpoints; 0: none; by default one every 5 s")
      ->check(CLI::Range(0, INT_MAX));
  command.add_flag("--resume", args.resume,
                   "Go on with the run in the folder, or begin it where there is none");
  command.add_flag(
      "--verify", args.verify,
      "Count intersections in every frame and look at every step; exit 4 when anything passed");
}

MeshFrame frame_of(const RunArgs& args, const MeshFrame& otherwise) {
  MeshFrame frame = otherwise;
  if (const auto unit = find_length_unit(args.unit)) frame.unit = *unit;
  if (!args.up.empty()) frame.z_up = args.up == "z";
  return frame;
}

void apply_run_args(const RunArgs& args, Scene& scene) {
  if (args.frames > 0) scene.frames = args.frames;
  if (args.substeps > 0) scene.substeps = args.substeps;
  if (const auto material = find_material(args.material))
    for (SceneCloth& cloth : scene.cloths) cloth.material = *material;
  if (const auto found = Integrators::find(args.integrator)) scene.integrator = *found;
  scene.files = frame_of(args, scene.files);
  if (const auto collider = Colliders::find(args.collider)) scene.collider = *collider;
}

void run_and_report(Scene scene, const std::string& name, const RunArgs& args,
                    const Context& context) {
  apply_run_args(args, scene);
  tell_memory(scene, name, context);
  RunReport report;
  std::set<std::string> told;
  {
    TerminalProgress progress(context.quiet || context.json);
    report = run_scene(scene, name, options_of(args, context, progress, told));
  }
  print_summary(context, report, told);
  auto json = nlohmann::ordered_json::parse(to_json(report));
  const std::optional<double> memory = peak_memory_mb();
  json["peak_memory_mb"] = memory ? nlohmann::ordered_json(*memory) : nlohmann::ordered_json();
  print_report(context, json);
  const auto& [frame, counts] = report.intersections;
  const int untangled = report.untangled_frame.value_or(0);
  if (args.verify && counts.total() > 0)
    throw Error(
        ExitCode::check_failed, name,
        fmt::format("{} intersections in frame {}: {} pairs of triangles within a cloth, {} "
                    "of two cloths, {} with bodies, {} triangles below the ground",
                    counts.total(), frame, counts.self, counts.cloths, counts.bodies,
                    counts.ground),
        untangled > 0
            ? fmt::format("none is wanted; what crossed at the start is apart since frame {}",
                          untangled)
            : "none is wanted");
  if (args.verify) check_whole_cloths(report, name);
  if (args.verify) check_garments(report, name);
  if (report.verification) check_verification(*report.verification, name);
}

}  // namespace weft::app
