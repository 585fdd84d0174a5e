#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/collision_world.h"
#include "weft/collide/filter/cell_planes.h"
#include "weft/collide/filter/common_motion.h"
#include "weft/collide/filter/impact.h"
#include "weft/collide/filter/safe_positions.h"
#include "weft/collide/filter/separating_plane_filter.h"
#include "weft/collide/untangle/untangler.h"

namespace weft {

/// The last stage that changes positions in a step: finds separating planes between all features
/// that came near and moves points to their sides, in rounds until no point moves. Points that
/// cannot be freed so go back to safe positions.
class StepFilter {
 public:
  /// @param world, untangler  kept by reference
  StepFilter(CollisionWorld& world, const Untangler& untangler);

  /// Purpose of a pass over a step's proposals.
  enum class Pass {
    guess,  ///< start of a solve: marks and velocities stay
    end     ///< end of the step: impacts change velocities
  };
  FilterCounts run(std::span<const MovingCloth> moving, double time_step, Pass pass,
                   ThreadTeam& team, FilterEnd end = FilterEnd::whole);

  /// Planes of the last run that moved points, where it ended a step.
  [[nodiscard]] std::span<const SeparatingPlane> struck() const { return struck_; }

  void commit() { may_pass_then_ = may_pass_; }
  void rollback() { may_pass_ = may_pass_then_; }
  void forget() { may_pass_ = may_pass_then_ = {true, true}; }

 private:
  /// State of one cloth during a run.
  struct Filtered {
    std::vector<char> new_cells{};           // of a round, see PlaneSide
    Planes3 carried{};                       // safe positions other than the start
    const Planes3* safe_position = nullptr;  // the start, or `carried`
  };
  void begin(std::span<const MovingCloth> moving);
  bool all_pass(std::span<const MovingCloth> moving, ThreadTeam& team);
  /// One round: finds planes and moves points by them.
  /// @return whether nothing is left to do
  bool do_round(std::span<const MovingCloth> moving, double time_step, Pass pass, int round,
                ThreadTeam& team);

  [[nodiscard]] PlaneSide side_of(std::size_t surface) const;
  [[nodiscard]] FilteredPoint point_at(std::span<const MovingCloth> moving, int point) const;
  void put_end(const MovingCloth& cloth, int point, Vec3f end);
  /// Finds the planes of a round. Unless all are wanted, planes of the last round are kept where
  /// the ends of all their points are unchanged.
  void find_planes(bool all, ThreadTeam& team);
  /// Adds planes between features that come closer than `farthest`. [m]
  void add_planes(bool all, double farthest, ThreadTeam& team);
  void add_ground_planes(std::span<const MovingCloth> moving);
  void drop_old_planes();
  void mark_new_cells();

  SeparatingPlaneFilter::Result hold(std::span<const MovingCloth> moving, double farthest,
                                     ThreadTeam& team);
  SeparatingPlaneFilter::Result find_ends(std::span<const MovingCloth> moving, double farthest,
                                          ThreadTeam& team);
  /// The same with other safe positions than before.
  SeparatingPlaneFilter::Result find_ends_anew(std::span<const MovingCloth> moving, double farthest,
                                               ThreadTeam& team);
  /// Applies inelastic impacts to both sides of the planes that held points back.
  void strike_all(std::span<const MovingCloth> moving, double time_step);
  [[nodiscard]] ImpactSides sides_of(const SeparatingPlane& plane,
                                     std::span<const MovingCloth> moving) const;
  void put_velocities(const SeparatingPlane& plane, const ImpactSides& sides,
                      std::span<const MovingCloth> moving) const;
  /// @param spread  how far the bodies' motion reaches, in rest spacings
  void carry_safe_positions(std::span<const MovingCloth> moving, double spread, ThreadTeam& team);
  /// Safe positions that go along with cloths that move as wholes. @pre no body moves
  /// @return whether any does
  bool take_safe_positions_along(std::span<const MovingCloth> moving, ThreadTeam& team);
  void return_safe_positions(std::span<const MovingCloth> moving);
  /// Puts stopped points, and those within `around` samples of them, at their safe positions; or
  /// all points.
  void fall_back_to_safe_positions(std::span<const MovingCloth> moving, int around, bool all);
  [[nodiscard]] bool has_fallen() const;
  [[nodiscard]] FilterCounts count_fates() const;

  CollisionWorld& world_;
  const Untangler& untangler_;
  std::vector<Filtered> cloths_;
  /// Per pass, whether no run has had to move points yet in this frame; and the same at the step's
  /// start.
  std::array<bool, 2> may_pass_{true, true}, may_pass_then_{true, true};
  std::vector<SeparatingPlane> planes_;
  std::vector<SeparatingPlane> struck_;
  std::size_t ground_planes_ = 0;  // index of the first ground plane in planes_
  std::vector<char> fates_;        // [points] of one run: free, moved, stopped, fell back
  std::vector<char> new_points_;   // [points] of a round, see PlaneSearch
  bool carried_ = false;           // safe positions go along with bodies in this run
  bool along_ = false;             // safe positions go along with cloth
  bool may_go_along_ = false;      // they have not been tried to in this run
  bool all_anew_ = false;          // the next round finds all its planes anew
  double spread_ = 0;              // of the bodies' motion, in rest spacings
  CellPlanes cell_planes_;
  SeparatingPlaneFilter plane_filter_;
  SafePositions safe_positions_;
  CommonMotion common_motion_;
};

}  // namespace weft
