#pragma once

#include <array>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/contacts/surface_motion.h"

namespace weft {

/// Motion of a body in a step by blocks of its image, so that what is near one part does not depend
/// on the speed of another.
class BlockMotion {
 public:
  /// Cells a side of a block.
  static constexpr int block_size = 8;

  /// Motion of the parts of a body near a place: their mean displacement, and the most that any of
  /// them approaches a point that moves by it. [m]
  struct Near {
    Vec3d displacement;
    double approach = 0;
  };
  /// A block's samples, with the first ones of the next blocks, so that nothing lies between
  /// blocks.
  struct Block {
    int first_row = 0, last_row = 0, first_col = 0, last_col = 0;
    Box3f swept;             ///< [m]
    float approach = 0;      ///< largest of a sample, see SurfaceMotion; without one, its way [m]
    float turn = 0;          ///< the same [rad]
    Vec3f displacement;      ///< mean [m]
    float apart = 0;         ///< largest approach of a sample to a point that moves by the mean [m]
    Vec3f normal;            ///< mean
    float normal_apart = 0;  ///< largest deviation of a sample's normal
    float slant = 0;         ///< largest of a sample
  };

  /// Measures the blocks.
  /// @param grid  kept by pointer
  /// @param start, end  [n x n] kept by pointer [m]
  /// @param slides  motion of its surface, kept by pointer, if the approach along normals counts;
  /// null: each sample counts by its whole displacement
  void measure(const SurfaceGrid& grid, const Planes3& start, const Planes3& end,
               const SurfaceMotion* slides, ThreadTeam& team);
  /// Motion of all blocks that come within `reach` [m] of a box during the step.
  /// @param enough  an approach below which no sharper bound is sought [m]
  /// @param list    scratch space
  [[nodiscard]] Near near(const Box3f& box, float reach, double enough,
                          std::vector<int>& list) const;
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }
  /// Largest displacement, and largest approach, of a sample. [m]
  [[nodiscard]] double max_moved() const { return max_moved_; }
  [[nodiscard]] double max_approach() const { return max_approach_; }
  /// Motion along normals; null where each sample counts by its whole displacement.
  [[nodiscard]] const SurfaceMotion* surface() const { return slides_; }
  [[nodiscard]] const SurfaceGrid& grid() const { return *grid_; }
  [[nodiscard]] const Planes3& start() const { return *start_; }
  [[nodiscard]] const Planes3& end() const { return *end_; }

 private:
  /// Scratch space of a worker: values for each column of a row of blocks.
  struct Columns;
  void set_up(int size);
  void measure_row(const MotionKernels& kernels, int row, Columns& columns);
  void reduce(const Columns& columns, Block& block) const;
  void part(const MotionKernels& kernels, int first, int last, Columns& columns);
  [[nodiscard]] MotionBlock samples_of(const Block& block) const;
  [[nodiscard]] double approach_of(const Block& block, Vec3f displacement) const;

  const MotionKernels* kernels_ = nullptr;
  const SurfaceGrid* grid_ = nullptr;
  const Planes3 *start_ = nullptr, *end_ = nullptr;
  const SurfaceMotion* slides_ = nullptr;
  int blocks_a_side_ = 0;
  std::vector<Block> blocks_;
  std::array<std::vector<float>, 3> lower_, upper_;  // of the blocks' boxes, in sixteens [m]
  std::vector<float> no_normals_, all_slant_;        // [n] zeros and ones
  std::vector<std::vector<float>> scratch_;          // of each worker
  std::vector<float> row_moved_;                     // of each row of blocks
  double max_moved_ = 0, max_approach_ = 0;
};

}  // namespace weft
