#include "bench/hanging_sheet.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/position_based.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/measure.h"
#include "weft/error.h"

namespace weft::bench {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

Scene hanging_sheet(int size) {
  Scene scene;
  scene.frames = hanging_frames;
  scene.ground.reset();
  SceneCloth sheet;
  sheet.size = size;
  sheet.material.density = 0.2;
  sheet.material.stretch = sheet.material.shear = 2000;
  sheet.material.bending = 0;
  sheet.material.bend_springs = 0.5;
  sheet.material.strain_limit = 0.05;
  sheet.pins = {{ImagePin{{0, 0}}}, {ImagePin{{1, 0}}}};
  scene.cloths = {sheet};
  return scene;
}

std::optional<HangingRun> run_hanging(const Scene& scene, int threads) try {
  Simulation simulation(scene, "hanging sheet", threads);
  HangingRun run;
  std::vector<double> milliseconds;
  const double height = simulation.centre_of_mass().y;
  for (int frame = 0; frame < scene.frames; ++frame) {
    const FrameReport report = simulation.advance();
    milliseconds.push_back(report.milliseconds);
    run.positions.push_back(simulation.cloths()[0].state.position);
    run.strain = report.strain;
    run.fall = height - report.centre_of_mass.y;
  }
  run.milliseconds = median(milliseconds);
  return run;
} catch (const SceneError&) {
  return std::nullopt;
}

HangingRun run_hanging_position_based(const Scene& scene) {
  const Simulation simulation(scene, "hanging sheet", 1);  // for its cloth alone
  const Cloth& cloth = *simulation.cloths()[0].model;
  ClothState state = simulation.cloths()[0].state;
  PositionBased method(cloth, 1 / (scene.frame_rate * scene.substeps));
  HangingRun run;
  std::vector<double> milliseconds;
  const double height = centre_of_mass(cloth, state).y;
  for (int frame = 0; frame < scene.frames; ++frame) {
    const auto start = std::chrono::steady_clock::now();
    for (int substep = 0; substep < scene.substeps; ++substep)
      method.step(vec_cast<float>(scene.gravity), state);
    const std::chrono::duration<double, std::milli> passed =
        std::chrono::steady_clock::now() - start;
    milliseconds.push_back(passed.count());
    run.positions.push_back(state.position);
  }
  run.milliseconds = median(milliseconds);
  run.strain = measure_strain(cloth, state);
  run.fall = height - centre_of_mass(cloth, state).y;
  return run;
}

double distance_between(const HangingRun& a, const HangingRun& b) {
  double sum = 0;
  int count = 0;
  for (std::size_t frame = 0; frame < a.positions.size(); ++frame) {
    const int samples = a.positions[frame].size() * a.positions[frame].size();
    for (int s = 0; s < samples; ++s)
      sum += squared_length(vec_cast<double>(a.positions[frame].at(s)) -
                            vec_cast<double>(b.positions[frame].at(s)));
    count += samples;
  }
  return std::sqrt(sum / count);
}

}  // namespace weft::bench
