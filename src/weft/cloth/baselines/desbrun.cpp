#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/baselines/filtered_integrator.h"
#include "weft/cloth/integrator.h"
#include "weft/error.h"

namespace weft {
namespace {

/// Largest size of W: 23,170 particles, an image of 152 x 152 without mates.
constexpr std::int64_t max_matrix_bytes = std::int64_t{1} << 31;
constexpr double megabyte = 1e6;

/// The method that the paper builds on [desbrun99]: the accelerations of the cloth's own springs,
/// filtered by one dense W over all particles, mates merged. A spring's damping c counts as
/// stiffness c / h in H, as in implicit Euler. Pinned particles are not in W: forces on them move
/// nothing.
class Desbrun final : public FilteredIntegrator {
 public:
  Desbrun(const Cloth& cloth, const StepInput& typical, ThreadTeam& team)
      : FilteredIntegrator(cloth, team), filter_step_(typical.time_step) {
    const auto h = static_cast<float>(filter_step_);
    for (int d = 0; d < spring_directions; ++d) {
      const SpringPlane& own = cloth.springs[d];
      springs_.stiffness[d] = own.stiffness;
      springs_.viscosity[d] = own.damping;
      for (int r = 0; r < cloth.size; ++r)
        for (int c = 0; c < cloth.size; ++c) springs_.viscosity[d](r, c) += h * own.stiffness(r, c);
    }
    make_filter();
  }

  /// Stable for any stiffness.
  [[nodiscard]] std::string stability_advice(double /*time_step*/) const override { return {}; }

 private:
  [[nodiscard]] bool knows_pins() const {
    return std::equal(cloth_.pins.begin(), cloth_.pins.end(), held_.begin(), held_.end(),
                      [](const Pin& pin, int sample) { return pin.sample == sample; });
  }

  void renew() override {
    if (!knows_pins()) make_filter();
  }

  /// Numbers the particles that move.
  void number_particles() {
    const int n = cloth_.size;
    held_.clear();
    for (const Pin& pin : cloth_.pins) held_.push_back(pin.sample);
    sample_of_.clear();
    particle_of_.assign(static_cast<std::size_t>(n) * n, -1);
    for (int s = 0; s < n * n; ++s) {
      const int first = cloth_.mates.representative(s);
      if (cloth_.inverse_mass(s / n, s % n) == 0) continue;
      if (first == s) {
        particle_of_[s] = static_cast<int>(sample_of_.size());
        sample_of_.push_back(s);
      }
      particle_of_[s] = particle_of_[first];
    }
  }

  void make_filter() {
    number_particles();
    const int n = cloth_.size;
    FilterGrid grid{n, particle_of_, {}, {}, filter_step_};
    for (const int s : sample_of_) grid.mass.push_back(cloth_.mass(s / n, s % n));
    for (int d = 0; d < spring_directions; ++d) {
      grid.stiffness[d] = Grid<double>(n, n);
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c)
          grid.stiffness[d](r, c) =
              cloth_.springs[d].stiffness(r, c) + cloth_.springs[d].damping(r, c) / filter_step_;
    }
    matrix_ = filter_matrix(grid, team_);
    before_ = after_ = Vectors3(static_cast<int>(sample_of_.size()));
  }

  void filter(const Planes3& acceleration, Planes3& filtered, Worker& worker) override {
    const Range particles = worker.share(static_cast<int>(sample_of_.size()));
    for (int p = particles.first; p < particles.last; ++p)
      before_.set(p, acceleration.at(sample_of_[p]));
    worker.barrier();
    kernels_.dense_rows(particles.first, particles.last, {matrix_.row(0), matrix_.stride()},
                        std::as_const(before_).rows(), after_.rows());
    worker.barrier();
    const int n = cloth_.size;
    const Range rows = worker.share(n);
    for (int s = rows.first * n; s < rows.last * n; ++s)
      filtered.set(s, particle_of_[s] < 0 ? Vec3f{} : after_.at(particle_of_[s]));
  }

  double filter_step_;            // [s]
  std::vector<int> held_;         // samples of the pins that W was made for
  std::vector<int> particle_of_;  // [n^2], -1: held
  std::vector<int> sample_of_;    // [particles]
  Grid<float> matrix_;            // [particles x particles]
  Vectors3 before_, after_;
};

}  // namespace

std::unique_ptr<Integrator> make_integrator_of(const DesbrunOptions& /*options*/,
                                               const Cloth& cloth, const StepInput& typical,
                                               ThreadTeam& team) {
  const std::int64_t bytes = std::int64_t{4} * cloth.particles * cloth.particles;
  if (bytes > max_matrix_bytes)
    throw SceneError("integrator.type",
                     fmt::format("desbrun on {} particles, whose matrix takes {:.0f} MB",
                                 cloth.particles, static_cast<double>(bytes) / megabyte),
                     fmt::format("at most {:.0f} MB, a smaller size or another integrator",
                                 static_cast<double>(max_matrix_bytes) / megabyte));
  return std::make_unique<Desbrun>(cloth, typical, team);
}

}  // namespace weft
