#pragma once

#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/contacts/surface_motion.h"
#include "weft/collide/moving_surface.h"

namespace weft {

/// How the parts of a body move in a step, by blocks of its image, so that what is near one part
/// need not care how fast another goes.
class BlockMotion {
 public:
  /// Samples a side of a block.
  static constexpr int block_size = 8;

  /// How what is near a place moves: a way that it has in common, and how much closer any of it
  /// comes, at most, to what goes along with that. [m]
  struct Near {
    Vec3d displacement;
    double approach = 0;
  };

  /// All are kept by reference. @param start, end  [n x n] [m]
  /// @param slides  its surface, where that is followed; null: each point counts by its whole way
  void measure(const SurfaceGrid& grid, const Planes3& start, const Planes3& end,
               const SurfaceMotion* slides, ThreadTeam& team);
  /// Of all that comes within `reach` [m] of a box on its way.
  /// @param enough  an approach that need not be known better [m]
  [[nodiscard]] Near near(const Box3f& box, float reach, double enough) const;

 private:
  struct Block {
    Box3f swept;
    Vec3d displacement;  // mean
    double samples = 0;
    double apart = 0;         // approach of any point to what goes that way, at most [m]
    Vec3d normal;             // mean
    double normal_apart = 0;  // of any point, at most
    double slant = 0;         // see SurfaceMotion::approach, the largest
    int first_row = 0, last_row = 0, first_col = 0, last_col = 0;
  };
  [[nodiscard]] Vec3d displacement_of(int sample) const {
    return vec_cast<double>(end_->at(sample)) - vec_cast<double>(start_->at(sample));
  }
  template <class Visit>
  void for_points(const Block& block, const Visit& visit) const;
  void measure(Block& block) const;
  [[nodiscard]] double approach_of_point(int point, Vec3d displacement) const;
  /// At most, at once; and by every point.
  [[nodiscard]] double bound_of(const Block& block, Vec3d displacement) const;
  [[nodiscard]] double approach_of(const Block& block, Vec3d displacement) const;

  const SurfaceGrid* grid_ = nullptr;
  const Planes3 *start_ = nullptr, *end_ = nullptr;
  const SurfaceMotion* slides_ = nullptr;
  std::vector<Block> blocks_;
};

}  // namespace weft
