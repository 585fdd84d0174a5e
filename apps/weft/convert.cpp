#include "weft/image/convert.h"

#include <chrono>
#include <climits>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/peak_memory.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/core/error.h"
#include "weft/image/io/image_file.h"

namespace weft::app {
namespace {
namespace fs = std::filesystem;

struct ConvertWords {
  std::string mesh, output, parameterizer = "stretch", component;
  int size = 257, normal_map = 0, seed_triangle = -1;
  bool keep_uv = false;
};

ComponentChoice component_of(const std::string& word) {
  if (word.empty()) return {};
  if (word == "largest") return {ComponentChoice::Kind::largest, 0};
  int index = 0;
  if (!CLI::detail::lexical_cast(word, index) || index < 0)
    throw UsageError("--component", fmt::format("'{}'", word),
                     "a number from 0, largest or all is wanted");
  return {ComponentChoice::Kind::index, index};
}

ConvertOptions options_of(const ConvertWords& words, const Context& context, Progress& progress) {
  ConvertOptions options;
  options.size = words.size;
  if (words.parameterizer == "floater") options.parameterizer = FloaterOptions{};
  options.seed_triangle = words.seed_triangle;
  options.normal_map_size = words.normal_map;
  options.keep_uv = words.keep_uv;
  options.threads = context.threads;
  options.seed = context.seed;
  options.progress = &progress;
  return options;
}

fs::path beside(const fs::path& path, const std::string& suffix) {
  fs::path other = path;
  return other.replace_filename(path.stem().string() + suffix + path.extension().string());
}

void print_summary(const Context& context, const Conversion& c) {
  const TopologyCounts& in = c.input.counts;
  for (const std::string& repair : c.input.repairs) note(context, repair);
  say(context, fmt::format("mesh    {} vertices, {} triangles, genus {}, {} borders", in.vertices,
                           in.triangles, in.genus, in.boundaries));
  say(context,
      fmt::format("map     {} flipped, {} degenerate, stretch {:.3f} (L2), {:.1f} (largest)",
                  c.mapped.quality.flipped, c.mapped.quality.degenerate,
                  c.mapped.quality.stretch_l2, c.mapped.quality.stretch_linf));
  say(context, fmt::format("image   {0} x {0}, PSNR {1:.1f} dB, Hausdorff {2:.2f} %",
                           c.image.size(), c.quality.psnr_db, c.quality.hausdorff_percent));
  say(context, fmt::format("time    {:.2f} s, of which measuring {:.2f} s", c.seconds.total,
                           c.seconds.measure));
  if (const std::optional<double> memory = peak_memory_mb())
    say(context, fmt::format("memory  {:.0f} MB at most", *memory));
}

Json convert_one(const ConvertWords& words, const Context& context, const TriangleMesh& mesh,
                 const ConvertOptions& options, const fs::path& output) {
  const Conversion conversion = [&] {
    const PromptStop stop;  // nothing is written yet
    return convert_mesh(mesh, words.mesh, options);
  }();
  std::vector<fs::path> outputs{output};
  write_image(output, conversion.image);
  if (conversion.normals) {
    outputs.push_back(beside(output, "-normals"));
    write_normal_map(outputs.back(), *conversion.normals);
  }
  if (conversion.texture) {
    outputs.push_back(beside(output, "-uv").replace_extension(".exr"));
    write_texture(outputs.back(), *conversion.texture);
  }
  print_summary(context, conversion);
  for (const fs::path& path : outputs) say(context, "wrote   " + path.string());
  return conversion_json(words.mesh, conversion, outputs);
}

// One image a component, the largest first, numbered from 0; ends at the first number that is too
// large.
Json convert_all(const ConvertWords& words, const Context& context, const TriangleMesh& mesh,
                 ConvertOptions options) {
  Json conversions = Json::array();
  const int count =
      repair_mesh(mesh, {words.mesh, {ComponentChoice::Kind::largest, 0}}).components_found;
  for (int k = 0; k < count; ++k) {
    options.component = {ComponentChoice::Kind::index, k};
    const fs::path output = beside(words.output, fmt::format("-{}", k));
    conversions.push_back(convert_one(words, context, mesh, options, output));
  }
  return {{"conversions", conversions}};
}

void convert(const ConvertWords& words, const Context& context) {
  check_output(words.output, {".exr", ".png"});
  TerminalProgress progress(context.quiet || context.json);
  ConvertOptions options = options_of(words, context, progress);
  const auto start = std::chrono::steady_clock::now();
  const TriangleMesh mesh = [&] {
    const PromptStop stop;
    return load_mesh(words.mesh);
  }();
  const std::chrono::duration<double> load = std::chrono::steady_clock::now() - start;
  if (words.component == "all") {
    print_report(context, convert_all(words, context, mesh, options));
    return;
  }
  options.component = component_of(words.component);
  Json report = convert_one(words, context, mesh, options, words.output);
  report["seconds"]["load"] = report["seconds"]["load"].get<double>() + load.count();
  report["seconds"]["total"] = report["seconds"]["total"].get<double>() + load.count();
  print_report(context, report);
}

}  // namespace

void add_convert(CLI::App& program, const Context& context) {
  auto words = std::make_shared<ConvertWords>();
  CLI::App* command = program.add_subcommand("convert", "Turn a mesh into a geometry image");
  command->add_option("MESH", words->mesh, "OBJ, OFF, PLY, STL or GLB file, or builtin:NAME")
      ->required();
  command
      ->add_option("-o,--output", words->output,
                   "IMAGE.exr (float32, exact) or IMAGE.png (16 bits)")
      ->required();
  command->add_option("--size", words->size, "Samples a side; 2^k + 1 suits the solvers")
      ->check(CLI::Range(least_image_size, largest_image_size))
      ->capture_default_str();
  command->add_option("--parameterizer", words->parameterizer, "How the inside is mapped")
      ->check(CLI::IsMember({"floater", "stretch"}))
      ->capture_default_str();
  command
      ->add_option("--normal-map", words->normal_map,
                   "Write a normal map of this size beside the image")
      ->check(CLI::Range(least_image_size, largest_image_size));
  command->add_flag("--keep-uv", words->keep_uv,
                    "Write the mesh's texture coordinates beside the image, as NAME-uv.exr");
  command->add_option("--component", words->component,
                      "Of several: a number (largest is 0), largest, or all");
  command
      ->add_option("--seed-triangle", words->seed_triangle,
                   "Where the cut begins; chosen when not given")
      ->check(CLI::Range(0, INT_MAX));
  command->footer("Example: weft convert bunny.obj -o bunny.exr --size 257 --normal-map 512");
  command->callback([words, &context] { convert(*words, context); });
}

}  // namespace weft::app
