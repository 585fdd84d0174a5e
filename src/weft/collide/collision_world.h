#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/coherent_pairs.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/body_contacts.h"
#include "weft/collide/contacts/surface_motion.h"

namespace weft {

/// A cloth as collision knows it all through a run.
struct WorldCloth {
  SurfaceGrid grid;
  CollidingCloth properties;
  int first_point = 0;                          ///< its samples are points from there on
  std::unique_ptr<BodyContacts> body_contacts;  ///< remembers which samples are inside of bodies
};

/// A body, and where it goes in a step.
struct WorldBody {
  SurfaceGrid grid;
  std::unique_ptr<BodyQuery> query;
  std::unique_ptr<BodyQuery> query_at_end;  ///< where it went far in some step
  Planes3 start;                            ///< where the last step left it
  const Planes3* end = nullptr;             ///< of this step; start where it stands still
  double friction = 0;
  double max_moved = 0;               ///< by any sample in this step [m]
  double max_approach = 0;            ///< see ContactBody [m]
  std::vector<Triangle> triangles{};  ///< by points
  SurfaceMotion surface{};            ///< of this step, where it goes far
  BlockMotion blocks{};               ///< of this step, where it moves
  bool goes_far = false;              ///< in this step
  bool moved = true;                  ///< since its query was placed
  int motion = 1;                     ///< see MovingSurface::name
  int end_placed = 0;                 ///< the motion whose end query_at_end stands at
};

/// All that collides, which the stages of the contact pipeline share: the broad phase, contacts,
/// the response, the filter, untangling. Samples of all cloths are numbered through as points.
class CollisionWorld {
 public:
  using MakeBroadPhase = std::unique_ptr<BroadPhase> (*)(std::span<const SurfaceGrid* const> grids,
                                                         std::size_t cloths);
  CollisionWorld(MakeBroadPhase make_broad_phase, const Obstacles& obstacles,
                 std::span<const CollidingCloth> given);

  // A step, see Collider.
  void move_bodies(std::span<const Planes3* const> ends, ThreadTeam& team);
  void commit();
  void rollback();

  /// Takes the proposals of a step, in which bodies go where move_bodies said.
  void gather_surfaces(std::span<const MovingCloth> moving);
  /// Fits the broad phase to them.
  void refit(ThreadTeam& team);
  /// Bodies for searches of contacts, where the step starts.
  void place_bodies(ThreadTeam& team);
  /// Every cloth's samples get what their representatives have.
  void copy_to_mates(std::span<const MovingCloth> moving) const;

  /// That is kept between two cloths, or one and itself. [m]
  [[nodiscard]] double gap_between(std::size_t i, std::size_t j) const;
  /// Cells of theirs that may press on each other, valid until the next search.
  std::span<const CandidatePair> near_cells(std::size_t i, std::size_t j, ThreadTeam& team);
  /// Of any sample of a body in this step; 0 where all stand still. [m/s]
  [[nodiscard]] double fastest_body(double time_step) const;
  [[nodiscard]] const BodyContacts::Ground* ground() const { return ground_ ? &*ground_ : nullptr; }
  [[nodiscard]] CoherentPairs& pairs() { return *pairs_; }
  /// How far the filter may move a point aside before the rest has to be looked at again, and in
  /// its first rounds. [m]
  [[nodiscard]] double slack() const { return slack_; }
  [[nodiscard]] double max_aside() const { return max_aside_; }
  /// Samples of all cloths.
  [[nodiscard]] int points() const { return static_cast<int>(cloth_of_.size()); }
  [[nodiscard]] std::size_t cloth_of(int point) const { return cloth_of_[point]; }

  std::vector<WorldCloth> cloths;
  std::vector<WorldBody> bodies;
  // Of one step:
  std::vector<MovingSurface> surfaces;  ///< cloths, then bodies
  std::vector<ContactBody> contact_bodies;

 private:
  void measure_motion(WorldBody& body, ThreadTeam& team) const;
  /// Whether there is anything for the broad phase to find.
  [[nodiscard]] bool needs_boxes() const;

  std::optional<BodyContacts::Ground> ground_;
  std::optional<CoherentPairs> pairs_;
  double slack_ = HUGE_VAL, max_aside_ = HUGE_VAL;
  double min_gap_ = HUGE_VAL;  // that is kept to bodies by any cloth [m]
  std::vector<std::size_t> cloth_of_;
};

}  // namespace weft
