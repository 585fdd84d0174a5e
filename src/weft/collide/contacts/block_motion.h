#pragma once

#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/contacts/surface_motion.h"
#include "weft/collide/moving_surface.h"

namespace weft {

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
