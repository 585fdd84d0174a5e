#include "weft/fabric.h"

#include <array>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/number_args.h"
#include "apps/weft/terminal_progress.h"
#include "weft/error.h"
#include "weft/scene_file.h"

namespace weft::app {
namespace {

using Json = nlohmann::ordered_json;

struct FabricArgs {
  double mass = 0;              ///< [g/m^2]
  std::string bending, length;  ///< one number or warp,weft: [uN m], [mm]
  double drape = 0;             ///< [%]
  DrapeTestOptions test;
  CLI::Option *mass_given = nullptr, *bending_given = nullptr, *length_given = nullptr,
              *drape_given = nullptr;
};

/// A fabric whose bending is known, and the drape test that gave it, if any.
struct Fabric {
  Material material;
  std::optional<DrapeResult> drape{};
};

std::optional<double> positive_number(std::string_view text) {
  const std::optional<double> number = finite_number(text);
  return number && *number > 0 ? number : std::nullopt;
}

/// One number, or two with a comma between.
WarpWeft read_pair(const std::string& option, std::string_view text) {
  const std::size_t comma = text.find(',');
  const auto warp = positive_number(text.substr(0, comma));
  const auto weft = comma == text.npos ? warp : positive_number(text.substr(comma + 1));
  if (!warp || !weft)
    throw UsageError("fabric", fmt::format("{} {}", option, text),
                     "a number > 0 is wanted, or two: WARP,WEFT");
  return {*warp, *weft};
}

void check_args(const FabricArgs& args) {
  if (args.mass_given->count() == 0)
    throw UsageError("fabric", "no --mass", "the mass of a square metre in grams is wanted");
  if (args.test.size % 2 == 0)
    throw UsageError("fabric", fmt::format("--size {}", args.test.size), "an odd size is wanted");
  std::string given;
  for (const CLI::Option* one : {args.bending_given, args.length_given, args.drape_given})
    if (one->count() > 0) given += (given.empty() ? "" : " and ") + one->get_name();
  const bool one = !given.empty() && given.find(' ') == given.npos;
  if (!one)
    throw UsageError("fabric", given.empty() ? "nothing measured of how it bends" : given,
                     "one of --bending, --length, --drape is wanted");
  if (args.drape_given->count() > 0 && args.drape >= 100)
    throw UsageError("fabric", fmt::format("--drape {:g}", args.drape),
                     "a percentage between 0 and 100 is wanted");
}

FittedBending fit(const FabricArgs& args, const Material& material, const Context& context) {
  const PromptStop nothing_half_written;
  TerminalProgress progress(context.quiet || context.json);
  DrapeTestOptions options = args.test;
  options.seed = context.seed;
  options.team = {context.threads, context.instructions};
  options.progress = &progress;
  return fit_bending(material, args.drape / 100, options);
}

Fabric make_fabric(const FabricArgs& args, const Context& context) {
  Fabric fabric;
  Material& material = fabric.material;
  material.density = args.mass / 1000;
  if (args.bending_given->count() > 0) {
    const WarpWeft micro = read_pair("--bending", args.bending);
    material.bending = {micro.warp * 1e-6, micro.weft * 1e-6};
  } else if (args.length_given->count() > 0) {
    const WarpWeft length = read_pair("--length", args.length);
    material.bending = {bending_of_length(material.density, length.warp / 1000),
                        bending_of_length(material.density, length.weft / 1000)};
  } else {
    FittedBending fitted = fit(args, material, context);
    material.bending = fitted.bending;
    fabric.drape = std::move(fitted.drape);
  }
  return fabric;
}

/// Rounds density and B to the digits that are known.
Material rounded(Material material) {
  const auto three_digits = [](double value) { return std::stod(fmt::format("{:.3g}", value)); };
  material.density = std::stod(fmt::format("{:.6g}", material.density));
  material.bending = {three_digits(material.bending.warp), three_digits(material.bending.weft)};
  return material;
}

Json lengths_json(const Material& material) {
  Json lengths = Json::array();
  for (const double bending : {material.bending.warp, material.bending.weft})
    lengths.push_back(1000 * length_of_bending(material.density, bending));
  return lengths;
}

Json drape_json(const DrapeResult& drape) {
  return {{"coefficient_percent", 100 * drape.coefficient},
          {"spread_percent", 100 * drape.spread},
          {"folds", drape.folds()},
          {"starts", drape.discs.size()},
          {"kinetic_energy", drape.kinetic_energy}};
}

void fabric(const FabricArgs& args, const Context& context) {
  check_args(args);
  constexpr double lightest = 3, heaviest = 5000;  // [g/m^2]
  if (args.mass < lightest || args.mass > heaviest)
    warn(context,
         fmt::format("--mass {:g}: fabrics weigh {:g} to {:g} g a square metre: is the unit "
                     "right?",
                     args.mass, lightest, heaviest));
  Fabric made = make_fabric(args, context);
  made.material = rounded(made.material);
  const Json material = Json::parse(material_text(made.material));
  const Json lengths = lengths_json(made.material);
  say(context, material.dump());
  if (!context.json)
    note(context, fmt::format("bending length {:.1f} mm along the warp, {:.1f} mm along the weft",
                              lengths[0].get<double>(), lengths[1].get<double>()));
  Json report{{"material", material}, {"bending_length_mm", lengths}};
  if (made.drape) {
    report["drape"] = drape_json(*made.drape);
    if (!context.json)
      note(context, fmt::format("drape {:.1f} % +- {:.1f} over {} starts, {:.1f} folds",
                                100 * made.drape->coefficient, 100 * made.drape->spread,
                                made.drape->discs.size(), made.drape->folds()));
  }
  print_report(context, report);
}

void add_measured(CLI::App& command, FabricArgs& args) {
  args.mass_given =
      command.add_option("--mass", args.mass, "Of a square metre [g]")->check(number_above_zero());
  args.bending_given =
      command.add_option("--bending", args.bending, "Bending rigidity [uN m]: B or WARP,WEFT");
  args.length_given = command.add_option("--length", args.length,
                                         "Bending length of ASTM D1388 [mm]: C or WARP,WEFT");
  args.drape_given = command
                         .add_option("--drape", args.drape,
                                     "Cusick's drape coefficient [%], of a 30 cm disc on an 18 cm "
                                     "support: B is found by draping")
                         ->check(number_above_zero());
}

void add_test(CLI::App& command, FabricArgs& args) {
  command.add_option("--size", args.test.size, "Samples a side of the disc that is draped, odd")
      ->check(CLI::Range(9, 1025))
      ->capture_default_str();
  command.add_option("--starts", args.test.starts, "Discs draped for each mean")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

}  // namespace

void add_fabric(CLI::App& program, const Context& context) {
  auto args = std::make_shared<FabricArgs>();
  CLI::App* command =
      program.add_subcommand("fabric", "Make a material from what was measured of a fabric");
  add_measured(*command, *args);
  add_test(*command, *args);
  command->footer(
      "Prints an object for \"material\" of a scene file.\n"
      "Example: weft fabric --mass 192 --drape 64.4");
  command->callback([args, &context] { fabric(*args, context); });
}

}  // namespace weft::app
