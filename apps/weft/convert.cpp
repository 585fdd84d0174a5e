#include "weft/convert.h"

#include <algorithm>
#include <chrono>
#include <climits>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/mesh_args.h"
#include "apps/weft/number_args.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/image_file.h"
#include "weft/image_quality.h"
#include "weft/shapes.h"

namespace weft::app {
namespace {
namespace fs = std::filesystem;

struct ConvertArgs {
  std::string mesh, output, parameterizer = "stretch", component, size = "257", charts = "auto";
  MeshArgs frame;
  int normal_map = 0, seed_triangle = -1, samples = 0, precision = 0;
  double error = 0;  ///< [mm]; 0: by precision
  bool keep_uv = false, fit = false, colours = false;
  std::string seam;
};

ComponentChoice component_of(const std::string& arg) {
  if (arg.empty()) return {};
  if (arg == "largest") return {ComponentChoice::Kind::largest, 0};
  int index = 0;
  if (!CLI::detail::lexical_cast(arg, index) || index < 0)
    throw UsageError("--component", fmt::format("'{}'", arg),
                     "a number from 0, largest or all is wanted");
  return {ComponentChoice::Kind::index, index};
}

int size_of(const std::string& arg) {
  if (arg == "auto") return automatic_size;
  int size = 0;
  if (!CLI::detail::lexical_cast(arg, size) || size < min_image_size || size > largest_image_size)
    throw UsageError("--size", fmt::format("'{}'", arg),
                     fmt::format("a number from {} to {}, or auto, is wanted", min_image_size,
                                 largest_image_size));
  return size;
}

/// The side of a square of so many samples that coarser levels fit into.
int side_of(int samples) {
  int side = min_image_size;
  while (side + 4 <= largest_image_size && (side + 4) * (side + 4) <= samples) side += 4;
  return side;
}

void choose_charts(const std::string& arg, ConvertOptions& options) {
  const std::map<std::string, ChartChoice> words{{"1", ChartChoice::one},
                                                 {"auto", ChartChoice::automatic},
                                                 {"pieces", ChartChoice::pieces},
                                                 {"uv", ChartChoice::texture}};
  const auto found = words.find(arg);
  options.charts = found != words.end() ? found->second : ChartChoice::regions;
  if (found != words.end()) return;
  if (!CLI::detail::lexical_cast(arg, options.max_charts) || options.max_charts < 1 ||
      options.max_charts > largest_chart_count)
    throw UsageError(
        "--charts", fmt::format("'{}'", arg),
        fmt::format("auto, pieces, uv or a number from 1 to {} is wanted", largest_chart_count));
}

SurfaceColours colours_of(const std::string& mesh) {
  if (is_builtin(mesh))
    throw UsageError("--colours", "of " + mesh, "a mesh file with colours is wanted");
  return read_colours(mesh);
}

ConvertOptions options_of(const ConvertArgs& args, const Context& context, Progress& progress) {
  ConvertOptions options;
  options.size = args.samples > 0 ? side_of(args.samples) : size_of(args.size);
  choose_charts(args.charts, options);
  if (args.parameterizer == "floater") options.parameterizer = FloaterOptions{};
  options.seed_triangle = args.seed_triangle;
  options.normal_map_size = args.normal_map;
  options.keep_uv = args.keep_uv;
  if (!args.seam.empty()) options.seam = read_seam(args.seam);
  options.fit_samples = args.fit;
  options.threads = context.threads;
  options.seed = context.seed;
  options.progress = &progress;
  return options;
}

fs::path beside(const fs::path& path, const std::string& suffix) {
  fs::path other = path;
  return other.replace_filename(path.stem().string() + suffix + path.extension().string());
}

/// How far samples of a compressed image lie from their places at most. [mm]
double error_of(const GeometryImage& image, int steps) {
  return 1000 * image.world.scale * std::numbers::sqrt3 / (2 * steps);
}

bool is_compressed(const fs::path& output) { return ending_of(output) == ".weft"; }

/// The steps along the unit cube that a compressed image is to have.
int steps_of(const ConvertArgs& args, const GeometryImage& image) {
  constexpr int default_bits = 12;
  if (args.error == 0) return (1 << (args.precision > 0 ? args.precision : default_bits)) - 1;
  const std::optional<int> steps = steps_for_error(image, args.error / 1000);
  if (!steps)
    throw UsageError("--error", fmt::format("{:.3g} mm", args.error),
                     fmt::format("for a side of {:.3g} m at least {:.2g} mm is wanted",
                                 image.world.scale, error_of(image, largest_step_count)));
  return *steps;
}

/// Refuses an error that no steps are fine enough for, before the mesh is converted: its image is
/// as large as what its triangles fill, with what is fitted a little off. A component alone may be
/// much smaller.
void check_error(const ConvertArgs& args, const TriangleMesh& mesh) {
  if (args.error == 0 || !args.component.empty()) return;
  Box3d box;
  for (const Triangle& triangle : mesh.triangles)
    for (const int vertex : triangle) box.add(mesh.positions[vertex]);
  GeometryImage image;
  image.world.scale = std::max({box.extent().x, box.extent().y, box.extent().z});
  // Of others the conversion tells what is wrong.
  if (image.world.scale > 0 && std::isfinite(image.world.scale)) steps_of(args, image);
}

/// Rounds the image to what a compressed file will hold, and measures that. @return the steps
int round_image(const ConvertArgs& args, const ConvertOptions& options, Conversion& made) {
  const int steps = steps_of(args, made.image);
  made.image = quantised(made.image, steps);
  const auto start = std::chrono::steady_clock::now();
  made.quality =
      measure_image(made.image, made.input.mesh, {options.threads, options.seed, options.progress});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  made.seconds.measure += took.count();
  made.seconds.total += took.count();
  return steps;
}

void print_summary(const Context& context, const Conversion& c) {
  const TopologyCounts& in = c.input.counts;
  for (const std::string& repair : c.input.repairs) note(context, repair);
  say(context, fmt::format("mesh    {} vertices, {} triangles, {}, {} borders", in.vertices,
                           in.triangles, genus_text(genus_json(in)), in.boundaries));
  say(context,
      fmt::format("map     {} flipped, {} degenerate, stretch {:.3f} (L2), {:.1f} (largest)",
                  c.map_quality.flipped, c.map_quality.degenerate, c.map_quality.stretch_l2,
                  c.map_quality.stretch_linf));
  const std::string charts =
      c.charts.size() == 1 ? "" : fmt::format(" in {} charts", c.charts.size());
  say(context, fmt::format("image   {0} x {0}{1}, PSNR {2:.1f} dB, Hausdorff {3:.2f} %",
                           c.image.size(), charts, c.quality.psnr_db, c.quality.hausdorff_percent));
  say(context, fmt::format("time    {:.2f} s, of which measuring {:.2f} s", c.seconds.total,
                           c.seconds.measure));
  if (const std::optional<double> memory = peak_memory_mb())
    say(context, fmt::format("memory  {:.0f} MB at most", *memory));
}

fs::path normals_file(const fs::path& image) {
  fs::path path = beside(image, "-normals");
  return is_compressed(image) ? path.replace_extension(".exr") : path;
}

fs::path colours_file(const fs::path& image) {
  return beside(image, "-colour").replace_extension(".png");
}

fs::path texture_file(const fs::path& image) {
  return beside(image, "-uv").replace_extension(".exr");
}

/// Refuses to write over what was read: the mesh, its pictures, a seam.
void check_outputs(const ConvertArgs& args, const ConvertOptions& options, const fs::path& image) {
  std::vector<fs::path> inputs{args.mesh, args.seam};
  if (options.colours)
    inputs.insert(inputs.end(), options.colours->files.begin(), options.colours->files.end());
  std::vector<fs::path> outputs{image};
  if (args.normal_map > 0) outputs.push_back(normals_file(image));
  if (args.colours) outputs.push_back(colours_file(image));
  if (args.keep_uv) outputs.push_back(texture_file(image));
  for (const fs::path& output : outputs) {
    check_not_input(output, inputs);
    const NewFile probe(output);
  }
}

Json convert_one(const ConvertArgs& args, const Context& context, const NamedMesh& named,
                 const ConvertOptions& options, const fs::path& output) {
  check_outputs(args, options, output);
  Conversion conversion = [&] {
    const PromptStop stop;  // nothing is written yet
    return convert_mesh(named.mesh, args.mesh, options);
  }();
  std::vector<fs::path> outputs{output};
  std::optional<double> error;  // of a compressed image [mm]
  if (is_compressed(output)) {
    const int steps = round_image(args, options, conversion);
    error = error_of(conversion.image, steps);
    write_compressed_image(output, conversion.image, steps);
  } else {
    write_image(output, conversion.image);
  }
  if (conversion.normals) {
    outputs.push_back(normals_file(output));
    write_normal_map(outputs.back(), *conversion.normals);
  }
  if (conversion.colour_map) {
    outputs.push_back(colours_file(output));
    write_colours(outputs.back(), *conversion.colour_map);
  }
  if (conversion.texture) {
    outputs.push_back(texture_file(output));
    write_texture(outputs.back(), *conversion.texture);
  }
  for (const std::string& warning : conversion.warnings) warn(context, warning);
  conversion.warnings.insert(conversion.warnings.begin(), named.warnings.begin(),
                             named.warnings.end());
  print_summary(context, conversion);
  if (error)
    say(context,
        fmt::format("file    {} bytes, samples within {:.2g} mm", fs::file_size(output), *error));
  for (const fs::path& path : outputs) say(context, "wrote   " + path.string());
  Json report = conversion_json(args.mesh, conversion, outputs);
  if (error) report["image"]["largest_error_mm"] = *error;
  report["image"]["bytes"] = fs::file_size(output);
  return report;
}

// Writes one image a component, numbered from 0, the largest first. A component that does not
// convert does not prevent the others.
Json convert_all(const ConvertArgs& args, const Context& context, const NamedMesh& named,
                 ConvertOptions options) {
  Json conversions = Json::array(), failed = Json::array();
  const int count = count_components(named.mesh, args.mesh);
  for (int k = 0; k < count; ++k) {
    options.component = {ComponentChoice::Kind::index, k};
    const fs::path output = beside(args.output, fmt::format("-{}", k));
    try {
      conversions.push_back(convert_one(args, context, named, options, output));
    } catch (const InputError& error) {
      failed.push_back({{"component", k}, {"error", error.what()}});
    } catch (const TopologyError& error) {
      failed.push_back({{"component", k}, {"error", error.what()}});
    }
  }
  return {{"conversions", conversions}, {"failed", failed}};
}

// Fails where a component did not convert; called after the report, which lists what was written.
void require_all(const ConvertArgs& args, const Context& context, const Json& report) {
  if (report["failed"].empty()) return;
  std::string numbers;
  for (const Json& failure : report["failed"]) {
    warn(context, fmt::format("component {}: {}", failure["component"].get<int>(),
                              failure["error"].get<std::string>()));
    numbers += fmt::format("{}{}", numbers.empty() ? "" : ", ", failure["component"].get<int>());
  }
  const std::size_t written = report["conversions"].size();
  throw TopologyError(
      args.mesh,
      fmt::format("{} of {} components did not convert: {}", report["failed"].size(),
                  report["failed"].size() + written, numbers),
      written > 0 ? "the others were written" : "none was written");
}

void check_args(const ConvertArgs& args) {
  check_output(args.output, {".exr", ".png", ".weft"});
  for (const auto& [option, given] :
       {std::pair{"--precision", args.precision > 0}, {"--error", args.error != 0}})
    if (given && !is_compressed(args.output))
      throw UsageError(option, "of " + args.output, "a compressed image, .weft, is wanted");
  check_outputs(args, {}, args.output);
  if (args.component != "all") return;
  for (const auto& [option, given] :
       {std::pair{"--cut", !args.seam.empty()}, {"--seed-triangle", args.seed_triangle >= 0}})
    if (given)
      throw UsageError(option, "together with --component all",
                       "the component that it lies on is wanted");
}

void convert(const ConvertArgs& args, const Context& context) {
  check_args(args);
  check_frame(args.frame, std::span(&args.mesh, 1));
  TerminalProgress progress(context.quiet || context.json);
  ConvertOptions options = options_of(args, context, progress);
  const auto start = std::chrono::steady_clock::now();
  const NamedMesh named = [&] {
    const PromptStop stop;
    if (args.colours)
      options.colours = std::make_shared<const SurfaceColours>(colours_of(args.mesh));
    return load_named_mesh(args.mesh, args.frame);
  }();
  const std::chrono::duration<double> load = std::chrono::steady_clock::now() - start;
  for (const std::string& warning : named.warnings) warn(context, warning);
  check_error(args, named.mesh);
  if (args.component == "all") {
    const Json report = convert_all(args, context, named, options);
    print_report(context, report);
    return require_all(args, context, report);
  }
  options.component = component_of(args.component);
  Json report = convert_one(args, context, named, options, args.output);
  report["seconds"]["load"] = report["seconds"]["load"].get<double>() + load.count();
  report["seconds"]["total"] = report["seconds"]["total"].get<double>() + load.count();
  print_report(context, report);
}

}  // namespace

void add_convert(CLI::App& program, const Context& context) {
  auto args = std::make_shared<ConvertArgs>();
  CLI::App* command = program.add_subcommand("convert", "Turn a mesh into a geometry image");
  command->add_option("MESH", args->mesh, "OBJ, OFF, PLY, STL or GLB file, or builtin:NAME")
      ->required();
  command
      ->add_option("-o,--output", args->output,
                   "IMAGE.exr (float32, exact), .png (16 bits) or .weft (compressed)")
      ->required();
  command
      ->add_option("--size", args->size,
                   "Samples a side, 2^k + 1 suits the solvers; auto: by the mesh")
      ->capture_default_str();
  command
      ->add_option("--samples", args->samples,
                   "Samples in all, instead of those of a side; of all charts together")
      ->check(CLI::Range(min_image_size * min_image_size, largest_image_size * largest_image_size))
      ->excludes("--size");
  command
      ->add_option("--charts", args->charts,
                   "1: refuse several pieces; pieces: a chart for each; auto: more where that is "
                   "poor; uv: for each island of the texture; N: N compact ones")
      ->capture_default_str();
  add_mesh_options(*command, args->frame);
  command->add_option("--parameterizer", args->parameterizer, "How the inside is mapped")
      ->check(CLI::IsMember({"floater", "stretch"}))
      ->capture_default_str();
  command
      ->add_option("--normal-map", args->normal_map,
                   "Write a normal map of this size beside the image")
      ->check(CLI::Range(min_image_size, largest_image_size));
  CLI::Option* precision =
      command
          ->add_option("--precision", args->precision,
                       "Bits of a coordinate in a compressed image; 12 when not given")
          ->check(CLI::Range(4, 16));
  command
      ->add_option("--error", args->error,
                   "Instead of bits: how far samples of a compressed image may move [mm]")
      ->check(number_above_zero())
      ->excludes(precision);
  command->add_option("--cut", args->seam,
                      "Cut along the vertex paths in this text file, one a line, counted from 0");
  command->add_flag("--fit", args->fit,
                    "Move the samples so that the surface between them is nearer to the mesh");
  command->add_flag("--keep-uv", args->keep_uv,
                    "Write the mesh's texture coordinates beside the image, as NAME-uv.exr");
  command->add_flag("--colours", args->colours,
                    "Keep vertex colours and pictures: in the image (EXR) and as NAME-colour.png");
  command->add_option(
      "--component", args->component,
      "Of several pieces one: a number (largest is 0), largest; all: an image each");
  command
      ->add_option("--seed-triangle", args->seed_triangle,
                   "Where the cut begins; chosen when not given")
      ->check(CLI::Range(0, INT_MAX));
  command->footer("Example: weft convert bunny.obj -o bunny.exr --size 257 --normal-map 512");
  command->callback([args, &context] { convert(*args, context); });
}

}  // namespace weft::app
