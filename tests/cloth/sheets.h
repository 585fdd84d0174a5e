#pragma once

#include "weft/cloth/cloth.h"
#include "weft/cloth/integrator.h"
#include "weft/core/hash.h"
#include "weft/core/math.h"
#include "weft/core/random.h"

namespace weft::testing {

/// A flat 1 m square in the xz plane, centred on the origin, u along x, v along z.
inline Planes3 flat_sheet(int n) {
  Planes3 p(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const float u = static_cast<float>(c) / static_cast<float>(n - 1) - 0.5F;
      const float v = static_cast<float>(r) / static_cast<float>(n - 1) - 0.5F;
      p.set(r, c, {u, 0, v});
    }
  return p;
}

inline BorderMates no_mates(int n) { return {n, {}}; }
/// Row 0 is the last row, column 0 the last column.
inline BorderMates torus_mates(int n) { return {n, {{0, 3 * (n - 1), n - 1}, {n - 1, 0, n - 1}}}; }

/// A torus about the y axis: columns run around the axis, rows around the tube.
inline Planes3 torus(int n, double radius = 0.4, double tube = 0.15) {
  Planes3 p(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double a = 2 * pi * (c % (n - 1)) / (n - 1), b = 2 * pi * (r % (n - 1)) / (n - 1);
      const double out = radius + tube * cosine(b);
      p.set(r, c, vec_cast<float>(Vec3d{out * cosine(a), tube * sine(b), out * sine(a)}));
    }
  return p;
}

/// A tenth of a fabric's stiffness, and a limit: what methods of few iterations can hold.
inline const Material soft_fabric{.stretch = 2000, .shear = 500, .strain_limit = 0.05};

inline Cloth sheet_cloth(int n, const Material& material = soft_fabric) {
  return make_cloth(flat_sheet(n), no_mates(n), material);
}
inline Cloth torus_cloth(int n, const Material& material = soft_fabric) {
  return make_cloth(torus(n), torus_mates(n), material);
}

/// Moves every particle by up to `amount` in each coordinate; mates alike, pins not.
inline void shake(const Cloth& cloth, double amount, Planes3& planes, int seed = 1) {
  Random random(static_cast<std::uint64_t>(seed));
  const auto some = [&] { return static_cast<float>(random.uniform(-amount, amount)); };
  for (int s = 0; s < cloth.size * cloth.size; ++s)
    if (cloth.owner(s / cloth.size, s % cloth.size) > 0)
      planes.set(s, planes.at(s) + Vec3f{some(), some(), some()});
  for (int i = 0; i < cloth.mates.class_count(); ++i)
    for (const int s : cloth.mates.mates(i)) planes.set(s, planes.at(cloth.mates.mates(i)[0]));
}

/// Sum of m v over particles.
inline Vec3d momentum(const Cloth& cloth, const ClothState& state) {
  Vec3d sum;
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const double m = double{cloth.mass(s / cloth.size, s % cloth.size)} *
                     cloth.owner(s / cloth.size, s % cloth.size);
    sum += m * vec_cast<double>(state.velocity.at(s));
  }
  return sum;
}
/// Sum of x cross m v over particles.
inline Vec3d angular_momentum(const Cloth& cloth, const ClothState& state) {
  Vec3d sum;
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const double m = double{cloth.mass(s / cloth.size, s % cloth.size)} *
                     cloth.owner(s / cloth.size, s % cloth.size);
    sum +=
        m * cross(vec_cast<double>(state.position.at(s)), vec_cast<double>(state.velocity.at(s)));
  }
  return sum;
}

inline double total_mass(const Cloth& cloth) {
  double sum = 0;
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) sum += double{cloth.mass(r, c)} * cloth.owner(r, c);
  return sum;
}

inline bool mates_equal(const Cloth& cloth, const ClothState& state) {
  for (int i = 0; i < cloth.mates.class_count(); ++i)
    for (const int s : cloth.mates.mates(i)) {
      const int first = cloth.mates.mates(i)[0];
      if (!(state.position.at(s) == state.position.at(first))) return false;
      if (!(state.velocity.at(s) == state.velocity.at(first))) return false;
    }
  return true;
}

inline std::string hash_of(const ClothState& state) {
  Hash hash;
  for (const Planes3* planes : {&state.position, &state.velocity})
    for (const Grid<float>* plane : {&planes->x, &planes->y, &planes->z}) hash.add(*plane);
  return hash.text();
}

/// A sample and its mates, moved together.
inline void move(const Cloth& cloth, int sample, Vec3f by, Planes3& planes) {
  const int representative = cloth.mates.representative(sample);
  for (int s = 0; s < cloth.size * cloth.size; ++s)
    if (cloth.mates.representative(s) == representative) planes.set(s, planes.at(s) + by);
}

/// Steps without collisions. @return the last step's report
inline StepReport run(Integrator& integrator, const StepInput& input, int steps,
                      ClothState& state) {
  StepReport report;
  for (int i = 0; i < steps; ++i) {
    integrator.begin(input, state);
    integrator.iterate({});
    report = integrator.end(state);
  }
  return report;
}

}  // namespace weft::testing
