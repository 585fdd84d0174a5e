#pragma once

#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/grid.h"
#include "weft/mesh.h"
#include "weft/simulation.h"
#include "weft/vec.h"

namespace weft {

/// How far a body may approach nearby cloth in a step; faster bodies take more steps. Contacts go
/// with bodies, and a step in which cloth would be passed is refused and halved, so that bodies
/// that carry cloth, as limbs do, take steps of some gaps. A fast one strikes it, and the longer
/// the steps, the more the blow stretches it.
struct ApproachRule {
  /// Gaps that bodies approach in a step at most: at up to calm_speed, and at any speed; in inverse
  /// proportion to the speed between.
  static constexpr double max_gaps = 3, min_gaps = 0.75;
  static constexpr double calm_speed = 3;  ///< [m/s]

  double gap = 0;      ///< the smallest [m]
  double seconds = 0;  ///< of the motion whose approach is told [s]

  /// Number of steps that an approach [m] asks for; not rounded.
  [[nodiscard]] double parts(double approach) const;
};

/// Largest rotation of a body's normals in a step, for which the normals at both ends tell the
/// approach. [rad]
inline constexpr double max_turn = 0.35;
/// Largest number of steps in a substep, for bodies of up to some hundred metres a second, and its
/// level. Collisions halve steps less often: StepLevels::deepest.
inline constexpr int finest_level = 10, max_subdivisions = 1 << finest_level;

/// Bounding boxes of the region that a cloth may reach during a substep.
class ClothReach {
 public:
  ClothReach() = default;
  /// @param size  n: samples a side of the largest cloth to come
  explicit ClothReach(int size);
  /// Sets the boxes, of the whole cloth and of blocks of its image, around positions and positions
  /// extrapolated by the velocities. @param padding  added on all sides [m]
  void place(const ClothState& cloth, double seconds, double padding) noexcept;
  [[nodiscard]] const Box3d& whole() const { return whole_; }
  [[nodiscard]] bool meets(const Box3d& box) const noexcept;

 private:
  static void widen(const float* position, const float* velocity, float seconds, int size,
                    float* lower, float* upper);
  void add_block(const float* lower, const float* upper, int col, int size, double padding);

  Box3d whole_;
  std::vector<Box3d> blocks_;
  std::vector<float> columns_;  // [6 x n] extents of the samples of a row of blocks, scratch [m]
};

/// Number of steps of equal length that a moving body requires of a substep: wherever its path is
/// near cloth, it approaches or recedes along its normals by no more than the rule allows in a
/// step, and its normals rotate by at most max_turn. Sliding past cloth requires no more.
/// @param motion  of the body in the substep
double wanted_subdivisions(const BlockMotion& motion, const ClothReach& cloth,
                           const ApproachRule& rule) noexcept;

/// Rounds up to a power of 2, at most max_subdivisions.
int whole_subdivisions(double wanted) noexcept;

/// Exponent of a power of 2.
constexpr int level_of(int subdivisions) {
  int level = 0;
  while (1 << level < subdivisions) ++level;
  return level;
}

/// Whether levels are consistent, so that a StepWalk can begin with them.
constexpr bool is_valid(const StepLevels& levels) {
  return levels.first >= 0 && levels.first <= levels.most && levels.most >= 1 &&
         levels.most <= StepLevels::deepest;
}

/// Verdict on a trial step.
enum class StepVerdict {
  calm,    ///< far from being refused
  near,    ///< accepted, but not calm
  forced,  ///< accepted only because it may not be halved
  fallen,  ///< the same, and points fell back to where the step began
};

/// Divides a substep into steps of changing levels, of length 2^-level: a refused step is replaced
/// by two halves; after calm steps the length doubles, up to that of the first step.
class StepWalk {
 public:
  /// @param least  smallest level, as moving bodies require; at most finest_level
  StepWalk(int least, const StepLevels& levels);

  [[nodiscard]] bool done() const { return done_ == whole; }
  [[nodiscard]] int subdivisions() const { return 1 << level_; }
  /// Number of steps of the current length before this one.
  [[nodiscard]] int index() const { return done_ >> (finest_level - level_); }
  [[nodiscard]] bool may_halve() const { return level_ < max_level_; }
  /// The same while seams are sewn: where cloth is caught between others at a seam that cannot
  /// close, every step is bad.
  [[nodiscard]] bool may_halve_sewn() const {
    return may_halve() && level_ < min_level_ + max_levels_sewn;
  }
  /// The same for a step in which points fall back while bodies move: the shorter, the less these
  /// push them, even where halving has not helped against other faults.
  [[nodiscard]] bool may_halve_fallen() const {
    return level_ < std::min(max_fallen_level_, finest_level);
  }
  /// The same for a step whose solve ran away, or that is wild: halving it is all that there is to
  /// be done.
  [[nodiscard]] bool may_halve_wild() const { return level_ < finest_level; }
  /// Whether the step is shorter than moving bodies require.
  [[nodiscard]] bool is_shortened() const { return level_ > min_level_; }
  /// Goes on at this level or a deeper one: a body is faster in a part of the substep than over the
  /// whole of it.
  void require(int level);
  void halve();
  void accept(StepVerdict verdict);
  /// Levels of the next substep: it begins at the last level of this one where steps were halved,
  /// and one level lower where all steps were calm.
  [[nodiscard]] StepLevels next(const StepLevels& levels) const;

 private:
  static constexpr int whole = max_subdivisions;
  static constexpr int max_levels_sewn = 2;  // beyond those that bodies require
  int min_level_, first_, level_, max_level_, max_fallen_level_;
  int done_ = 0;  // in units of the shortest step
  bool calm_ = true, forced_ = false, halved_ = false;
};

}  // namespace weft
