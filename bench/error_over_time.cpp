// How far every method is off a converged run, over what it costs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "bench/command_line.h"
#include "bench/hanging_sheet.h"
#include "weft/fabric.h"

namespace weft::bench {
namespace {

struct Args {
  int size = 65, threads = 1, repeats = 3;
  std::string fabric;  // a named one; empty: the sheet's own
};

/// The hanging sheet, of the fabric that was asked for.
Scene sheet_for(const Args& args) {
  Scene scene = hanging_sheet(args.size);
  if (!args.fabric.empty()) scene.cloths[0].material = find_material(args.fabric).value();
  return scene;
}

/// One setting of one method.
struct Trial {
  std::string series;
  int substeps = 1, iterations = 0;  // iterations: 0 where there is no such setting
  std::function<std::optional<HangingRun>()> run;
};

class Trials {
 public:
  explicit Trials(const Args& args) : words_(args) {}

  void add(const std::string& series, const IntegratorOptions& method, int substeps,
           int iterations = 0) {
    Scene scene = sheet_for(words_);
    scene.integrator = method;
    scene.substeps = substeps;
    list_.push_back({series, substeps, iterations,
                     [scene, threads = words_.threads] { return run_hanging(scene, threads); }});
  }
  void add_position_based(int substeps) {
    Scene scene = sheet_for(words_);
    scene.substeps = substeps;
    list_.push_back({"position based", substeps, 0,
                     [scene] { return std::optional(run_hanging_position_based(scene)); }});
  }
  [[nodiscard]] const std::vector<Trial>& list() const { return list_; }

 private:
  const Args& words_;
  std::vector<Trial> list_;
};

/// Explicit steps a frame: the largest stable step shrinks with the spacing, and with the speed of
/// sound in the threads.
int stable_substeps(const Args& args) {
  const auto sound = [](const Material& material) {
    return std::sqrt(std::max(material.stretch.warp, material.stretch.weft) / material.density);
  };
  const double faster = sound(sheet_for(args).cloths[0].material) /
                        sound(hanging_sheet(args.size).cloths[0].material);
  return static_cast<int>(std::lround(3 * args.size * faster));
}
int reference_substeps(const Args& args) { return 4 * stable_substeps(args); }

/// Beyond this the dense filter of desbrun takes minutes to make.
constexpr int largest_desbrun_size = 71;

Trials trials_for(const Args& args) {
  Trials trials(args);
  for (const int substeps : {1, 2, 4, 8, 16}) trials.add("newton", NewtonOptions{}, substeps);
  for (const int iterations : {1, 2, 3, 5, 10})
    for (const int substeps : {1, 2, 4, 8, 16})
      trials.add(fmt::format("multigrid {}", iterations),
                 MultigridOptions{.max_iterations = iterations, .tolerance = 0}, substeps,
                 iterations);
  for (const int substeps : {1, 2, 4, 8, 16}) trials.add("implicit", ImplicitOptions{}, substeps);
  for (const int substeps : {stable_substeps(args), 2 * stable_substeps(args)})
    trials.add("explicit", ExplicitOptions{}, substeps);
  for (const int substeps : {1, 2, 4, 8}) trials.add("two level", TwoLevelOptions{}, substeps);
  if (args.size <= largest_desbrun_size)
    for (const int substeps : {1, 2, 4, 8}) trials.add("desbrun", DesbrunOptions{}, substeps);
  for (const int substeps : {10, 20, 50, 100, 200, 400}) trials.add_position_based(substeps);
  return trials;
}

/// The run, with the median time of several.
std::optional<HangingRun> median_of(int repeats, const Trial& trial) {
  constexpr double long_enough = 100;  // [ms] a frame
  std::optional<HangingRun> run = trial.run();
  if (!run) return run;
  std::vector<double> times{run->milliseconds};
  for (int i = 1; i < repeats && times[0] < long_enough; ++i)
    times.push_back(trial.run()->milliseconds);
  std::sort(times.begin(), times.end());
  run->milliseconds = times[times.size() / 2];
  return run;
}

HangingRun converged(const Args& args, int substeps) {
  Scene scene = sheet_for(args);
  scene.integrator = ExplicitOptions{};
  scene.limiter_passes = 0;
  scene.substeps = substeps;
  return run_hanging(scene, args.threads).value();
}

void print_row(const Trial& trial, const std::optional<HangingRun>& run, double error) {
  const std::string iterations = trial.iterations > 0 ? fmt::format("{}", trial.iterations) : "";
  const std::string method =
      trial.series.substr(0, trial.series.find_last_not_of("0123456789 ") + 1);
  if (!run) {
    fmt::print("| {} | {} | {} | unstable | | | | |\n", method, trial.substeps, iterations);
    return;
  }
  fmt::print("| {} | {} | {} | {:.2f} | {:.1f} | {:.3f} | {:.2f} | {:.1f} |\n", method,
             trial.substeps, iterations, run->milliseconds, 1000 * error, run->fall,
             100 * run->strain.p99, 100 * run->strain.max);
}

void measure(const Args& args) {
  const int steps = reference_substeps(args);
  const HangingRun reference = converged(args, steps);
  const double own = distance_between(converged(args, steps / 2), reference);
  fmt::print(
      "{5}{0} x {0} samples, {1} thread(s). The converged run takes {2} explicit steps a frame; "
      "with "
      "half as many "
      "it is {3:.1f} mm off itself, and it falls {4:.3f} m.\n\n",
      args.size, args.threads, steps, 1000 * own, reference.fall,
      args.fabric.empty() ? "" : args.fabric + ", ");
  fmt::print(
      "| method | substeps | iterations | ms a frame | off by, mm | fall, m | strain p99 % | "
      "largest % |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  const Trials trials = trials_for(args);
  for (const Trial& trial : trials.list()) {
    const std::optional<HangingRun> run = median_of(args.repeats, trial);
    const double error = run ? distance_between(*run, reference) : 0;
    print_row(trial, run, error);
    (void)std::fflush(stdout);
  }
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  weft::bench::Args args;
  weft::bench::CommandLine words{"Error of every method against a converged run, over its time."};
  words.add("--size", &args.size, "Samples a side");
  words.add("--fabric", &args.fabric, "A named one, instead of the sheet's own");
  words.add("--threads", &args.threads);
  words.add("--repeats", &args.repeats, "Runs whose median time counts");
  return words.run(argc, argv, [&] { weft::bench::measure(args); });
}
