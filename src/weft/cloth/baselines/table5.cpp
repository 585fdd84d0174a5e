#include "weft/table5.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "weft/cloth/baselines/paper_filters.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/integrator.h"
#include "weft/core/math.h"
#include "weft/core/stopwatch.h"

namespace weft {
namespace {

constexpr std::array<Figure5Row, 19> printed{{
    {11, 6, 5, 0.026, 0.008, 0.00333784, 1.591, 0.00414493},
    {21, 6, 9, 0.026, 0.379, 0.0146533, 366.508, 0.0483582},
    {21, 11, 5, 1.591, 0.008, 0.0154459, 366.508, 0.0483582},
    {31, 7, 11, 0.071, 1.588, 0.0367027, 12609.9, 0.182559},
    {31, 11, 7, 1.602, 0.069, 0.0355135, 12609.9, 0.182559},
    {31, 16, 5, 33.58, 0.008, 0.0405753, 12609.9, 0.182559},
    {41, 9, 11, 0.379, 1.576, 0.0676944, {}, 0.24063},
    {41, 11, 9, 1.601, 0.383, 0.0661781, {}, 0.24063},
    {41, 21, 5, 364.699, 0.009, 0.0994028, {}, 0.24063},
    {51, 11, 11, 1.593, 1.578, 0.111589, {}, 0.58068},
    {51, 26, 5, 2166.05, 0.008, 0.191877, {}, 0.58068},
    {61, 16, 9, 54.266, 0.631, 0.172863, {}, 1.0242},
    {61, 21, 7, 366.654, 0.07, 0.221257, {}, 1.0242},
    {61, 31, 5, 12609.9, 0.009, 0.345918, {}, 1.0242},
    {71, 15, 11, 18.518, 1.611, 0.251877, {}, 1.93297},
    {71, 36, 5, {}, 0.01, 0.578284, {}, 1.93297},
    {81, 17, 11, 56.439, 1.59, 0.3575, {}, 50.5037},
    {81, 21, 9, 367.489, 0.384, 0.409644, {}, 50.5037},
    {81, 41, 5, {}, 0.01, 0.932329, {}, 50.5037},
}};

constexpr double frame_step = 1.0 / 60;
constexpr double density = 0.2;  // [kg/m^2]
/// h^2 k / m.
constexpr double filter_ratio = 0.1;
constexpr double wavelength = 0.5, height = 0.01, sway = 0.002;  // of the start [m]
constexpr int limiter_passes = 10;
constexpr double strain_limit = 0.05;
const StepInput step_input{frame_step, {0, -9.81F, 0}};

double seconds_of(const auto& work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

/// The sheet in the xz plane, and how it starts.
struct Sheet {
  Cloth cloth;
  ClothState start;
  double stiffness = 0;  ///< of every spring [N/m]
  /// As `stiffness`, for the mean particle, which border particles make lighter.
  double filter_stiffness = 0;
};

Planes3 flat_positions(int n) {
  Planes3 rest(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      rest.set(r, c, vec_cast<float>(Vec3d{c / (n - 1.0) - 0.5, 0, r / (n - 1.0) - 0.5}));
  return rest;
}

/// Waves out of the plane, and along and across both axes within it.
Planes3 waved(const Planes3& rest) {
  Planes3 start = rest;
  const double turn = 2 * pi / wavelength;
  for (int s = 0; s < rest.size() * rest.size(); ++s) {
    const Vec3d p = vec_cast<double>(rest.at(s));
    const double u = turn * p.x, v = turn * p.z;
    const Vec3d moved = p + Vec3d{sway * (sine(u) + sine(v)), height * sine(u) * sine(v),
                                  sway * (cosine(v) - sine(u))};
    start.set(s, vec_cast<float>(moved));
  }
  return start;
}

Sheet make_sheet(int n) {
  const double particle = density / ((n - 1.0) * (n - 1.0));
  Sheet sheet;
  sheet.stiffness = filter_ratio * particle / (frame_step * frame_step);
  sheet.filter_stiffness = sheet.stiffness * (density / (n * n)) / particle;
  Material material;
  material.density = density;
  material.stretch = sheet.stiffness;
  material.shear = 2 * sheet.stiffness;
  material.bending = 0;  // the paper's springs alone
  material.bend_springs = sheet.stiffness;
  material.damping = 0;
  material.strain_limit = strain_limit;
  sheet.cloth = make_cloth(flat_positions(n), BorderMates(n, {}), material);
  sheet.start = rest_state(sheet.cloth);
  sheet.start.position = waved(sheet.cloth.rest);
  return sheet;
}

/// A method, the time of its step and the state that it leads to.
struct Runner {
  const Sheet* sheet = nullptr;
  std::unique_ptr<Integrator> integrator;
  std::unique_ptr<StrainLimit> limit;
  double step_seconds = HUGE_VAL;
  ClothState state{};

  void run(int frames, ThreadTeam& team) {
    state = sheet->start;
    const double seconds = seconds_of([&] {
      for (int frame = 0; frame < frames; ++frame) {
        integrator->begin(step_input, state);
        limit->limit({.passes = limiter_passes}, frame_step, integrator->iterate({}), team);
        integrator->end(state);
      }
    });
    step_seconds = std::min(step_seconds, seconds / frames);
  }
};

Runner make_runner(const Sheet& sheet, const IntegratorOptions& options, ThreadTeam& team) {
  return {&sheet, make_integrator(options, sheet.cloth, step_input, team),
          std::make_unique<StrainLimit>(sheet.cloth, team)};
}

double rms_distance(const ClothState& a, const ClothState& b) {
  const int count = a.position.size() * a.position.size();
  double sum = 0;
  for (int s = 0; s < count; ++s)
    sum += squared_length(vec_cast<double>(a.position.at(s)) - vec_cast<double>(b.position.at(s)));
  return std::sqrt(sum / count);
}

/// The common part of all rows of one size.
struct Size {
  Size(int n, const Table5Options& given, ThreadTeam& with)
      : options(given), team(with), sheet(make_sheet(n)) {
    dense_seconds = seconds_of([&] { desbrun = make_runner(sheet, DesbrunOptions{}, team); });
    multigrid = make_runner(sheet, MultigridOptions{}, team);
    if (!options.errors) return;
    Runner exact =
        make_runner(sheet, ImplicitOptions{.max_iterations = 1000, .tolerance = 1e-7}, team);
    exact.run(options.frames, team);
    converged = std::move(exact.state);
  }
  Size(const Size&) = delete;
  Size& operator=(const Size&) = delete;
  ~Size() = default;

  Table5Row measure(const Figure5Row& row, int index);

  const Table5Options& options;
  ThreadTeam& team;
  Sheet sheet;
  Runner desbrun, multigrid;
  double dense_seconds = 0;
  std::optional<ClothState> converged;
};

Table5Row Size::measure(const Figure5Row& row, int index) {
  const auto tell = [&](double round) {
    update(options.progress, fmt::format("table5 {0} x {0}", row.n),
           (index + round / options.rounds) / static_cast<double>(options.rows.size()));
  };
  Table5Row result{row, sheet.cloth.particles, sheet.stiffness};
  const double k = sheet.filter_stiffness;
  result.local_matrix =
      seconds_of([&] { const LocalFilter made(row.n, row.local_size, filter_ratio, team); });
  result.global_matrix = seconds_of([&] {
    const GlobalFilter made(sheet.cloth, {row.global_size, k, frame_step, true}, team);
  });
  Runner two_level = make_runner(
      sheet,
      TwoLevelOptions{
          .local_size = row.local_size, .global_size = row.global_size, .filter_stiffness = k},
      team);
  const bool first = desbrun.step_seconds == HUGE_VAL;
  for (int round = 0; round < options.rounds; ++round)
    for (Runner* runner : {&two_level, &multigrid, &desbrun}) {
      tell(round);
      if (runner != &desbrun || first) runner->run(options.frames, team);
    }
  result.dense_matrix = dense_seconds;
  result.two_level = two_level.step_seconds;
  result.desbrun = desbrun.step_seconds;
  result.multigrid = multigrid.step_seconds;
  if (!converged) return result;
  result.two_level_error = rms_distance(two_level.state, *converged);
  result.desbrun_error = rms_distance(desbrun.state, *converged);
  result.multigrid_error = rms_distance(multigrid.state, *converged);
  return result;
}

}  // namespace

std::span<const Figure5Row> figure5() { return printed; }

std::vector<Table5Row> measure_table5(const Table5Options& options) {
  ThreadTeam team(options.team);
  std::vector<Table5Row> rows;
  std::unique_ptr<Size> size;
  for (const Figure5Row& row : options.rows) {
    if (!size || size->sheet.cloth.size != row.n)
      size = std::make_unique<Size>(row.n, options, team);
    rows.push_back(size->measure(row, static_cast<int>(rows.size())));
  }
  return rows;
}

double measure_multigrid(int n, const Table5Options& options) {
  ThreadTeam team(options.team);
  const Sheet sheet = make_sheet(n);
  Runner multigrid = make_runner(sheet, MultigridOptions{}, team);
  for (int round = 0; round < options.rounds; ++round) multigrid.run(options.frames, team);
  return multigrid.step_seconds;
}

}  // namespace weft
