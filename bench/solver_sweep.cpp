// The default integrator against steps solved to the end in double: a sheet that hangs by two
// corners, over fabrics from soft and heavy to stiff and light, or over materials by chance.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "bench/command_line.h"
#include "bench/solver_log.h"
#include "bench/solver_tables.h"
#include "bench/tight_solver.h"
#include "weft/core/random.h"
#include "weft/error.h"

namespace weft::bench {
namespace {

constexpr double frame_rate = 60, gravity = 9.81, side = 1;

struct Args {
  std::vector<int> sizes{65};
  std::string integrator = "newton", done;
  int random = 0, jobs = 1, iterations = 0;
  std::uint64_t seed = 1;
  double stop = 0, tolerance = 1e-7;
  bool fast = false;
};

template <class Options>
IntegratorOptions with(const Args& args) {
  Options options;
  if (args.iterations > 0) {
    options.max_iterations = args.iterations;
    options.tolerance = 0;
  }
  if (args.stop > 0) options.tolerance = args.stop;
  return options;
}

IntegratorOptions method(const Args& args) {
  const std::string& name = args.integrator;
  if (name == "newton") return with<NewtonOptions>(args);
  if (name == "multigrid") return with<MultigridOptions>(args);
  if (name == "implicit") return with<ImplicitOptions>(args);
  throw SceneError("--integrator", name, "newton, multigrid or implicit");
}

/// How far apart the two starts of the tight solve are: as far as floats round at 1 m, many times.
constexpr double start_distance = 1e-6;  // [m]

/// In the xz plane, rows along z, held at both ends of its first row.
Cloth hung_sheet(const Trial& trial) {
  const int n = trial.size;
  Planes3 rest(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      rest.set(r, c,
               {static_cast<float>(c) / static_cast<float>(n - 1) - 0.5F, 0,
                static_cast<float>(r) / static_cast<float>(n - 1) - 0.5F});
  Cloth cloth = make_cloth(rest, {n, {}}, trial.material);
  for (const int s : {0, n - 1}) pin(cloth, s, vec_cast<double>(cloth.rest.at(s)));
  return cloth;
}

/// Of this thread, which alone works on a trial [s].
double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The largest rise of a number beyond its least value so far.
class Rise {
 public:
  void add(double value) {
    min_ = std::min(min_, value);
    // Not a number counts as endless.
    if (!(value - min_ <= max_)) max_ = std::isfinite(value) ? value - min_ : HUGE_VAL;
  }
  [[nodiscard]] double max() const { return max_; }

 private:
  double min_ = HUGE_VAL, max_ = 0;
};

/// A sheet moved by an integrator and, beside it, by tight solves.
class Comparison {
 public:
  Comparison(const Trial& trial, const Args& args)
      : trial_(trial),
        cloth_(hung_sheet(trial)),
        integrator_(make_integrator(method(args), cloth_, input(), team_)),
        tight_(cloth_, {.tolerance = args.tolerance}),
        state_(rest_state(cloth_)),
        tight_state_(tight_state(state_)),
        other_state_(moved(tight_state_)) {
    energy_.add(total_energy());
  }

  Outcome run() {
    for (int frame = 0; frame < trial_.frames; ++frame) {
      const bool compared = frame < trial_.compared_frames;
      for (int i = 0; i < trial_.substeps; ++i) step(compared);
      if (compared) compare();
    }
    const double scale = energy().total_mass() * gravity * side;
    outcome_.gained = energy_.max() / scale;
    outcome_.rms = std::sqrt(outcome_.rms / trial_.compared_frames);
    outcome_.iterations /= trial_.frames * trial_.substeps;
    outcome_.milliseconds /= trial_.frames;
    return outcome_;
  }

 private:
  [[nodiscard]] StepInput input() const {
    return {.time_step = 1 / (frame_rate * trial_.substeps)};
  }
  [[nodiscard]] const TightEnergy& energy() const { return tight_.energy(); }

  /// Every free particle a little elsewhere, by chance.
  [[nodiscard]] TightState moved(TightState state) const {
    Random random(1);
    const auto any = [&] { return random.uniform(-start_distance, start_distance); };
    for (std::size_t s = 0; s < state.position.size(); ++s) {
      const Vec3d by{any(), any(), any()};
      if (tight_.energy().moves(static_cast<int>(s))) state.position[s] += by;
    }
    return state;
  }

  void step(bool compared) {
    const double start = cpu_seconds();
    integrator_->begin(input(), state_);
    integrator_->iterate({});
    outcome_.iterations += integrator_->end(state_).iterations;
    outcome_.milliseconds += 1e3 * (cpu_seconds() - start);
    energy_.add(total_energy());
    if (!compared) return;
    if (!tight_.step(input(), tight_state_)) ++outcome_.unsolved;
    (void)tight_.step(input(), other_state_);
    raise(outcome_.strain, energy().largest_strain(tight_state(state_).position));
    raise(outcome_.tight_strain, energy().largest_strain(tight_state_.position));
  }

  static void raise(double& max, double value) {
    if (!(value <= max)) max = value;
  }

  void compare() {
    const TightState now = tight_state(state_);
    Vec3d off;
    double squares = 0;
    for (std::size_t s = 0; s < now.position.size(); ++s) {
      const Vec3d apart = now.position[s] - tight_state_.position[s];
      off += energy().mass(static_cast<int>(s)) / energy().total_mass() * apart;
      squares += squared_length(apart);
    }
    raise(outcome_.centre, length(off));
    raise(outcome_.spread, length(centre(other_state_) - centre(tight_state_)));
    outcome_.rms += squares / static_cast<double>(now.position.size());
  }

  [[nodiscard]] Vec3d centre(const TightState& state) const {
    Vec3d sum;
    for (std::size_t s = 0; s < state.position.size(); ++s)
      sum += energy().mass(static_cast<int>(s)) / energy().total_mass() * state.position[s];
    return sum;
  }

  /// In double, of the state that the integrator left [J].
  [[nodiscard]] double total_energy() const {
    const TightState now = tight_state(state_);
    double sum = energy().elastic(now.position);
    for (std::size_t s = 0; s < now.position.size(); ++s)
      sum += energy().mass(static_cast<int>(s)) *
             (0.5 * squared_length(now.velocity[s]) + gravity * now.position[s].y);
    return sum;
  }

  const Trial& trial_;
  Cloth cloth_;
  ThreadTeam team_{1};
  std::unique_ptr<Integrator> integrator_;
  TightSolver tight_;
  ClothState state_;
  TightState tight_state_, other_state_;
  Rise energy_;
  Outcome outcome_;
};

std::vector<Trial> fabrics(const Args& args) {
  std::vector<Trial> trials;
  for (const int size : args.sizes)
    for (const double stretch : {2e3, 2e4, 1e5})
      for (const double shear : {20., 200., 2000.})
        for (const double density : {0.02, 0.2, 1.}) {
          // The softest, the hardest, and one that cloth is made of.
          const bool few = (stretch == 2e3 && shear == 20 && density == 1) ||
                           (stretch == 1e5 && shear == 20 && density == 0.02) ||
                           (stretch == 2e4 && shear == 200 && density == 0.2);
          if (args.fast && !few) continue;
          Trial trial;
          trial.size = size;
          trial.material = {.density = density,
                            .stretch = stretch,
                            .shear = shear,
                            .bending = 1e-5,
                            .damping = 0};
          trials.push_back(trial);
        }
  return trials;
}

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

/// Compared for 120 steps, or as many as cost the time of those of 65 x 65 samples.
Trial random_trial(std::uint64_t seed) {
  Random random(seed);
  const auto two = [&](double low, double high) {
    const double warp = log_uniform(random, low, high);
    return WarpWeft(warp, log_uniform(random, low, high));
  };
  Trial trial;
  Material& m = trial.material;
  m.density = log_uniform(random, 0.02, 1);
  m.stretch = two(2e3, 1e5);
  m.shear = log_uniform(random, 10, 2000);
  m.bending = two(1e-6, 1e-4);
  m.damping = random.uniform() < 0.5 ? 0 : log_uniform(random, 0.5, 5);
  m.strain_limit = random.uniform() < 0.1 ? random.uniform(0.01, 0.05) : 0;
  trial.size = static_cast<int>(std::lround(log_uniform(random, 33, 257)));
  trial.substeps = static_cast<int>(std::lround(log_uniform(random, 1, 16)));
  trial.frames = 120;
  const double ratio = 65.0 / trial.size;
  const int steps = static_cast<int>(120 * std::min(1.0, ratio * ratio));
  trial.compared_frames = std::clamp(steps / trial.substeps, 1, trial.frames);
  return trial;
}

std::vector<Trial> random_trials(const Args& args) {
  std::vector<Trial> trials;
  trials.reserve(static_cast<std::size_t>(args.random));
  for (int i = 0; i < args.random; ++i)
    trials.push_back(random_trial(args.seed + static_cast<std::uint64_t>(i)));
  return trials;
}

/// On so many threads, each trial on one.
std::vector<Outcome> run_all(const std::vector<Trial>& trials, const Args& args) {
  SolverLog log(args.done, fmt::format("{} iterations {} stop {} tolerance {}", args.integrator,
                                       args.iterations, args.stop, args.tolerance));
  std::vector<Outcome> outcomes(trials.size());
  std::atomic<std::size_t> next{0}, done{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < trials.size(); i = next++) {
      const double start = cpu_seconds();
      Outcome& o = outcomes[i];
      if (!log.find(trials[i], o)) log.add(trials[i], o = Comparison(trials[i], args).run());
      fmt::print(stderr,
                 "{}/{}: trial {}, n {}: centre {:.2f} mm, spread {:.2f} mm, rms {:.1f} mm, energy "
                 "{:.1e}, {} steps "
                 "unsolved, {:.0f} s\n",
                 ++done, trials.size(), i, trials[i].size, 1e3 * o.centre, 1e3 * o.spread,
                 1e3 * o.rms, o.gained, o.unsolved, cpu_seconds() - start);
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < args.jobs; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  return outcomes;
}

void measure(const Args& args) {
  (void)method(args);
  const DerivativeErrors errors = check_derivatives();
  fmt::print(stderr, "derivatives against differences: gradient {:.1e}, product {:.1e}\n",
             errors.gradient, errors.product);
  if (!(errors.gradient < 1e-6 && errors.product < 1e-5))
    throw std::runtime_error("the tight solve's derivatives are wrong");
  const bool by_chance = args.random > 0;
  const std::vector<Trial> trials = by_chance ? random_trials(args) : fabrics(args);
  const std::vector<Outcome> outcomes = run_all(trials, args);
  if (by_chance)
    print_materials(trials, outcomes, args.seed);
  else
    print_fabrics(trials, outcomes);
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  weft::bench::Args args;
  weft::bench::CommandLine words{
      "A hanging sheet by an integrator, against steps solved to the end in double."};
  words.add("--sizes", &args.sizes, "Samples a side");
  words.add("--integrator", &args.integrator, "newton, multigrid or implicit");
  words.add("--random", &args.random, "So many materials by chance instead of fabrics");
  words.add("--seed", &args.seed, "Of the first of them");
  words.add("--iterations", &args.iterations, "So many, instead of the defaults");
  words.add("--stop", &args.stop, "The integrator's tolerance, instead of the default");
  words.add("--tolerance", &args.tolerance, "Of the tight solve's last move [m]");
  words.add("--jobs", &args.jobs, "Trials at a time");
  words.add("--done", &args.done, "A file of finished trials: read if it is there, and added to");
  words.add("--fast", &args.fast, "Three fabrics");
  return words.run(argc, argv, [&] { weft::bench::measure(args); });
}
