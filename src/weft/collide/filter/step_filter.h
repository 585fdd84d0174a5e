#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/collision_world.h"
#include "weft/collide/filter/cell_planes.h"
#include "weft/collide/filter/impact.h"
#include "weft/collide/filter/safe_positions.h"
#include "weft/collide/filter/separating_plane_filter.h"
#include "weft/collide/untangle/untangler.h"

namespace weft {

/// The stage that has the last word on positions: planes between all that came near in a step, on
/// whose sides everything has to end, found anew until nothing moves any more. What it cannot free
/// so goes back to safe positions.
class StepFilter {
 public:
  /// @param world, untangler  kept by reference
  StepFilter(CollisionWorld& world, const Untangler& untangler);

  /// What a pass over a step's proposals is for.
  enum class Pass {
    guess,  ///< a solve starts there: nothing is remembered, velocities stay
    end     ///< the step ends there: what is stopped strikes what stopped it
  };
  FilterCounts run(std::span<const MovingCloth> moving, double time_step, Pass pass,
                   ThreadTeam& team);

  void commit() { may_pass_then_ = may_pass_; }
  void rollback() { may_pass_ = may_pass_then_; }
  void forget() { may_pass_ = may_pass_then_ = {true, true}; }

 private:
  /// Of one cloth, during a run.
  struct Filtered {
    std::vector<char> new_cells{};           // of a round, see PlaneSide
    Planes3 carried{};                       // safe positions among moving bodies
    const Planes3* safe_position = nullptr;  // the start while that will do
  };
  void begin(std::span<const MovingCloth> moving);
  bool all_pass(std::span<const MovingCloth> moving, ThreadTeam& team);
  /// Finds planes and holds points by them once. @return whether nothing is left to do
  bool do_round(std::span<const MovingCloth> moving, double time_step, Pass pass, int round,
                ThreadTeam& team);

  [[nodiscard]] PlaneSide side_of(std::size_t surface) const;
  [[nodiscard]] FilteredPoint point_at(std::span<const MovingCloth> moving, int point) const;
  void put_end(const MovingCloth& cloth, int point, Vec3f end);
  /// Those of the last round stay where the ends of all their points did; unless all are wanted.
  void find_planes(bool all, ThreadTeam& team);
  /// Between what comes closer than that. [m]
  void add_planes(bool all, double farthest, ThreadTeam& team);
  void add_ground_planes(std::span<const MovingCloth> moving);
  void drop_old_planes();
  void mark_new_cells();

  SeparatingPlaneFilter::Result hold(std::span<const MovingCloth> moving, double farthest,
                                     ThreadTeam& team);
  /// Lets both sides of the planes that points were held back by strike each other.
  void strike_all(std::span<const MovingCloth> moving, double time_step);
  [[nodiscard]] ImpactSides sides_of(const SeparatingPlane& plane,
                                     std::span<const MovingCloth> moving) const;
  void put_velocities(const SeparatingPlane& plane, const ImpactSides& sides,
                      std::span<const MovingCloth> moving) const;
  /// @param spread  how far the bodies' motion reaches, in rest spacings
  void carry_safe_positions(std::span<const MovingCloth> moving, double spread, ThreadTeam& team);
  /// Puts the points that were stopped, and those around them, at their safe positions; or all.
  void fall_back_to_safe_positions(std::span<const MovingCloth> moving, int around, bool all);
  [[nodiscard]] FilterCounts count_fates() const;

  CollisionWorld& world_;
  const Untangler& untangler_;
  std::vector<Filtered> cloths_;
  /// Of each pass, whether all might pass yet in this frame; and at the step's start.
  std::array<bool, 2> may_pass_{true, true}, may_pass_then_{true, true};
  std::vector<SeparatingPlane> planes_;
  std::size_t ground_planes_ = 0;  // where those begin in planes_
  std::vector<char> fates_;        // [points] of one run: free, moved, stopped, fell back
  std::vector<char> new_points_;   // [points] of a round, see PlaneSearch
  bool carried_ = false;           // safe positions go along with bodies in this run
  bool all_anew_ = false;          // the next round finds all its planes anew
  double spread_ = 0;              // of the bodies' motion, in rest spacings
  CellPlanes cell_planes_;
  SeparatingPlaneFilter plane_filter_;
  SafePositions safe_positions_;
};

}  // namespace weft
