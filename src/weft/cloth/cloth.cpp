#include "weft/cloth/cloth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/bending_weights.h"
#include "weft/cloth/border_springs.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/rest_shape.h"
#include "weft/error.h"

namespace weft {
namespace {

void require(bool good, const char* key, double value, const char* wanted) {
  if (!good) throw SceneError(fmt::format("material.{}", key), fmt::format("{}", value), wanted);
}

void check_material(const Material& m) {
  const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
  const auto not_negative = [](double v) { return std::isfinite(v) && v >= 0; };
  require(positive(m.density), "density", m.density, "a density above 0 kg/m^2");
  for (const double stretch : {m.stretch.warp, m.stretch.weft})
    require(not_negative(stretch), "stretch", stretch, "a stiffness of at least 0 N/m");
  require(not_negative(m.shear), "shear", m.shear, "a stiffness of at least 0 N/m");
  for (const double bending : {m.bending.warp, m.bending.weft})
    require(not_negative(bending), "bending", bending, "a stiffness of at least 0 N m");
  require(not_negative(m.bend_springs), "bend_springs", m.bend_springs,
          "a stiffness of at least 0 N/m");
  require(not_negative(m.damping), "damping", m.damping, "a rate of at least 0 1/s");
  require(not_negative(m.strain_limit) && m.strain_limit < 1, "strain_limit", m.strain_limit,
          "an elongation in [0, 1)");
  require(positive(m.thickness), "thickness", m.thickness, "a thickness above 0 m");
}

void check_rest(const Planes3& rest, const BorderMates& mates) {
  const int n = rest.size();
  if (n < 2 || mates.size() != n)
    throw SceneError(
        "cloth", fmt::format("an image of {} samples a side with mates for {}", n, mates.size()),
        "at least 2, and mates of the same size, are wanted");
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const Vec3f p = rest.at(r, c);
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw SceneError("cloth",
                         fmt::format("a position that is not finite at row {}, col {}", r, c),
                         "finite rest positions are wanted");
    }
}

/// Marks the representatives and counts them.
void count_particles(Cloth& cloth) {
  const int n = cloth.size;
  cloth.owner = Grid<float>(n, n, 1);
  cloth.particles = n * n;
  for (int index = 0; index < cloth.mates.class_count(); ++index)
    for (const int sample : cloth.mates.mates(index).subspan(1)) {
      cloth.owner(sample / n, sample % n) = 0;
      --cloth.particles;
    }
}

/// Computes the masses and raises those below the minimum to it.
/// @throws SceneError when the whole cloth has no mass
void set_masses(Cloth& cloth, const RestShape& shape) {
  const int n = cloth.size;
  cloth.mass = make_masses(shape, cloth.material.density);
  double total = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) total += cloth.mass(r, c) * cloth.owner(r, c);
  if (!(total > 0))
    throw SceneError("cloth", "a rest shape without area: its samples carry no mass",
                     "a surface, not a point or a curve, is wanted");
  const auto min = static_cast<float>(min_relative_mass * total / cloth.particles);
  cloth.inverse_mass = Grid<float>(n, n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      cloth.mass(r, c) = std::max(cloth.mass(r, c), min);
      cloth.inverse_mass(r, c) = cloth.mates.is_hole(r * n + c) ? 0 : 1 / cloth.mass(r, c);
    }
}

/// Sets the damping of a plane's springs. A spring along the border gets half, like its stiffness:
/// on a seam both mates store it.
void set_damping(Cloth& cloth, SpringPlane& plane) {
  const bool straight = plane.down == 0 || plane.right == 0;
  const SpringDirection direction = plane.down == 0 ? stretch_u : stretch_v;
  for_each_spring(cloth.mates, plane, [&](int r, int c, int r2, int c2) {
    const double a = cloth.mass(r, c), b = cloth.mass(r2, c2);
    const bool along = straight && along_border(cloth.mates, direction, r, c);
    const double share = along ? 0.5 : 1.0;
    plane.damping(r, c) = static_cast<float>(share * cloth.material.damping * a * b / (a + b));
  });
}

}  // namespace

Cloth make_cloth(const ClothShape& wanted, const Material& material) {
  check_material(material);
  check_rest(wanted.rest, wanted.mates);
  const RestShape shape(wanted.rest, wanted.mates, wanted.warp);
  Cloth cloth;
  cloth.size = wanted.rest.size();
  cloth.material = material;
  cloth.mates = wanted.mates;
  cloth.rest = wanted.rest;
  count_particles(cloth);
  set_masses(cloth, shape);
  for (int d = 0; d < spring_directions; ++d) {
    const auto direction = static_cast<SpringDirection>(d);
    cloth.springs[d] = make_springs(shape, material, direction);
    set_damping(cloth, cloth.springs[d]);
  }
  const BorderMates& bent = wanted.bending != nullptr ? *wanted.bending : wanted.mates;
  cloth.bending = make_bending(RestShape(wanted.rest, bent, wanted.warp), material);
  cloth.border_springs = find_border_springs(cloth);
  cloth.rest_spacing = shape.mean_spacing;
  return cloth;
}

Cloth make_cloth(const Planes3& rest, const BorderMates& mates, const Material& material) {
  return make_cloth(ClothShape{rest, mates}, material);
}

int pin(Cloth& cloth, int sample, Vec3d target) {
  const int n = cloth.size;
  if (sample < 0 || sample >= n * n)
    throw SceneError("pins", fmt::format("sample {}", sample),
                     fmt::format("one of 0 to {}", n * n - 1));
  const int representative = cloth.mates.representative(sample);
  for (std::size_t i = 0; i < cloth.pins.size(); ++i)
    if (cloth.mates.representative(cloth.pins[i].sample) == representative) {
      cloth.pins[i].target = target;
      return static_cast<int>(i);
    }
  Pin added{sample, target, {representative}};
  for (int index = 0; index < cloth.mates.class_count(); ++index) {
    const std::span<const int> samples = cloth.mates.mates(index);
    if (samples.front() == representative) added.copies.assign(samples.begin(), samples.end());
  }
  for (const int copy : added.copies) cloth.inverse_mass(copy / n, copy % n) = 0;
  cloth.pins.push_back(std::move(added));
  return static_cast<int>(cloth.pins.size()) - 1;
}

void unpin_last(Cloth& cloth) {
  const int n = cloth.size;
  for (const int copy : cloth.pins.back().copies)
    if (!cloth.mates.is_hole(copy))
      cloth.inverse_mass(copy / n, copy % n) = 1 / cloth.mass(copy / n, copy % n);
  cloth.pins.pop_back();
}

ClothState rest_state(const Cloth& cloth, Vec3f velocity) {
  ClothState state{cloth.start_positions(), Planes3(cloth.size)};
  state.velocity.x.fill(velocity.x);
  state.velocity.y.fill(velocity.y);
  state.velocity.z.fill(velocity.z);
  return state;
}

}  // namespace weft
