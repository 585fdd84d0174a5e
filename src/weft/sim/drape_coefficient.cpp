#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "weft/cloth/integrator.h"
#include "weft/cloth/measure.h"
#include "weft/core/math.h"
#include "weft/core/random.h"
#include "weft/core/thread_team.h"
#include "weft/error.h"
#include "weft/fabric.h"
#include "weft/image/builtin.h"
#include "weft/sim/shadow.h"

namespace weft {
namespace {

constexpr double disc_radius = 0.15, support_radius = 0.09;  // [m]
/// Angular wave numbers of the initial velocities of a disc, and their largest size [m/s].
constexpr std::array waves{2, 3, 4, 5, 6, 7, 8};
constexpr double push_speed = 0.05;
/// A disc is at rest when its kinetic energy is below this part of m g times its diameter.
constexpr double still_energy = 1e-9;
/// Time between two tests for rest [s].
constexpr double time_between_checks = 0.25;
/// Time over which gravity rises to its full value [s].
constexpr double seconds_of_lowering = 1;
/// Damping rate of velocities [1/s]. It affects how soon a disc comes to rest, not where.
constexpr double air_drag = 4;
/// Smallest coarse grid on which a finer disc is first let down, in samples a side.
constexpr int min_start_size = 33;
/// Range of bending lengths that a fit searches; cloth has 1 to 5 cm [m].
constexpr double softest_length = 0.005, stiffest_length = 0.1;
/// A fit ends once the drape coefficient is within `near` of the target, or the bracket of B is
/// narrower than the relative width `bending_tolerance`.
constexpr double near = 0.003, bending_tolerance = 0.01;

double radius_of(Vec3d p) { return std::sqrt(p.x * p.x + p.z * p.z); }

/// Radii of a disc's rings of samples, evenly spaced on the support and on the overhang. Bending
/// begins half a ring outside the last pinned one, which is the support's edge, whatever the number
/// of samples.
struct Rings {
  int pinned = 0;               ///< index of the last pinned ring
  double inner = 0, outer = 0;  ///< spacing on the support, on the overhang [m]

  explicit Rings(int n) {
    const int all = (n - 1) / 2;
    const double overhang = disc_radius - support_radius, even = disc_radius / all;
    const int free = std::max(1, static_cast<int>(overhang / even));
    pinned = all - free;
    outer = overhang / (free + 0.5);
    inner = (disc_radius - free * outer) / pinned;
  }
  [[nodiscard]] double radius(int ring) const {
    return ring <= pinned ? ring * inner : pinned * inner + (ring - pinned) * outer;
  }
};

int ring_of(int n, int row, int col) {
  const int middle = (n - 1) / 2;
  return std::max(std::abs(row - middle), std::abs(col - middle));
}

Planes3 flat_disc(int n) {
  if (n < 9 || n % 2 == 0)
    throw SceneError("drape test", fmt::format("a size of {}", n),
                     "an odd one of at least 9 is wanted");
  const Rings rings(n);
  Planes3 rest = world_positions(make_image_shape("disk", n));
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const int ring = ring_of(n, r, c);
      // The built-in disc has diameter 1.
      const double scale = ring > 0 ? rings.radius(ring) * (n - 1) / ring : 0;
      rest.set(r, c, static_cast<float>(scale) * rest.at(r, c));
    }
  return rest;
}

Cloth pinned_disc(const Material& material, int n) {
  const Planes3 rest = flat_disc(n);
  Cloth cloth = make_cloth(rest, BorderMates(n, {}), material);
  const int pinned = Rings(n).pinned;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      if (ring_of(n, r, c) <= pinned) pin(cloth, r * n + c, vec_cast<double>(rest.at(r, c)));
  return cloth;
}

/// Initial state of a disc: flat, with vertical velocities from a few random angular waves whose
/// amplitude grows towards the edge.
ClothState pushed_disc(const Cloth& cloth, Random& random) {
  std::array<double, waves.size()> strength{}, phase{};
  for (std::size_t i = 0; i < waves.size(); ++i) {
    strength[i] = random.uniform(-1, 1) * push_speed / waves.size();
    phase[i] = random.uniform(0, 2 * pi);
  }
  ClothState state = rest_state(cloth);
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const Vec3d p = vec_cast<double>(cloth.rest.at(s));
    if (cloth.inverse_mass(s / cloth.size, s % cloth.size) == 0) continue;
    const double angle = arc_tangent(p.z, p.x), out = radius_of(p) / disc_radius;
    double speed = 0;
    for (std::size_t i = 0; i < waves.size(); ++i)
      speed += strength[i] * sine(waves[i] * angle + phase[i]);
    state.velocity.set(s, {0, static_cast<float>(out * speed), 0});
  }
  return state;
}

/// Initial state of a disc, interpolated from the rest state of one with half as many rings.
ClothState refined(const Cloth& cloth, const Cloth& coarse_cloth, const ClothState& coarse) {
  ClothState state = rest_state(cloth);
  const auto moved = [&](int r, int c) {
    return coarse.position.at(r, c) - coarse_cloth.rest.at(r, c);
  };
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      if (cloth.inverse_mass(r, c) == 0) continue;
      const int up = r / 2, down = (r + 1) / 2, left = c / 2, right = (c + 1) / 2;
      state.position.set(r, c,
                         cloth.rest.at(r, c) + 0.25F * (moved(up, left) + moved(up, right) +
                                                        moved(down, left) + moved(down, right)));
    }
  return state;
}

/// Scales gravity by the elapsed part of the time over which it rises. A disc is let down, not
/// dropped: dropped discs fall into more folds than those of real tests.
StepInput lowered(StepInput input, double seconds, double whole_seconds) {
  if (seconds < whole_seconds)
    input.gravity = static_cast<float>(seconds / whole_seconds) * input.gravity;
  return input;
}

void slow_down(float factor, ClothState& state) {
  for (Grid<float>* plane : {&state.velocity.x, &state.velocity.y, &state.velocity.z})
    for (int r = 0; r < plane->rows(); ++r)
      for (int c = 0; c < plane->cols(); ++c) (*plane)(r, c) *= factor;
}

/// Steps a disc with air drag until it is at rest and stays so without drag until the next test,
/// for at most `options.seconds`.
void fall(const Cloth& cloth, const DrapeTestOptions& options, double lowering_seconds,
          Progress& progress, ClothState& state) {
  ThreadTeam team(options.team);
  const StepInput input{options.time_step, {0, -static_cast<float>(standard_gravity), 0}};
  const auto integrator = make_integrator(options.integrator, cloth, input, team);
  const int steps = static_cast<int>(options.seconds / options.time_step + 0.5);
  const int interval = std::max(1, static_cast<int>(time_between_checks / options.time_step));
  const auto kept = static_cast<float>(1 - air_drag * options.time_step);
  const double disc_mass = pi * disc_radius * disc_radius * cloth.material.density;
  const double still = still_energy * disc_mass * standard_gravity * 2 * disc_radius;
  bool rested = false;
  for (int i = 1; i <= steps; ++i) {
    const double seconds = i * options.time_step;
    integrator->begin(lowered(input, seconds, lowering_seconds), state);
    integrator->iterate({});
    integrator->end(state);
    if (!rested) slow_down(kept, state);
    if (i % interval != 0) continue;
    progress.update("", static_cast<double>(i) / steps);
    const bool rests = seconds > lowering_seconds && kinetic_energy(cloth, state) < still;
    if (rests && rested) return;
    rested = rests;
  }
}

/// Finds the rest state of a disc from coarse to fine: lets it down on a grid of about 33 samples a
/// side, where that is cheap, and continues on grids of twice the resolution. Folds take long to
/// slide and merge on any grid.
void find_rest_state(const Material& material, const Cloth& cloth, const DrapeTestOptions& options,
                     Random& random, Progress& progress, ClothState& state) {
  const int coarse_size = (cloth.size + 1) / 2;
  if (coarse_size < min_start_size || coarse_size % 2 == 0) {
    state = pushed_disc(cloth, random);
    fall(cloth, options, seconds_of_lowering, progress, state);
    return;
  }
  const Cloth coarse_cloth = pinned_disc(material, coarse_size);
  PartOfProgress first(&progress, "", 0, 0.5), second(&progress, "", 0.5, 1);
  ClothState coarse;
  find_rest_state(material, coarse_cloth, options, random, first, coarse);
  state = refined(cloth, coarse_cloth, coarse);
  fall(cloth, options, 0, second, state);
}

/// Number of folds of a closed line: how often its values rise by a fifth of their range.
int count_folds(const std::vector<double>& line) {
  const auto [min, max] = std::minmax_element(line.begin(), line.end());
  const double rise = 0.2 * (*max - *min);
  if (*max - *min < 0.02 * disc_radius) return 0;
  const auto start = static_cast<std::size_t>(min - line.begin());
  int folds = 0;
  double lowest = *min, highest = *min;
  bool rising = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const double value = line[(start + i) % line.size()];
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
    if (!rising && value > lowest + rise) {
      rising = true;
      highest = value;
      ++folds;
    } else if (rising && value < highest - rise) {
      rising = false;
      lowest = value;
    }
  }
  return folds;
}

/// Distances of the disc's border samples from its axis, once around [m].
std::vector<double> outline(const Planes3& position) {
  const int n = position.size();
  std::vector<double> radii;
  for (int p = 0; p < 4 * (n - 1); ++p)
    radii.push_back(radius_of(vec_cast<double>(position.at(border_sample(n, p)))));
  return radii;
}

DrapedDisc measure_disc(const Cloth& cloth, const ClothState& state) {
  const double support = pi * support_radius * support_radius;
  const double whole = pi * disc_radius * disc_radius;
  const double shadow = shadow_area(state.position);
  return {(shadow - support) / (whole - support), count_folds(outline(state.position)),
          kinetic_energy(cloth, state)};
}

void summarise(DrapeResult& result) {
  const auto count = static_cast<double>(result.discs.size());
  for (const DrapedDisc& disc : result.discs) {
    result.coefficient += disc.coefficient / count;
    result.kinetic_energy = std::max(result.kinetic_energy, disc.kinetic_energy);
  }
  double squares = 0;
  for (const DrapedDisc& disc : result.discs) {
    const double off = disc.coefficient - result.coefficient;
    squares += off * off;
  }
  result.spread = count > 1 ? std::sqrt(squares / (count - 1)) : 0;
}

/// The bending stiffnesses between which a fit searches.
struct Bracket {
  double soft = 0, stiff = 0;  ///< B [N m]
};

class Fit {
 public:
  Fit(Material material, double wanted, const DrapeTestOptions& options)
      : material_(material), wanted_(wanted), options_(options) {}

  FittedBending run() {
    Bracket bracket{bending_of_length(material_.density, softest_length),
                    bending_of_length(material_.density, stiffest_length)};
    check_reach(bracket);
    FittedBending last = drape(std::sqrt(bracket.soft * bracket.stiff)), best = last;
    while (bracket.stiff > (1 + bending_tolerance) * bracket.soft && miss(best) > near) {
      (last.drape.coefficient < wanted_ ? bracket.soft : bracket.stiff) = last.bending;
      last = drape(std::sqrt(bracket.soft * bracket.stiff));
      // The coefficient may jump past the target where the number of folds changes.
      if (miss(last) < miss(best)) best = last;
    }
    return best;
  }

 private:
  FittedBending drape(double bending) {
    material_.bending = bending;
    // About as many trials as bisection of the bracket takes.
    constexpr double max_trials = 12;
    DrapeTestOptions options = options_;
    PartOfProgress part(options_.progress, "draping discs", std::min(1.0, trials_ / max_trials),
                        std::min(1.0, (trials_ + 1) / max_trials));
    options.progress = &part;
    ++trials_;
    return {bending, measure_drape(material_, options)};
  }

  void check_reach(const Bracket& bracket) {
    const double min = drape(bracket.soft).drape.coefficient;
    const double max = drape(bracket.stiff).drape.coefficient;
    if (wanted_ > min && wanted_ < max) return;
    throw InputError("drape",
                     fmt::format("{:.1f} %, which no bending stiffness of cloth gives at "
                                 "{:g} kg/m^2",
                                 100 * wanted_, material_.density),
                     fmt::format("one of {:.1f} to {:.1f} % is wanted", 100 * min, 100 * max));
  }

  [[nodiscard]] double miss(const FittedBending& fit) const {
    return std::abs(fit.drape.coefficient - wanted_);
  }

  Material material_;
  double wanted_;
  const DrapeTestOptions& options_;
  int trials_ = 0;
};

}  // namespace

double DrapeResult::folds() const {
  double sum = 0;
  for (const DrapedDisc& disc : discs) sum += disc.folds;
  return discs.empty() ? 0 : sum / static_cast<double>(discs.size());
}

DrapeResult measure_drape(const Material& material, const DrapeTestOptions& options) {
  const Cloth cloth = pinned_disc(material, options.size);
  Random random(options.seed);
  DrapeResult result;
  for (int i = 0; i < options.starts; ++i) {
    PartOfProgress part(options.progress, "draping discs", double(i) / options.starts,
                        double(i + 1) / options.starts);
    ClothState state;
    find_rest_state(material, cloth, options, random, part, state);
    result.discs.push_back(measure_disc(cloth, state));
  }
  summarise(result);
  return result;
}

FittedBending fit_bending(Material material, double coefficient, const DrapeTestOptions& options) {
  return Fit(material, coefficient, options).run();
}

double bending_of_length(double density, double length) {
  return density * standard_gravity * length * length * length;
}

double length_of_bending(double density, double bending) {
  return std::cbrt(bending / (density * standard_gravity));
}

}  // namespace weft
