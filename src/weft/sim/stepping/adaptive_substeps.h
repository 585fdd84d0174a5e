#pragma once

#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/collide/contacts/surface_motion.h"
#include "weft/grid.h"
#include "weft/mesh.h"
#include "weft/vec.h"

namespace weft {

/// Bodies come at most this part of the least gap closer in a step where cloth is near, so that
/// cloth is pushed before it is passed: faster ones take more steps.
inline constexpr double max_approach_in_gaps = 0.75;
/// And turn by so little that their normals at both ends tell how close they come. [rad]
inline constexpr double max_turn = 0.35;
/// Of a substep.
inline constexpr int max_pieces = 64;

/// Where cloth may be during a substep.
class ClothReach {
 public:
  ClothReach() = default;
  /// @param size  n: samples a side of the largest cloth to come
  explicit ClothReach(int size);
  /// What a cloth sweeps as it flies on, and somewhat more, as a whole and block by block of its
  /// image. @param padding  [m]
  void place(const ClothState& cloth, double seconds, double padding) noexcept;
  [[nodiscard]] const Box3d& whole() const { return whole_; }
  [[nodiscard]] bool meets(const Box3d& box) const noexcept;

 private:
  Box3d whole_;
  std::vector<Box3d> blocks_;
};

/// A body's surface in a substep.
struct BodyStep {
  const Planes3 &start, &end;           ///< [n x n] [m]
  std::span<const Triangle> triangles;  ///< by samples that stand for their classes
};

/// Into how many pieces, of equal length, a body asks a substep to be split: so that wherever its
/// way comes near cloth it comes no more than `max_approach_in_step` closer, or leaves no farther,
/// along its normals. What slides past cloth asks for nothing but not to turn too far at once.
/// @param motion  a place to work in
double wanted_subdivisions(const BodyStep& body, const ClothReach& cloth,
                           double max_approach_in_step, SurfaceMotion& motion,
                           ThreadTeam& team) noexcept;

/// The least power of 2 that is no less, up to max_pieces.
int whole_subdivisions(double wanted) noexcept;

}  // namespace weft
