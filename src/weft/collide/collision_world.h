#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/coherent_pairs.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/collide/contacts/body_contacts.h"
#include "weft/collide/contacts/body_crossings.h"

namespace weft {

/// Collision data of a cloth that last for the whole run.
struct WorldCloth {
  SurfaceGrid grid;
  CollidingCloth properties;
  int first_point = 0;                          ///< number of its sample 0 among all points
  std::unique_ptr<BodyContacts> body_contacts;  ///< with the samples' inside marks
  std::vector<BodyCrossings> crossings{};       ///< with each body
};

/// A body and its motion in a step.
struct WorldBody {
  SurfaceGrid grid;
  std::unique_ptr<BodyQuery> query;
  std::unique_ptr<BodyQuery> query_at_end;  ///< made once it has gone far in a step
  Planes3 start;                            ///< where the last step left it
  const Planes3* end = nullptr;             ///< of this step; start where it stands still
  double friction = 0;
  double max_moved = 0;                      ///< largest displacement of a sample in this step [m]
  std::unique_ptr<SurfaceMotion> surface{};  ///< made once it has gone far
  BlockMotion blocks{};                      ///< of this step, where it moves
  bool goes_far = false;                     ///< in this step
  bool moved = true;                         ///< since its query was placed
  std::vector<char> buried{};                ///< see ContactBody
  int motion = 1;                            ///< see MovingSurface::name
  int placement = 1;                         ///< see ContactBody
  int end_placed = 0;                        ///< motion at whose end query_at_end is placed

  [[nodiscard]] bool moves() const { return end != &start; }
};

/// Cloths, bodies and ground of a scene with their broad phase, shared by the stages of the contact
/// pipeline: contacts, response, filter and untangling. Samples of all cloths are numbered
/// consecutively as points.
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
  /// See Collider.
  void bury(std::size_t body, std::span<const char> samples);

  /// Sets the surfaces of a step: cloths by their proposals, bodies by move_bodies.
  void gather_surfaces(std::span<const MovingCloth> moving);
  /// Fits the broad phase to the surfaces of the step.
  void refit(ThreadTeam& team);
  /// Places the bodies' queries for contact search at the start of the step, and at its end where
  /// bodies go far.
  void place_bodies(ThreadTeam& team);
  /// Finds the triangles of cloths that cross closed bodies at the start of the step.
  void find_crossings(std::span<const MovingCloth> moving, ThreadTeam& team);
  /// Copies positions and velocities of representatives to their mates.
  void copy_to_mates(std::span<const MovingCloth> moving) const;

  /// Gap kept between two cloths, or between a cloth and itself. [m]
  [[nodiscard]] double gap_between(std::size_t i, std::size_t j) const;
  /// Candidate cell pairs of two cloths within the contact margin, valid until the next search.
  std::span<const CandidateTile> near_cells(std::size_t i, std::size_t j, ThreadTeam& team);
  /// Motion of a body in this step; null where it stands still.
  [[nodiscard]] const BlockMotion* motion_of(std::size_t body) const {
    return bodies[body].moves() ? &bodies[body].blocks : nullptr;
  }
  /// Largest speed of a body's sample in this step; 0 where all bodies stand still. [m/s]
  [[nodiscard]] double fastest_body(double time_step) const;
  [[nodiscard]] const BodyContacts::Ground* ground() const { return ground_ ? &*ground_ : nullptr; }
  [[nodiscard]] CoherentPairs& pairs() { return *pairs_; }
  /// Largest displacement by the filter that needs no new search of planes, and the largest allowed
  /// in its first rounds. [m]
  [[nodiscard]] double slack() const { return slack_; }
  [[nodiscard]] double max_aside() const { return max_aside_; }
  /// Number of samples of all cloths.
  [[nodiscard]] int points() const { return static_cast<int>(cloth_of_.size()); }
  [[nodiscard]] std::size_t cloth_of(int point) const { return cloth_of_[point]; }

  std::vector<WorldCloth> cloths;
  std::vector<WorldBody> bodies;
  // Of one step:
  std::vector<MovingSurface> surfaces;  ///< cloths, then bodies
  std::vector<ContactBody> contact_bodies;

 private:
  void measure_motion(WorldBody& body, ThreadTeam& team) const;
  static void stand_still(WorldBody& body);
  static bool take_query_over(WorldBody& body);
  /// Whether there is anything for the broad phase to find.
  [[nodiscard]] bool needs_boxes() const;

  std::optional<BodyContacts::Ground> ground_;
  std::optional<CoherentPairs> pairs_;
  double slack_ = HUGE_VAL, max_aside_ = HUGE_VAL;
  double min_gap_ = HUGE_VAL;  // smallest gap that a cloth keeps to bodies [m]
  std::vector<std::size_t> cloth_of_;
};

}  // namespace weft
