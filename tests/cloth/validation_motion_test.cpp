#include <gtest/gtest.h>

#include "tests/cloth/validation.h"
#include "weft/cloth/baselines/stable_step.h"

namespace weft {
namespace {

using namespace testing;

/// The defaults, and baselines solved to the end.
const std::vector<Way> ways{
    {NewtonOptions{}, "newton"},
    {ImplicitOptions{.tolerance = 1e-7}, "implicit to 1e-7"},
    {MultigridOptions{.max_iterations = 100, .tolerance = 1e-8}, "multigrid to 1e-8"}};

TEST(ValidationMotion, FreeFallIsExact) {
  const Cloth cloth = sheet_cloth(17);
  const StepInput input{1.0 / 240, {0, -9.81F, 0}};
  const int steps = 240;
  const double t = steps * input.time_step, h = input.time_step;
  for (const IntegratorOptions& options :
       {IntegratorOptions(NewtonOptions{}), IntegratorOptions(ImplicitOptions{}),
        IntegratorOptions(TwoLevelOptions{.local_size = 5}),
        IntegratorOptions(MultigridOptions{})}) {
    ThreadTeam team(1);
    const auto integrator = make_integrator(options, cloth, input, team);
    ClothState state = rest_state(cloth, {0, 2, 0});
    run(*integrator, input, steps, state);
    const double fallen = centre_of_mass(cloth, state).y;
    check(fmt::format("free fall for 1 s, {}: height [m]", name_of(options)),
          2 * t - 9.81 * t * (t + h) / 2, fallen, 2e-5);
  }
}

/// Two rows of two particles, joined by springs along x alone.
Cloth spring_pair() {
  return make_cloth(flat_sheet(2), no_mates(2),
                    {.stretch = 50, .shear = 0, .bending = 0, .damping = 0});
}

TEST(ValidationMotion, ImplicitEulerDampsASpringByItsFactor) {
  const Cloth cloth = spring_pair();
  const double stiffness = cloth.springs[stretch_u].stiffness(0, 0);
  const double squared_frequency = 2 * stiffness / cloth.mass(0, 0);
  for (const Way& way : ways)
    for (const double step : {0.005, 0.02}) {
      ThreadTeam team(1);
      const StepInput input{step, {}};
      const auto integrator = make_integrator(way.options, cloth, input, team);
      ClothState state = rest_state(cloth);
      for (const int sample : {0, 2}) state.position.x(sample / 2, 0) -= 0.01F;
      const auto amplitude = [&] {
        const double stretch = double{state.position.x(0, 1)} - state.position.x(0, 0) - 1;
        const double speed = double{state.velocity.x(0, 1)} - state.velocity.x(0, 0);
        return std::sqrt(squared_frequency * stretch * stretch + speed * speed);
      };
      const int steps = 20;
      const double before = amplitude();
      run(*integrator, input, steps, state);
      const double factor = std::exp(std::log(amplitude() / before) / steps);
      check(fmt::format("amplitude of a spring a step, {}, w h = {:.2f}", way.name,
                        std::sqrt(squared_frequency) * step),
            1 / std::sqrt(1 + squared_frequency * step * step), factor, 2e-5);
    }
}

/// The Laguerre polynomial L_k.
double laguerre(int k, double x) {
  double before = 1, now = 1 - x;
  if (k == 0) return before;
  for (int i = 1; i < k; ++i) {
    const double next = ((2 * i + 1 - x) * now - i * before) / (i + 1);
    before = now;
    now = next;
  }
  return now;
}

/// A sheet that hangs by its first row as N rows of equal masses on links of one length.
/// @param stretch  [N/m]
Cloth chain(int masses, double length, double stretch) {
  const int n = masses + 1;
  Planes3 rest(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      rest.set(r, c, vec_cast<float>(Vec3d{0.1 * c, -length * r / masses, 0}));
  Cloth cloth =
      make_cloth(rest, no_mates(n), {.stretch = stretch, .shear = 0, .bending = 0, .damping = 0});
  cloth.mass.fill(0.002F);
  cloth.inverse_mass.fill(1 / 0.002F);
  for (int c = 0; c < n; ++c) pin_at(cloth, 0, c, rest);
  return cloth;
}

/// First period of small swings over sqrt(L / g), from the first mode's shape: the displacements
/// are L_j(root), j masses above the lowest, with L_N(root) = 0 at the support.
double chain_period(const Cloth& cloth, double wanted, const IntegratorOptions& options,
                    double step) {
  const int masses = cloth.size - 1;
  const double length = 1, root = 4 * pi * pi / (wanted * wanted * masses);
  ThreadTeam team(1);
  const StepInput input{step, {0, -9.81F, 0}};
  const auto integrator = make_integrator(options, cloth, input, team);
  ClothState state = rest_state(cloth);
  for (int r = 0; r <= masses; ++r)
    for (int c = 0; c <= masses; ++c)
      state.position.z(r, c) = static_cast<float>(0.01 * laguerre(masses - r, root));
  double first = 0, last = 0, before = 0;
  int crossings = 0;
  for (int i = 0; crossings < 3; ++i) {
    run(*integrator, input, 1, state);
    const double now = state.position.z(masses, 0);
    if (i > 0 && (before < 0) != (now < 0)) {
      const double time = (i + before / (before - now)) * step;
      (crossings == 0 ? first : last) = time;
      ++crossings;
    }
    before = now;
    if (i * step > 20) break;
  }
  return 2 * (last - first) / (crossings - 1) / std::sqrt(length / 9.81);
}

void check_chain(int masses, double wanted) {
  ThreadTeam alone(1);
  const Cloth cloth = chain(masses, 1, 2e4);
  const double step = 0.4 * largest_stable_step(cloth, alone);
  check(fmt::format("period of a chain of {}, explicit", masses), wanted,
        chain_period(cloth, wanted, ExplicitOptions{}, step), 2e-3 * wanted);
}

/// Single precision asks for softer links where a step is long.
void check_soft_chain(const Way& way) {
  check(fmt::format("period of a chain of 5, {}", way.name), 5.473371,
        chain_period(chain(5, 1, 2e3), 5.473371, way.options, 2e-3), 2e-3 * 5.473371);
}

TEST(ValidationMotion, HangingChainSwingsAtItsPeriod) {
  check_chain(2, 5.804906);
  check_chain(5, 5.473371);
  check_chain(10, 5.352609);
  for (const Way& way : {ways[0], tight, ways[1], ways[2]}) check_soft_chain(way);
}

TEST(ValidationMotion, DISABLED_LongChainSwingsAtItsPeriod) {
  check_chain(20, 5.289900);
  check_chain(50, 5.251462);
}

/// A sheet that spins and waves in free space.
ClothState spinning(const Cloth& cloth) {
  ClothState state = rest_state(cloth, {0.3F, -0.1F, 0.2F});
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const Vec3f p = cloth.rest.at(s);
    const float wave = 0.3F * static_cast<float>(sine(6.0 * p.x) * cosine(5.0 * p.z));
    state.velocity.set(s, state.velocity.at(s) + cross(Vec3f{1, 3, 2}, p) + Vec3f{0, wave, 0});
  }
  return state;
}

TEST(ValidationMotion, LinearMomentumIsKeptAndAngularToFirstOrder) {
  const Cloth cloth = sheet_cloth(17);
  const ClothState start = spinning(cloth);
  const Vec3d linear = momentum(cloth, start), angular = angular_momentum(cloth, start);
  for (const Way& way : ways) {
    std::vector<double> errors;
    for (const double step : {1.0 / 240, 1.0 / 480, 1.0 / 960}) {
      ThreadTeam team(1);
      const StepInput input{step, {}};
      const auto integrator = make_integrator(way.options, cloth, input, team);
      ClothState state = start;
      run(*integrator, input, static_cast<int>(std::lround(0.5 / step)), state);
      check(fmt::format("linear momentum lost of all, {}, h = 1/{:.0f}", way.name, 1 / step), 0,
            length(momentum(cloth, state) - linear) / length(linear), 1e-4);
      const Vec3d carried = cross(centre_of_mass(cloth, state), momentum(cloth, state));
      const Vec3d spin = angular_momentum(cloth, state) - carried;
      errors.push_back(length(spin - angular) / length(angular));
    }
    check(fmt::format("angular momentum's error, {}: order in h", way.name), 1,
          std::log2(errors[1] / errors[2]), 0.15);
  }
}

TEST(ValidationMotion, DissipationIsOfFirstOrder) {
  const Cloth cloth = spring_pair();
  for (const Way& way : ways) {
    std::vector<double> lost;
    for (const double step : {0.002, 0.001}) {
      ThreadTeam team(1);
      const StepInput input{step, {}};
      const auto integrator = make_integrator(way.options, cloth, input, team);
      ClothState state = rest_state(cloth);
      for (const int sample : {0, 2}) state.position.x(sample / 2, 0) -= 0.05F;
      const auto energy = [&] {
        return kinetic_energy(cloth, state) + potential_energy(cloth, state, {});
      };
      const double before = energy();
      run(*integrator, input, static_cast<int>(std::lround(0.5 / step)), state);
      lost.push_back(std::log(before / energy()));
    }
    check(fmt::format("energy lost to the step, {}: order in h", way.name), 1,
          std::log2(lost[0] / lost[1]), 0.05);
  }
}

}  // namespace
}  // namespace weft
