#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "weft/collide/broad_phase/coherent_pairs.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/body_contacts.h"
#include "weft/collide/contacts/contact_response.h"
#include "weft/collide/contacts/corner_contacts.h"
#include "weft/collide/contacts/pair_contacts.h"
#include "weft/collide/contacts/surface_motion.h"
#include "weft/collide/filter/cell_planes.h"
#include "weft/collide/filter/impact.h"
#include "weft/collide/filter/safe_positions.h"
#include "weft/collide/filter/separating_plane_filter.h"
#include "weft/collide/untangle/untangler.h"

namespace weft {

/// The collider that keeps its promise: contacts for the solve, a response that pushes out and
/// holds by friction, and at the end of a step planes between all that came near, which nothing
/// passes. Broad phases may differ.
class ContactPipeline final : public Collider {
 public:
  using MakeBroadPhase = std::unique_ptr<BroadPhase> (*)(std::span<const SurfaceGrid* const> grids,
                                                         std::size_t cloths);
  ContactPipeline(MakeBroadPhase make_broad_phase, const Obstacles& obstacles,
                  std::span<const CollidingCloth> cloths);

  void move_bodies(std::span<const Planes3* const> ends, ThreadTeam& team) noexcept override;
  void detect(std::span<const MovingCloth> cloths, double time_step,
              ThreadTeam& team) noexcept override;
  [[nodiscard]] std::span<const Contact> contacts(std::size_t cloth) const noexcept override {
    return cloths_[cloth].contacts;
  }
  [[nodiscard]] std::span<const Contact> obstacle_contacts(
      std::size_t cloth) const noexcept override {
    return std::span(cloths_[cloth].contacts).first(cloths_[cloth].obstacle_contacts);
  }
  void share_contacts(bool shared) noexcept override { shares_ = shared; }
  [[nodiscard]] std::span<const SharedContact> shared_contacts() const noexcept override {
    return shared_;
  }
  [[nodiscard]] bool anything_near() const noexcept override { return near_; }
  int filter_guess(std::span<const MovingCloth> cloths, double time_step,
                   ThreadTeam& team) noexcept override;
  int correct(std::size_t cloth, const MovingCloth& moving, std::span<const float> forces,
              double time_step, ThreadTeam& team) noexcept override;
  FilterCounts filter(std::span<const MovingCloth> cloths, double time_step,
                      ThreadTeam& team) noexcept override;
  void commit() noexcept override;
  void forget() noexcept override {
    pairs_->forget();
    may_pass_ = may_pass_then_ = {true, true};
  }
  void rollback() noexcept override;
  void save_marks(std::size_t cloth, std::vector<int>& marks) const override;
  void restore_marks(std::size_t cloth, std::span<const int> marks) override;
  [[nodiscard]] int self_contacts() const noexcept override { return self_contacts_; }
  [[nodiscard]] int crossings() const noexcept override { return untangler_.crossings(); }
  double smallest_gap(std::size_t cloth, const Planes3& positions,
                      ThreadTeam& team) noexcept override;

 private:
  struct PipelineCloth {
    SurfaceGrid grid;
    CollidingCloth properties;
    std::unique_ptr<BodyContacts> body_contacts;
    std::unique_ptr<CornerContacts> corner_contacts;
    ContactResponse response;
    std::vector<Contact> contacts;  // those with obstacles first
    int first_point = 0;
    std::vector<double> row_gaps;
    std::vector<char> new_cells{};           // of a round, see PlaneSide
    Planes3 carried{};                       // refuges among moving bodies
    const Planes3* safe_position = nullptr;  // of this step; the start while that will do
    std::size_t obstacle_contacts = 0;
  };
  struct PipelineBody {
    SurfaceGrid grid;
    std::unique_ptr<BodyQuery> query;
    std::unique_ptr<BodyQuery> query_at_end;  // where it went far in some step
    Planes3 start;                            // where the last step left it
    const Planes3* end = nullptr;             // of this step; start where it stands still
    double friction = 0;
    double max_moved = 0;               // by any sample in this step [m]
    double max_approach = 0;            // see ContactBody [m]
    std::vector<Triangle> triangles{};  // by points
    SurfaceMotion surface{};            // of this step, where it goes far
    BlockMotion blocks{};               // of this step, where it moves
    bool goes_far = false;              // in this step
    bool moved = true;                  // since its query was placed
    int motion = 1;                     // see MovingSurface::name
    int end_placed = 0;                 // the motion whose end query_at_end stands at
  };
  void learn_corners(const Obstacles& obstacles);
  void gather_surfaces(std::span<const MovingCloth> cloths);
  void place_bodies(ThreadTeam& team);
  void measure_motion(PipelineBody& body, ThreadTeam& team) const;
  /// That is kept between two cloths, or one and itself. [m]
  [[nodiscard]] double gap_between(std::size_t i, std::size_t j) const;
  /// Cells of theirs that may press on each other, valid until the next search.
  std::span<const CandidatePair> near_cells(std::size_t i, std::size_t j, ThreadTeam& team);
  void find_tangles(std::span<const MovingCloth> cloths, ThreadTeam& team);
  void find_pair_contacts(std::span<const MovingCloth> cloths, double time_step, ThreadTeam& team);
  /// Whether there is anything for the broad phase to find.
  [[nodiscard]] bool needs_boxes() const;
  static void copy_to_mates(const PipelineCloth& one, const MovingCloth& moving);
  /// Those of the last round stay where the ends of all their points did; unless all are wanted.
  void find_planes(bool all, ThreadTeam& team);
  /// Between what comes closer than that. [m]
  void add_planes(bool all, double farthest, ThreadTeam& team);
  void drop_old_planes();
  void mark_new_cells();
  void put_end(const MovingCloth& cloth, int point, Vec3f end);
  void add_ground_planes(std::span<const MovingCloth> cloths);
  /// What a pass of the filter over a step's proposals is for.
  enum class Pass { guess, end };
  /// Of each, whether all might pass yet in this frame; and at the step's start.
  std::array<bool, 2> may_pass_{true, true}, may_pass_then_{true, true};
  FilterCounts hold_all(std::span<const MovingCloth> cloths, double time_step, Pass pass,
                        ThreadTeam& team);
  [[nodiscard]] FilteredPoint point_at(std::span<const MovingCloth> cloths, int point) const;
  bool all_pass(std::span<const MovingCloth> cloths, ThreadTeam& team);
  SeparatingPlaneFilter::Result hold(std::span<const MovingCloth> cloths, double farthest,
                                     ThreadTeam& team);
  /// Puts the points that were stopped, and those around them, at their refuges; or all.
  void fall_back_to_safe_positions(std::span<const MovingCloth> cloths, int around, bool all);
  /// Lets both sides of the planes that points were held back by strike each other.
  void strike_all(std::span<const MovingCloth> cloths, double time_step);
  [[nodiscard]] ImpactSides sides_of(const SeparatingPlane& plane,
                                     std::span<const MovingCloth> cloths) const;
  void put_velocities(const SeparatingPlane& plane, const ImpactSides& sides,
                      std::span<const MovingCloth> cloths) const;
  [[nodiscard]] FilterCounts count_fates() const;
  /// @param spread  how far the bodies' ways reach, in rest spacings
  void carry_safe_positions(std::span<const MovingCloth> cloths, double spread, ThreadTeam& team);
  /// Of any sample of a body in this step; 0 where all stand still. [m/s]
  [[nodiscard]] double fastest_body(double time_step) const;
  [[nodiscard]] PlaneSide side_of(std::size_t surface) const;

  std::vector<PipelineCloth> cloths_;
  std::vector<PipelineBody> bodies_;
  std::optional<BodyContacts::Ground> ground_;
  std::optional<CoherentPairs> pairs_;
  int points_ = 0;                    // samples of all cloths
  double slack_ = 0, max_aside_ = 0;  // see SeparatingPlaneFilter [m]
  double min_gap_ = 0;                // that is kept to bodies by any cloth [m]
  int self_contacts_ = 0;
  bool carried_ = false;  // refuges go along with bodies in this step
  bool near_ = false;     // see anything_near
  bool shares_ = false;   // see share_contacts
  // Of one step:
  std::vector<MovingSurface> surfaces_;  // cloths, then bodies
  std::vector<ContactBody> contact_bodies_;
  std::vector<SharedContact> shared_;
  std::vector<SeparatingPlane> planes_;
  std::vector<std::size_t> cloth_of_;  // [points]
  std::vector<char> fates_;            // [points] of one pass: free, moved, stopped, fell back
  std::vector<char> new_points_;       // [points] of a round, see PlaneSearch
  std::size_t ground_planes_ = 0;      // where those begin in planes_
  PairContacts pair_contacts_;
  CellPlanes cell_planes_;
  SeparatingPlaneFilter plane_filter_;
  SafePositions safe_positions_;
  Untangler untangler_;
};

/// The pipeline with a broad phase of that kind.
template <class Pairs>
std::unique_ptr<Collider> make_pipeline(const Obstacles& obstacles,
                                        std::span<const CollidingCloth> cloths) {
  return std::make_unique<ContactPipeline>(
      [](std::span<const SurfaceGrid* const> grids, std::size_t count)
          -> std::unique_ptr<BroadPhase> { return std::make_unique<Pairs>(grids, count); },
      obstacles, cloths);
}

}  // namespace weft
