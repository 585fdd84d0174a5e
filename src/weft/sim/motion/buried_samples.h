#pragma once

#include <vector>

#include "weft/sim/loading/insides.h"

namespace weft {

/// Finds which samples of a closed body lie in the body itself, as where an arm enters the side,
/// and which leave no room for cloth before them.
class BuriedSamples {
 public:
  /// @param image      gives the triangles, kept by reference
  /// @param positions  kept by reference [n x n] [m]
  /// @param gap        that cloth keeps to bodies: it has no room between sides that are nearer [m]
  BuriedSamples(const GeometryImage& image, const Planes3& positions, double gap);
  /// Whether the body is closed, as `find` requires.
  [[nodiscard]] bool closed() const { return body_.closed(); }
  /// Marks the samples at the current positions, mates alike: 2 in the body, 1 without room before
  /// them, 0 elsewhere. @param marks  [n * n]
  void find(ThreadTeam& team, std::vector<char>& marks);

 private:
  void add_normals();
  [[nodiscard]] char mark_of(int sample) const;

  const Planes3& positions_;
  const BorderMates& mates_;
  std::vector<Triangle> triangles_;
  ClosedBody body_;
  double gap_;
  std::vector<Vec3d> normals_;  // [n * n] outwards, of representatives; not of unit length
};

}  // namespace weft
