#include "bench/solver_tables.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <string>

#include <fmt/format.h>

namespace weft::bench {
namespace {

Outcome worst_of(const std::vector<Outcome>& outcomes) {
  Outcome worst;
  for (const Outcome& o : outcomes) {
    for (double Outcome::*part :
         {&Outcome::centre, &Outcome::rms, &Outcome::gained, &Outcome::iterations,
          &Outcome::milliseconds, &Outcome::strain, &Outcome::tight_strain, &Outcome::spread})
      if (!(o.*part <= worst.*part)) worst.*part = o.*part;
    worst.unsolved += o.unsolved;
  }
  return worst;
}

std::string measured(const Outcome& o) {
  return fmt::format("{:.2f} | {:.1f} | {:.1e} | {:.2f} | {:.2f} | {:.2f} | {}", 1e3 * o.centre,
                     1e3 * o.rms, o.gained, o.iterations, o.milliseconds, 1e3 * o.spread,
                     o.unsolved);
}

std::string fabric_of(const Trial& trial) {
  const Material& m = trial.material;
  return fmt::format(
      "{0} x {0} | {1} | {10} | {2:.2g} | {3:.2g}, {4:.2g} | {5:.2g} | {6:.1g}, {7:.1g} | "
      "{8:.2g} | {9:.2g}",
      trial.size, trial.substeps, m.density, m.stretch.warp, m.stretch.weft, m.shear,
      m.bending.warp, m.bending.weft, m.damping, 100 * m.strain_limit, trial.compared_frames);
}

/// Largest strain above the tight solve's.
double excess(const Outcome& o) { return o.strain - o.tight_strain; }

std::string measured_strain(const Outcome& o) {
  return fmt::format("{:.1e} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {}", o.gained,
                     100 * o.strain, 100 * o.tight_strain, 1e3 * o.centre, 1e3 * o.rms,
                     1e3 * o.spread, o.unsolved);
}

/// The trials that are among the five worst by energy, strain, centre or particles.
std::set<std::size_t> worst_trials(const std::vector<Outcome>& outcomes) {
  std::vector<std::size_t> order(outcomes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::set<std::size_t> worst;
  const auto add_worst = [&](auto of) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return of(outcomes[a]) > of(outcomes[b]);
    });
    worst.insert(order.begin(), order.begin() + std::min<std::ptrdiff_t>(5, std::ssize(order)));
  };
  add_worst([](const Outcome& o) { return o.gained; });
  add_worst(excess);
  add_worst([](const Outcome& o) { return o.centre; });
  add_worst([](const Outcome& o) { return o.rms; });
  return worst;
}

/// Of one part over all trials.
std::string median_and_worst(const std::vector<Outcome>& outcomes, double scale,
                             const std::function<double(const Outcome&)>& part) {
  std::vector<double> values;
  values.reserve(outcomes.size());
  for (const Outcome& o : outcomes) values.push_back(scale * part(o));
  std::sort(values.begin(), values.end());
  return fmt::format("{:.2g} | {:.2g}", values[values.size() / 2], values.back());
}

void print_summary(const std::vector<Outcome>& outcomes) {
  fmt::print("{} materials, seeds by which they can be drawn again below.\n\n", outcomes.size());
  fmt::print("| | median | worst |\n|---|---|---|\n");
  const auto row = [&](const char* name, double scale, auto part) {
    fmt::print("| {} | {} |\n", name, median_and_worst(outcomes, scale, part));
  };
  row("energy gained, m g L", 1, [](const Outcome& o) { return o.gained; });
  row("largest strain above the tight solve's, points", 100, excess);
  row("centre off, mm", 1e3, [](const Outcome& o) { return o.centre; });
  row("particles off, rms mm", 1e3, [](const Outcome& o) { return o.rms; });
  row("centre of the tight solve from 1 um beside off, mm", 1e3,
      [](const Outcome& o) { return o.spread; });
  fmt::print("\n");
}

}  // namespace

void print_fabrics(const std::vector<Trial>& trials, const std::vector<Outcome>& outcomes) {
  fmt::print(
      "| samples | stretch N/m | shear N/m | kg/m^2 | centre, worst mm | particles, rms mm "
      "| energy gained, m g L | iterations a step | ms a frame "
      "| centre of the tight solve from 1 um beside, mm | tight steps unsolved |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Material& m = trials[i].material;
    fmt::print("| {0} x {0} | {1:g} | {2:g} | {3:g} | {4} |\n", trials[i].size, m.stretch.warp,
               m.shear, m.density, measured(outcomes[i]));
  }
  fmt::print("| worst | | | | {} |\n", measured(worst_of(outcomes)));
}

void print_materials(const std::vector<Trial>& trials, const std::vector<Outcome>& outcomes,
                     std::uint64_t seed) {
  print_summary(outcomes);
  fmt::print(
      "| seed | samples | substeps | compared frames | kg/m^2 | stretch N/m | shear N/m | bending "
      "N m | damping "
      "1/s | limit % | energy gained, m g L | largest strain % | of the tight solve % | "
      "centre, worst mm | particles, rms mm | centre of the tight solve from 1 um beside, mm | "
      "tight "
      "steps unsolved |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t i : worst_trials(outcomes))
    fmt::print("| {} | {} | {} |\n", seed + i, fabric_of(trials[i]), measured_strain(outcomes[i]));
}

}  // namespace weft::bench
