// A sheet cut into charts that are sewn together again, beside the uncut sheet: how far its centre
// of mass is from the other's, what it costs, and how fast cycles of the solver converge.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <list>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/command_line.h"
#include "tests/cloth/cut_sheet.h"
#include "tests/cloth/newton_system.h"
#include "weft/simulation.h"

namespace weft::bench {
namespace {

using testing::CutSheet;

struct Options {
  int size = 129, frames = 60, threads = 1;
};

/// One way to lay the sheet out, and its image.
struct Layout {
  std::string name;
  std::vector<Chart> parts;
  double nudge = 0;  ///< of one sample at the start [m]
};

std::vector<Layout> layouts(int n) {
  return {{"uncut", {}},
          {"uncut, one sample moved by 1e-6 m", {}, 1e-6},
          {"2 x 2 charts", testing::quarters(n)},
          {"5 charts", testing::pinwheel(n)}};
}

GeometryImage image_of(const Layout& layout, int n) {
  GeometryImage image;
  image.world.lower = {-0.5, 0, -0.5};
  image.mates = BorderMates(n, {});
  image.cube = testing::flat_sheet(n);
  if (!layout.parts.empty()) {
    const CutSheet sheet(n, layout.parts);
    image.mates = sheet.mates;
    image.cube = sheet.rest;
  }
  for (int s = 0; s < image.size() * image.size(); ++s)
    image.cube.set(s, image.cube.at(s) + Vec3f{0.5F, 0, 0.5F});
  const int middle = (image.size() / 3) * image.size() + image.size() / 3;
  const Vec3f there = image.cube.at(middle);
  // In its plane: a sheet that is not flat at rest takes another way to bend.
  image.cube.set(middle, {there.x + static_cast<float>(layout.nudge), there.y, there.z});
  return image;
}

/// The sheet held at two corners, or let fall onto a ball.
Scene scene_of(const GeometryImage& image, bool hanging) {
  Scene scene;
  scene.ground.reset();
  SceneCloth sheet;
  sheet.surface = Surface(image, "sheet");
  if (hanging) {
    sheet.pins = {NearestPin{{-0.5, 0, -0.5}}, NearestPin{{0.5, 0, -0.5}}};
  } else {
    SceneBody ball;
    ball.name = "ball";
    ball.surface = Surface("builtin:sphere");
    ball.placement.scale = {0.4, 0.4, 0.4};
    ball.placement.translate = {0, -0.25, 0};
    scene.bodies = {ball};
  }
  scene.cloths = {sheet};
  return scene;
}

struct Run {
  Layout layout;
  Simulation simulation;
  std::vector<double> ms{};
  std::vector<Vec3d> centres{};
  double strain = 0;
  int iterations = 0;

  Run(Layout wanted, const Scene& scene, int threads)
      : layout(std::move(wanted)), simulation(scene, layout.name, threads) {}
  void advance() {
    const FrameReport report = simulation.advance();
    ms.push_back(report.milliseconds);
    centres.push_back(report.centre_of_mass);
    strain = std::max(strain, report.strain.p99);
    iterations += report.iterations;
  }
  [[nodiscard]] double median() const {
    std::vector<double> sorted = ms;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// The frames of all layouts in turn, so that other load falls on all alike.
void compare(const char* title, const Options& options, bool hanging) {
  std::list<Run> runs;
  for (const Layout& layout : layouts(options.size))
    runs.emplace_back(layout, scene_of(image_of(layout, options.size), hanging), options.threads);
  for (int frame = 0; frame < options.frames; ++frame)
    for (Run& run : runs) run.advance();
  for (const Run& run : runs) {
    double worst = 0, early = 0;
    for (std::size_t i = 0; i < run.centres.size(); ++i) {
      const double apart = length(run.centres[i] - runs.front().centres[i]);
      worst = std::max(worst, apart);
      if (i < run.centres.size() / 2) early = std::max(early, apart);
    }
    fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {} |\n", title,
               run.layout.name, run.simulation.cloths()[0].image.size(),
               run.median() / runs.front().median(), 1000 * early, 1000 * worst, 100 * run.strain,
               run.iterations);
  }
}

/// The mean factor by which a cycle of the solver makes the error smaller, in the energy norm.
double cycle_factor(const Cloth& cloth) {
  constexpr int cycles = 8;
  testing::System system(cloth);
  PaddedVectors error = system.random_field(5), product(cloth.size, cloth.size);
  std::vector<double> norms;
  for (int i = 0; i <= cycles; ++i) {
    system.times(error, product);
    norms.push_back(std::sqrt(system.dot(error, product)));
    system.blend(-1, system.cycle(product), 1, error);
  }
  return std::pow(norms.back() / norms[2], 1.0 / (cycles - 2));
}

void compare_cycles(int n) {
  for (const Layout& layout : layouts(n)) {
    if (layout.nudge != 0) continue;
    const GeometryImage image = image_of(layout, n);
    const Cloth cloth = make_cloth(world_positions(image), image.mates, Material{});
    testing::System system(cloth);
    fmt::print("| {} | {:.3f} | {} |\n", layout.name, cycle_factor(cloth),
               system.iterations_to_a_hundredth());
  }
}

void run(const Options& options) {
  fmt::print("{0} x {0} samples, {1} frames, threads {2}, default material and solver.\n\n",
             options.size, options.frames, options.threads);
  fmt::print(
      "| scene | sheet | image side | time, uncut = 1 | centre off, first half [mm] | centre "
      "off [mm] | worst p99 [%] | iterations |\n|---|---|---|---|---|---|---|---|\n");
  compare("held at two corners", options, true);
  compare("over a ball", options, false);
  fmt::print("\n| sheet | error after a cycle | iterations to a hundredth |\n|---|---|---|\n");
  compare_cycles(options.size);
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  weft::bench::Options options;
  weft::bench::CommandLine words{"A sheet in charts beside the uncut one"};
  words.add("--size", &options.size, "Samples a side of the uncut sheet");
  words.add("--frames", &options.frames);
  words.add("--threads", &options.threads);
  return words.run(argc, argv, [&] { weft::bench::run(options); });
}
