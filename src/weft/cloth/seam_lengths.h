#pragma once

#include <cmath>
#include <vector>

#include "weft/geometry_image.h"

namespace weft {

/// Length of a spring in the arithmetic of the forces, so that a cloth at rest has exactly none.
inline float spring_length(Vec3f a, Vec3f b) {
  const Vec3f d = b - a;
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

/// Two particles by their representatives, from < to, and the length of a spring between them.
struct SeamLength {
  int from = 0, to = 0;
  float length = 0;  ///< [m]
};

/// The rest lengths along seams. Where edges of unequal length are sewn together the seam is as
/// long as the shorter: the longer is gathered on it, its samples as close there as those of the
/// other, while the cloth beside the seam keeps its width and folds.
class SeamLengths {
 public:
  /// @param rest  [n x n] positions, where mates may lie apart [m]
  /// @param mates  kept by reference
  /// @param step  between the samples of a spring: 1 neighbours, 2 second neighbours
  SeamLengths(const Planes3& rest, const BorderMates& mates, int step);

  /// The length of the shortest spring along rows or columns between the particles of two samples,
  /// at least a quarter of `length`: where a texture is folded up to a point, nothing is gathered.
  /// @param length  of their own spring, the result if they are not both on seams [m]
  [[nodiscard]] float shortest(int from, int to, float length) const;

 private:
  [[nodiscard]] SeamLength between(int from, int to) const;
  void add(const Planes3& rest, int from, int to);

  const BorderMates& mates_;
  std::vector<SeamLength> lengths_;  // each pair once, sorted by it
};

}  // namespace weft
