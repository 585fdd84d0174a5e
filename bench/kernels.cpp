// What the inner loops of stepping cost a particle, and how much of the memory's bandwidth they
// use, beside a triad over as many bytes as each of them works on.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/command_line.h"
#include "bench/hanging_sheet.h"
#include "weft/cloth/baselines/coarse_limit.h"
#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"
#include "weft/cloth/baselines/multigrid/preconditioner_level.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/spring_rows.h"

namespace weft::bench {
namespace {

constexpr double step_seconds = 1.0 / 240;
/// A sheet that hangs has something to limit.
constexpr int frames_before = 5;

/// Seconds of the fastest of many calls; what prepares each is not counted.
double min_seconds(const std::function<void()>& prepare, const std::function<void()>& call) {
  using Clock = std::chrono::steady_clock;
  constexpr double at_least = 0.15;
  constexpr int calls_at_least = 5;
  double best = HUGE_VAL, total = 0;
  for (int i = 0; i < calls_at_least || total < at_least; ++i) {
    prepare();
    const auto start = Clock::now();
    call();
    const std::chrono::duration<double> passed = Clock::now() - start;
    best = std::min(best, passed.count());
    total += passed.count();
  }
  return best;
}

/// Bytes a second of a = b + s c over three arrays that take so many bytes together.
double triad_bandwidth(double bytes, ThreadTeam& team) {
  const int count = std::max(64, static_cast<int>(bytes / 3 / sizeof(float)));
  const auto size = static_cast<std::size_t>(count);
  std::vector<float> a(size, 1), b(size, 2), c(size, 3);
  // Small arrays are gone through often, so that starting the team does not count.
  const int rounds = 1 + (1 << 22) / count;
  const auto rounds_of_triad = [&] {
    team.run([&](Worker& worker) {
      const Range mine = worker.share(count);
      for (int round = 0; round < rounds; ++round) {
        const auto factor = static_cast<float>(round);
        float* to = a.data();
#pragma omp simd
        for (int i = mine.first; i < mine.last; ++i) to[i] = b[i] + factor * c[i];
        asm volatile("" : : "r"(to) : "memory");  // every round is written
      }
    });
  };
  const double seconds = min_seconds([] {}, rounds_of_triad);
  return rounds * 3.0 * sizeof(float) * count / seconds;
}

/// A loop over all particles.
struct Kernel {
  std::string name;
  /// That cannot be spared: in each pass every plane that it needs is read once and every plane
  /// that it makes is written once; coarser levels are a third on top.
  double bytes_a_particle;
  std::function<void()> call;
};

/// A hanging sheet with all that its kernels work on.
class Sheet {
 public:
  Sheet(int size, int threads)
      : simulation_(moved(size, threads)),
        cloth_(*simulation_->cloths()[0].model),
        state_(simulation_->cloths()[0].state),
        before_(state_),
        proposal_(state_),
        force_(size),
        row_energy_(static_cast<std::size_t>(size)),
        team_(threads),
        springs_(cloth_, team_),
        level_(std::move(make_filter_levels(cloth_, step_seconds).front())),
        filter_(cloth_, {.time_step = step_seconds}, team_),
        limit_(cloth_, team_),
        coarse_limit_(cloth_, team_),
        integrator_(make_integrator(MultigridOptions{.max_iterations = 1}, cloth_,
                                    {step_seconds, {}}, team_)) {
    step();
    proposal_ = state_;
    gather_forces();
    filter_.rhs() = force_;
    level_.rhs = force_;
  }

  /// What each reads and writes, four bytes a plane: position and start, rest length, stiffness and
  /// damping of six directions, force | right side, value before and after, the operator's five
  /// planes, inverse diagonal | right side three times, the operator's five planes twice,
  /// inverse diagonal four times, residual and value written and read twice, coarse levels |
  /// position and velocity, mass | position, rest length of four directions, inverse mass |
  /// positions and velocities changed by a correction that is made and read, and what moves.
  std::vector<Kernel> kernels() {
    return {{"spring forces", 24 + 6 * 12 + 12, [this] { gather_forces(); }},
            {"smoothing sweep", 36 + 20 + 4, [this] { sweep(); }},
            {"V-cycle", (36 + 40 + 16 + 60) * 4.0 / 3, [this] { cycle(); }},
            {"motion", 24 + 4, [this] { look_at_motion(); }},
            {"limiter, a pass over springs", 12 + 16 + 4, [this] { limit(); }},
            {"limiter, coarse levels", 48 + 24 + 8, [this] { limit_coarsely(); }},
            {"multigrid, an iteration", 0, [this] { step(); }}};
  }
  /// A step's proposal, as the limiter gets it.
  void prepare() { state_ = proposal_; }
  [[nodiscard]] int particles() const { return cloth_.particles; }
  ThreadTeam& team() { return team_; }

 private:
  static std::unique_ptr<Simulation> moved(int size, int threads) {
    auto simulation = std::make_unique<Simulation>(hanging_sheet(size), "kernels", threads);
    for (int i = 0; i < frames_before; ++i) simulation->advance();
    return simulation;
  }

  void gather_forces() {
    const SpringRows::Motion motion{state_.position, before_.position, step_seconds};
    team_.run([&](Worker& worker) {
      springs_.begin(motion, worker);
      const Range mine = worker.share(cloth_.size);
      for (int r = mine.first; r < mine.last; ++r) {
        const ConstRow3 from = springs_.row(motion, r, worker);
        const Row3 to = row_of(force_, r);
        std::copy(from.x, from.x + cloth_.size, to.x);
        std::copy(from.y, from.y + cloth_.size, to.y);
        std::copy(from.z, from.z + cloth_.size, to.z);
      }
    });
  }
  void sweep() {
    const KernelTable& table = kernels_for(team_.instructions());
    const int n = cloth_.size;
    team_.run([&](Worker& worker) {
      const Range mine = worker.share(n);
      for (int r = mine.first; r < mine.last; ++r) {
        const Row3 out = row_of(level_.result, r);
        table.apply(n, level_.operator_row(r), level_.stencil_rows(r), out);
        (void)table.sweep(
            n,
            {0.85F, level_.inverse_diagonal.row(r), level_.share_row(r), level_.count_row(r),
             row_of(std::as_const(level_.rhs), r), row_of(std::as_const(level_.value), r)},
            out);
      }
    });
  }
  void cycle() {
    team_.run([&](Worker& worker) { (void)filter_.cycle(worker); });
  }
  void look_at_motion() {
    const KernelTable& table = kernels_for(team_.instructions());
    team_.run([&](Worker& worker) {
      const Range mine = worker.share(cloth_.size);
      for (int r = mine.first; r < mine.last; ++r)
        row_energy_[r] =
            table
                .motion(cloth_.size, cloth_.mass.row(r), row_of(std::as_const(state_.position), r),
                        row_of(std::as_const(state_.velocity), r))
                .kinetic;
    });
  }
  void limit() { limit_.limit({.passes = 1}, step_seconds, state_, team_); }
  void limit_coarsely() { coarse_limit_.limit({.passes = 1}, step_seconds, state_, team_); }
  void step() {
    integrator_->begin({step_seconds, {0, -9.81F, 0}}, before_);
    integrator_->iterate({});
    integrator_->end(state_);
  }
  std::unique_ptr<Simulation> simulation_;
  const Cloth& cloth_;
  ClothState state_, before_, proposal_;
  Planes3 force_;
  std::vector<double> row_energy_;
  ThreadTeam team_;
  SpringRows springs_;
  FilterLevel level_;
  MultigridPreconditioner filter_;
  StrainLimit limit_;
  CoarseLimit coarse_limit_;
  std::unique_ptr<Integrator> integrator_;
};

void print_row(const Kernel& kernel, int size, Sheet& sheet) {
  const double seconds = min_seconds([&] { sheet.prepare(); }, kernel.call);
  const double ns = 1e9 * seconds / sheet.particles();
  if (kernel.bytes_a_particle <= 0) {
    fmt::print("| {} | {} x {} | | {:.1f} | | | |\n", kernel.name, size, size, ns);
    return;
  }
  const double bytes = kernel.bytes_a_particle * sheet.particles();
  const double rate = bytes / seconds, triad = triad_bandwidth(bytes, sheet.team());
  fmt::print("| {} | {} x {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.0f} % |\n", kernel.name, size,
             size, 1e-6 * bytes, ns, 1e-9 * rate, 1e-9 * triad, 100 * rate / triad);
}

void measure(const std::vector<int>& sizes, int threads) {
  fmt::print(
      "| loop | samples | it works on, MB | ns a particle | GB/s | triad, GB/s | of it |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const int size : sizes) {
    Sheet sheet(size, threads);
    for (const Kernel& kernel : sheet.kernels()) {
      print_row(kernel, size, sheet);
      (void)std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  std::vector<int> sizes{41, 65, 81, 129, 257, 513, 1025};
  int threads = 1;
  weft::bench::CommandLine words{
      "Cost of the inner loops of stepping, beside the memory's bandwidth."};
  words.add("--sizes", &sizes, "Samples a side");
  words.add("--threads", &threads);
  return words.run(argc, argv, [&] { weft::bench::measure(sizes, threads); });
}
