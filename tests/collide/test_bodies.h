#pragma once

#include <cmath>
#include <functional>
#include <memory>

#include "weft/collide/broad_phase/pyramid_pairs.h"
#include "weft/collide/collider.h"
#include "weft/core/math.h"

namespace weft::test {

/// A sphere as an image: the square is an unfolded octahedron, its centre +y, its four corners -y;
/// every side folds onto itself.
inline Body octahedral_sphere(int n, double radius, Vec3d centre) {
  Body body;
  body.positions = Planes3(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double u = 2.0 * c / (n - 1) - 1, v = 2.0 * r / (n - 1) - 1;
      const double height = 1 - std::abs(u) - std::abs(v);
      // Outside the diamond the lower half is folded out; u to -z keeps dP/du x dP/dv pointing
      // outwards.
      const double x = height >= 0 ? u : (u < 0 ? -1 : 1) * (1 - std::abs(v));
      const double z = height >= 0 ? v : (v < 0 ? -1 : 1) * (1 - std::abs(u));
      const Vec3d direction = normalized(Vec3d{x, height, -z});
      body.positions.set(r, c, vec_cast<float>(centre + radius * direction));
    }
  std::vector<MateInterval> folds;
  for (int side = 0; side < 4; ++side)
    folds.push_back({side * (n - 1), (side + 1) * (n - 1) % (4 * (n - 1)), (n - 1) / 2});
  body.mates = BorderMates(n, folds);
  for (int k = 0; k < body.mates.class_count(); ++k)
    for (const int sample : body.mates.mates(k))
      body.positions.set(sample, body.positions.at(body.mates.mates(k)[0]));
  return body;
}

/// The same with flat sides, edges and tips: an octahedron.
/// @param half  from its centre to its tips along x, y and z [m]
inline Body octahedron(int n, Vec3d half, Vec3d centre) {
  Body body = octahedral_sphere(n, 1, {});
  for (int s = 0; s < n * n; ++s) {
    const Vec3d p = vec_cast<double>(body.positions.at(s));
    const double sum = std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
    const Vec3d flat{half.x * p.x / sum, half.y * p.y / sum, half.z * p.z / sum};
    body.positions.set(s, vec_cast<float>(centre + flat));
  }
  return body;
}

/// A torus around the y axis; rows and columns both wrap.
inline Body torus(int n, double ring, double tube) {
  Body body;
  body.positions = Planes3(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double around = 2 * pi * (c % (n - 1)) / (n - 1), up = 2 * pi * (r % (n - 1)) / (n - 1);
      const double out = ring + tube * cosine(up);
      body.positions.set(
          r, c, vec_cast<float>(Vec3d{out * cosine(around), tube * sine(up), -out * sine(around)}));
    }
  body.mates = BorderMates(n, {{0, 3 * (n - 1), n - 1}, {n - 1, 4 * (n - 1), n - 1}});
  return body;
}

/// The broad phase of worlds of few surfaces.
inline std::unique_ptr<BroadPhase> pyramid(std::span<const SurfaceGrid* const> grids,
                                           std::size_t cloths) {
  return std::make_unique<PyramidPairs>(grids, cloths);
}

/// The polar map as the collider of one cloth without seams.
inline std::unique_ptr<Collider> polar_collider(const Obstacles& obstacles, double thickness,
                                                double friction) {
  static const BorderMates no_mates;
  const CollidingCloth cloth{.mates = no_mates, .thickness = thickness, .friction = friction};
  return make_collider(PolarMapOptions{}, obstacles, std::span(&cloth, 1));
}

/// Four planes of a moving cloth that a test owns.
struct TestCloth {
  explicit TestCloth(int n) : start(n), position(n), velocity(n), inverse_mass(n, n, 1.0F) {}
  void place(const std::function<Vec3d(int, int)>& at) {
    for (int r = 0; r < position.size(); ++r)
      for (int c = 0; c < position.size(); ++c) position.set(r, c, vec_cast<float>(at(r, c)));
    start = position;
  }
  MovingCloth moving() { return {start, position, velocity, inverse_mass}; }

  Planes3 start, position, velocity;
  Grid<float> inverse_mass;
};

}  // namespace weft::test
