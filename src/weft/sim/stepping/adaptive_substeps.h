#pragma once

#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/collide/contacts/surface_motion.h"
#include "weft/grid.h"
#include "weft/mesh.h"
#include "weft/simulation.h"
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

/// Whether a walk can begin with them.
constexpr bool is_valid(const StepLevels& levels) {
  return levels.first >= 0 && levels.first <= levels.most && levels.most >= 1 &&
         levels.most <= StepLevels::deepest;
}

/// How a step was found that had been tried.
enum class StepVerdict {
  calm,    ///< far from being refused
  near,    ///< not refused
  forced,  ///< would have been refused if it might be halved
};

/// The way through a substep in steps of changing levels: a step that is refused is done as two
/// halves; what is done in calm steps goes on in longer ones, no longer than the first.
class StepWalk {
 public:
  /// @param least  level that what moves asks for
  StepWalk(int least, const StepLevels& levels);

  [[nodiscard]] bool done() const { return done_ == whole; }
  [[nodiscard]] int subdivisions() const { return 1 << level_; }
  /// Steps of the present length that come before this one.
  [[nodiscard]] int index() const { return done_ >> (StepLevels::deepest - level_); }
  [[nodiscard]] bool may_halve() const { return level_ < most_; }
  /// Whether the step is shorter than what moves asks for.
  [[nodiscard]] bool is_shortened() const { return level_ > least_; }
  void halve();
  void accept(StepVerdict verdict);
  /// Levels for the next substep: it begins where this one ended, one level longer if that was
  /// calm.
  [[nodiscard]] StepLevels next(const StepLevels& levels) const;

 private:
  static constexpr int whole = 1 << StepLevels::deepest;
  int least_, first_, level_, most_;
  int done_ = 0;  // in the shortest steps
  bool calm_ = true, forced_ = false, halved_ = false;
};

}  // namespace weft
