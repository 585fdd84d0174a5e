#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// Motion of a body's surface in a step along its normals, as obstacles before it meet it. Normals
/// are means over the triangles around a point, weighted by area: slivers, as images have some,
/// count little.
class SurfaceMotion {
 public:
  /// Measures all points.
  /// @param start, end  [n x n] [m]
  /// @param triangles  corners as representative samples
  void measure(const Planes3& start, const Planes3& end, std::span<const Triangle> triangles,
               ThreadTeam& team);
  /// Approach of a point: the absolute value of its displacement along the mean of its normals at
  /// both ends. A surface that slides along itself, as a ball that turns in place, has none. [m]
  [[nodiscard]] double approach(int sample) const { return points_[sample].approach; }
  /// Approach of a point to one that moves by `displacement`, with what the slant of the triangles
  /// around it may add as they slide past. [m]
  [[nodiscard]] double approach(int sample, Vec3d displacement) const;
  /// Rotation of a point's normal in the step: nearly the angle, as long as it is small. [rad]
  [[nodiscard]] double turn(int sample) const { return points_[sample].turn; }
  /// Mean of a point's normals at both ends, not unit.
  [[nodiscard]] Vec3d normal(int sample) const { return points_[sample].normal; }
  /// Slant of the triangles around a point against its normal: the part of a sliding displacement
  /// by which they may approach.
  [[nodiscard]] double slant(int sample) const { return points_[sample].slant; }

 private:
  struct Areas {
    Vec3d from, to;
    double size = 0;  // of `from`, or of those that were summed
  };
  struct Point {
    Vec3d displacement, normal;  // the mean of both ends'
    double approach = 0, turn = 0;
    double slant = 0;  // sine of the triangles' tilt against it, twice the root mean square
  };
  std::vector<Areas> triangles_;  // twice the area along the normal
  std::vector<Areas> sums_;       // [n * n]
  std::vector<Point> points_;     // [n * n]
};

/// Motion of a body in a step by blocks of its image, so that what is near one part does not depend
/// on the speed of another.
class BlockMotion {
 public:
  /// Samples a side of a block.
  static constexpr int block_size = 8;

  /// Motion of the parts of a body near a place: their mean displacement, and the most that any of
  /// them approaches a point that moves by it. [m]
  struct Near {
    Vec3d displacement;
    double approach = 0;
  };

  /// Measures the blocks. All arguments are kept by reference.
  /// @param start, end  [n x n] [m]
  /// @param slides  motion of its surface, if the approach along normals counts; null: each point
  /// counts by its whole displacement
  void measure(const SurfaceGrid& grid, const Planes3& start, const Planes3& end,
               const SurfaceMotion* slides, ThreadTeam& team);
  /// Motion of all blocks that come within `reach` [m] of a box during the step.
  /// @param enough  an approach below which no sharper bound is sought [m]
  [[nodiscard]] Near near(const Box3f& box, float reach, double enough) const;

 private:
  struct Block {
    Box3f swept;
    Vec3d displacement;  // mean
    double samples = 0;
    double apart = 0;         // largest approach of a point to one moved by `displacement` [m]
    Vec3d normal;             // mean
    double normal_apart = 0;  // largest deviation of a point's normal
    double slant = 0;         // largest of a point, see SurfaceMotion::slant
    int first_row = 0, last_row = 0, first_col = 0, last_col = 0;
  };
  [[nodiscard]] Vec3d displacement_of(int sample) const {
    return vec_cast<double>(end_->at(sample)) - vec_cast<double>(start_->at(sample));
  }
  template <class Visit>
  void for_points(const Block& block, const Visit& visit) const;
  void measure(Block& block) const;
  [[nodiscard]] double approach_of_point(int point, Vec3d displacement) const;
  /// Approach of a block to a point that moves by `displacement`: a quick upper bound, and the
  /// largest over all points. [m]
  [[nodiscard]] double bound_of(const Block& block, Vec3d displacement) const;
  [[nodiscard]] double approach_of(const Block& block, Vec3d displacement) const;

  const SurfaceGrid* grid_ = nullptr;
  const Planes3 *start_ = nullptr, *end_ = nullptr;
  const SurfaceMotion* slides_ = nullptr;
  std::vector<Block> blocks_;
};

}  // namespace weft
