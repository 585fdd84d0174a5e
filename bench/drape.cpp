// Cusick's drape test of one fabric: what bench/drape.py makes its table of.
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "bench/command_line.h"
#include "weft/error.h"
#include "weft/fabric.h"

namespace weft::bench {
namespace {

struct Args {
  std::string name, integrator;
  double mass = 0, bending = 0, fit = 0;  ///< [g/m^2], [uN m], [%]
  DrapeTestOptions test;
};

Material material_of(const Args& args) {
  if (!args.name.empty()) {
    const auto named = find_material(args.name);
    if (!named) throw UsageError("--material", args.name, "the name of a material is wanted");
    return *named;
  }
  Material material;
  material.density = args.mass / 1000;
  material.bending = args.bending * 1e-6;
  return material;
}

std::string discs_of(const DrapeResult& result) {
  std::string text;
  for (const DrapedDisc& disc : result.discs)
    text += fmt::format(R"({}{{"coefficient":{},"folds":{},"kinetic_energy":{}}})",
                        text.empty() ? "" : ",", disc.coefficient, disc.folds, disc.kinetic_energy);
  return text;
}

void measure(const Args& args) {
  DrapeTestOptions options = args.test;
  if (args.integrator == "implicit") {
    options.integrator = ImplicitOptions{};
  } else if (args.integrator == "tight") {
    options.integrator = NewtonOptions{.max_iterations = 100, .tolerance = 1e-3};
  } else if (!args.integrator.empty()) {
    throw UsageError("--integrator", args.integrator, "tight or implicit is wanted");
  }
  Material material = material_of(args);
  const auto start = std::chrono::steady_clock::now();
  DrapeResult result;
  if (args.fit > 0) {
    FittedBending fitted = fit_bending(material, args.fit / 100, options);
    material.bending = fitted.bending;
    result = std::move(fitted.drape);
  } else {
    result = measure_drape(material, options);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  fmt::print(R"({{"density":{},"bending":[{},{}],"coefficient":{},"spread":{},"folds":{},)"
             R"("kinetic_energy":{},"discs":[{}],"seconds":{}}})"
             "\n",
             material.density, material.bending.warp, material.bending.weft, result.coefficient,
             result.spread, result.folds(), result.kinetic_energy, discs_of(result),
             seconds.count());
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  weft::bench::Args args;
  weft::bench::CommandLine words{
      "Drapes discs of a fabric over Cusick's support and prints one JSON object."};
  words.add("--material", &args.name, "A name of docs/materials.md; else:");
  words.add("--mass", &args.mass, "Of a square metre [g]");
  words.add("--bending", &args.bending, "B [uN m]");
  words.add("--fit", &args.fit, "Find B of this drape coefficient [%]");
  words.add("--size", &args.test.size, "Samples a side");
  words.add("--starts", &args.test.starts, "Discs");
  words.add("--seconds", &args.test.seconds, "Of a run, at most");
  words.add(
      "--integrator", &args.integrator,
      "The library's default; the same with a hundredth of its tolerance (tight); or implicit");
  return words.run(argc, argv, [&] { weft::bench::measure(args); });
}
