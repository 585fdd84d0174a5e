#pragma once

#include <array>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/collide/contacts/contact_body.h"
#include "weft/collide/kernels/body_kernels.h"

namespace weft {

/// Lower bounds of the distances of a cloth's samples from a body, which hold for as long as
/// neither moves that far. What of the body is near a block of samples gives that block a
/// displacement and an approach, see BlockMotion; both add up over steps, and a sample's bound
/// shrinks by how far it moved other than by the displacement, and by the approach.
class KnownDistances {
 public:
  /// @param size  n: samples a side of the cloth
  /// @param gap   kept between cloth and body [m]
  KnownDistances(int size, double gap);

  /// Takes the motion of a body in a step, unless it is known.
  void begin(const MovingCloth& cloth, const ContactBody& body, ThreadTeam& team);
  /// Accepts a motion: the body stays at its end.
  void arrive(int motion);

  /// Scratch space of a worker.
  using Scratch = std::vector<float>;
  [[nodiscard]] Scratch make_scratch() const;
  /// A cloth that looks for the body in a step.
  struct Look {
    const Planes3 &start, &end;  ///< of its samples [m]
    const ContactBody& body;
    double margin;  ///< how near is of interest [m]
    const BodyKernels& kernels;
  };
  /// How far the samples of a row have to look for the body so that they find it wherever they may
  /// come within the margin in the step; 0 where it is farther. [m]
  /// @param reach  [n] out
  void find_reaches(const Look& look, int row, Scratch& scratch, float* reach);
  /// What a search from a sample's start found.
  struct Found {
    double distance = 0;  ///< nothing of the body is nearer [m]
    int triangle = -1;    ///< the closest one; -1: none was found
    double others = 0;    ///< no other triangle is nearer [m]
  };
  void set(int sample, Vec3f start, const Found& found);
  /// A distance up to which the triangle that was last closest to a sample is certainly closest
  /// yet; 0 where that is not known, or not likely. [m]
  [[nodiscard]] double closest_up_to(int sample, Vec3f start) const;

  /// The triangle that was last found to be closest to a sample; -1: none was.
  [[nodiscard]] int triangle(int sample) const { return triangles_[sample]; }
  /// How far to search for a sample that has to look as far as `reach`: farther, so that the steps
  /// to come can use what was found. [m]
  [[nodiscard]] double search_reach(double reach) const;
  /// Motion of what of the body is near a sample.
  [[nodiscard]] const BlockMotion::Near& near(int sample) const {
    return blocks_[block_of(sample)].now;
  }

 private:
  /// Motion of the body near a block of the cloth: summed over past steps, and in this one. [m]
  struct Block {
    Vec3d carried;
    double travelled = 0;
    BlockMotion::Near now;
  };
  [[nodiscard]] std::size_t block_of(int sample) const;
  [[nodiscard]] Box3f box_of_block(const Planes3& at, int block) const;

  int size_, blocks_a_side_;
  double gap_;
  std::vector<Block> blocks_;
  std::vector<std::vector<int>> lists_;  // of each worker, scratch
  int motion_ = 0;                       // to which the blocks' `now` belongs
  Planes3 place_, seen_;                 // start less `carried`, and start, when last looked at [m]
  Grid<float> travelled_;                // Block::travelled then [m]
  Grid<float> distance_;                 // at least; 0: unknown [m]
  Grid<float> others_;                   // see Found [m]
  std::vector<int> triangles_;           // [n * n]
};

}  // namespace weft
