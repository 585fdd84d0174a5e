#include "weft/cloth/measure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "weft/cloth/bending.h"
#include "weft/cloth/border_springs.h"

namespace weft {
namespace {

double spring_length(const Planes3& p, int from, int to) {
  return length(vec_cast<double>(p.at(to)) - vec_cast<double>(p.at(from)));
}

/// |l / r - 1| of a spring.
float strain_of(const Planes3& p, int from, int to, double rest) {
  return static_cast<float>(std::abs(spring_length(p, from, to) / rest - 1));
}

/// The same of every stretch spring of panels that are not sewn yet: each panel by its own samples.
std::vector<float> strains_of_panels(const Cloth& cloth, const Planes3& p) {
  std::vector<float> strains;
  for (const SpringPlane* plane : {&cloth.springs[stretch_u], &cloth.springs[stretch_v]})
    for (int r = 0; r + plane->down < cloth.size; ++r)
      for (int c = 0; c + plane->right < cloth.size; ++c)
        if (plane->stiffness(r, c) > 0)
          strains.push_back(strain_of(p, r * cloth.size + c,
                                      (r + plane->down) * cloth.size + c + plane->right,
                                      plane->rest_length(r, c)));
  return strains;
}

/// |l / r - 1| of every stretch spring, a seam spring once.
std::vector<float> stretch_strains(const Cloth& cloth, const Planes3& p) {
  if (cloth.apart) return strains_of_panels(cloth, p);
  const int n = cloth.size;
  std::vector<float> strains;
  strains.reserve(2 * static_cast<std::size_t>(n) * n);
  const auto add = [&](int from, int to, double rest) {
    strains.push_back(strain_of(p, from, to, rest));
  };
  const bool one_chart = cloth.mates.chart_of().empty();
  const auto inside = [&](int r, int c) { return one_chart || !on_border(cloth.mates, r, c); };
  for (const SpringPlane* plane : {&cloth.springs[stretch_u], &cloth.springs[stretch_v]})
    for (int r = 1; r + plane->down < n - 1; ++r)
      for (int c = 1; c + plane->right < n - 1; ++c)
        if (inside(r, c) && inside(r + plane->down, c + plane->right))
          add(r * n + c, (r + plane->down) * n + c + plane->right, plane->rest_length(r, c));
  for (const BorderSpring& spring : cloth.border_springs)
    if (spring.stretch) add(spring.from, spring.to, spring.rest_length);
  return strains;
}

/// Sums value(row, col) over the particles, each once.
template <class Value>
auto sum_particles(const Cloth& cloth, const Value& value) {
  decltype(value(0, 0)) sum{};
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c)
      if (cloth.owner(r, c) > 0) sum += value(r, c);
  return sum;
}

double energy_of(const SpringPlane& plane, const Planes3& p) {
  const int n = p.size();
  double sum = 0;
  for (int r = 0; r + plane.down < n; ++r)
    for (int c = std::max(0, -plane.right); c + std::max(0, plane.right) < n; ++c) {
      const double l = spring_length(p, r * n + c, (r + plane.down) * n + c + plane.right);
      const double strained = l - plane.rest_length(r, c);
      sum += 0.5 * plane.stiffness(r, c) * strained * strained;
    }
  return sum;
}

}  // namespace

StrainSummary measure_strain(const Cloth& cloth, const ClothState& state) {
  std::vector<float> strains = stretch_strains(cloth, state.position);
  if (strains.empty()) return {};
  StrainSummary summary;
  for (const float strain : strains) summary.mean += strain;
  summary.mean /= static_cast<double>(strains.size());
  const auto p99 = strains.begin() + static_cast<std::ptrdiff_t>(0.99 * (strains.size() - 1));
  std::nth_element(strains.begin(), p99, strains.end());
  summary.p99 = *p99;
  summary.max = *std::max_element(p99, strains.end());
  return summary;
}

Vec3d centre_of_mass(const Cloth& cloth, const ClothState& state) {
  const double mass =
      sum_particles(cloth, [&](int r, int c) -> double { return cloth.mass(r, c); });
  const Vec3d moment = sum_particles(cloth, [&](int r, int c) {
    return double{cloth.mass(r, c)} * vec_cast<double>(state.position.at(r, c));
  });
  return (1 / mass) * moment;
}

double kinetic_energy(const Cloth& cloth, const ClothState& state) {
  return sum_particles(cloth, [&](int r, int c) {
    return 0.5 * cloth.mass(r, c) * squared_length(vec_cast<double>(state.velocity.at(r, c)));
  });
}

double potential_energy(const Cloth& cloth, const ClothState& state, Vec3d gravity) {
  double energy = -sum_particles(cloth, [&](int r, int c) {
    return cloth.mass(r, c) * dot(gravity, vec_cast<double>(state.position.at(r, c)));
  });
  for (const SpringPlane& plane : cloth.springs) energy += energy_of(plane, state.position);
  return energy + bending_energy(cloth, state.position);
}

std::optional<BadParticle> find_not_finite(const ClothState& state) {
  const auto finite = [](Vec3f v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const int n = state.position.size();
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      if (!finite(state.position.at(r, c)) || !finite(state.velocity.at(r, c)))
        return BadParticle{r, c};
  return std::nullopt;
}

void strain_at_samples(std::span<const SpringPlane> springs, const Planes3& positions,
                       Grid<float>& strains) {
  const int n = positions.size();
  Grid<float> counts(n, n);
  strains.fill(0);
  const auto add = [&](int row, int col, float strain) {
    strains(row, col) += strain;
    counts(row, col) += 1;
  };
  for (const SpringPlane& plane : springs)
    for (int r = 0; r + plane.down < n; ++r)
      for (int c = 0; c + plane.right < n; ++c) {
        if (!(plane.stiffness(r, c) > 0)) continue;
        const int row = r + plane.down, col = c + plane.right;
        const float strain =
            length(positions.at(row, col) - positions.at(r, c)) / plane.rest_length(r, c) - 1;
        add(r, c, strain);
        add(row, col, strain);
      }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      if (counts(r, c) > 0) strains(r, c) /= counts(r, c);
}

}  // namespace weft
