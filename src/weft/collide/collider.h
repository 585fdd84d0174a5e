#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "weft/colliders.h"
#include "weft/contact.h"
#include "weft/core/thread_team.h"
#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/image/diagonals.h"

namespace weft {

class BlockMotion;

/// A body as placed in the scene.
struct Body {
  Planes3 positions;  ///< [n x n] world [m]
  BorderMates mates;
  double friction = 0.4;
  Grid<Diagonal> diagonals{};  ///< [(n - 1) x (n - 1)]; empty: all rising
  /// Reference shape from which the body's sharp points are chosen, so that they do not depend on
  /// the frame at which a run was resumed; empty: the positions. [n x n] [m]
  Planes3 shape{};
};

/// Properties of a cloth that a collider needs.
struct CollidingCloth {
  const BorderMates& mates;
  int size = 0;                ///< n: samples a side
  Grid<Diagonal> diagonals{};  ///< as Body::diagonals
  double thickness = 0.002;    ///< gap kept to bodies and the ground [m]
  double friction = 0.4;       ///< of the cloth; of a pair: the geometric mean
  double rest_spacing = 0;     ///< mean distance of neighbouring samples at rest [m]
  bool self_collision = false;
  double self_thickness = 0.002;  ///< gap kept between cloth and cloth, below rest_spacing [m]
  /// Rest positions. Cells that are near each other along the rest shape get no contact; null: no
  /// distance along the cloth is considered. Kept by pointer. [n x n] [m]
  const Planes3* rest = nullptr;
  /// Per body, whether it is closed and keeps the cloth inside; empty: none does.
  std::vector<char> kept_in{};
  /// Per sample, the number (from 1) of a closed body on whose wrong side it starts, or 0; empty:
  /// the first step determines it. [n * n]
  std::vector<int> wrong_side{};
  /// The classes that samples are being sewn into: cells that share one get no contact at it,
  /// though its samples are apart as yet. Null: nothing is sewn. Kept by pointer.
  const BorderMates* sewn = nullptr;
};

/// State of a cloth during a step, as the collider reads and changes it.
struct MovingCloth {
  const Planes3& start;             ///< positions at the start of the step [m]
  Planes3& position;                ///< proposed [m]
  Planes3& velocity;                ///< proposed [m/s]
  const Grid<float>& inverse_mass;  ///< 0: pinned, never moved
};

/// Counts of what the filter changed in the proposals of a step, in points: samples, with mates
/// counted once.
struct FilterCounts {
  int moved = 0;      ///< points that are not where they were proposed
  int stopped = 0;    ///< of these, points held back on their paths
  int fell_back = 0;  ///< of these, points put back to their safe positions
  int whole = 0;      ///< cloths all of whose points fell back
  FilterCounts& operator+=(const FilterCounts& other) {
    moved += other.moved;
    stopped += other.stopped;
    fell_back += other.fell_back;
    whole += other.whole;
    return *this;
  }
};

/// What a step's last filter may leave undone.
enum class FilterEnd {
  whole,        ///< nothing: the step is accepted, whatever it takes
  unless_falls  ///< all, once points would fall back: the caller then discards the step
};

/// Collision handling of a scene: keeps cloths out of bodies, and out of each other and themselves
/// where the method can. Cloths are indexed in the order in which they were given. Nothing
/// allocates or throws once warmed up. Order of calls in a step: move_bodies where bodies move;
/// detect and filter_guess, as often as wanted; after the integrators' work correct, any number of
/// times; filter; commit. rollback in place of commit discards the step: what follows has the same
/// bits as without it.
class Collider {
 public:
  Collider() = default;
  Collider(const Collider&) = delete;
  Collider& operator=(const Collider&) = delete;
  virtual ~Collider() = default;
  /// Begins a step in which bodies move from the end of the last step to `ends`.
  /// @param ends  of each body [n x n] world [m], mates equal, valid until commit or rollback; null
  /// where it stands still
  virtual void move_bodies(std::span<const Planes3* const> ends, ThreadTeam& team) noexcept = 0;
  /// Motion of a body in the step; null where it stands still, and for methods whose bodies do.
  [[nodiscard]] virtual const BlockMotion* motion_of(std::size_t /*body*/) const noexcept {
    return nullptr;
  }
  /// Tells which samples of a body lie in the body itself, from now on: cloth passes through
  /// triangles at them, for methods that heed this.
  /// @param buried  [n * n], see PlacedBody; empty: none does
  virtual void bury(std::size_t /*body*/, std::span<const char> /*buried*/) noexcept {}
  /// Finds the contacts of a step from the proposals.
  virtual void detect(std::span<const MovingCloth> cloths, double time_step,
                      ThreadTeam& team) noexcept = 0;
  /// The same for other proposals of the same step; contacts may stay where these end near those
  /// that filter_guess left, or detect was given.
  virtual void detect_again(std::span<const MovingCloth> cloths, double time_step,
                            ThreadTeam& team) noexcept {
    detect(cloths, time_step, team);
  }
  /// Contacts of one cloth that the last detect found, for its integrator.
  [[nodiscard]] virtual std::span<const Contact> contacts(std::size_t cloth) const noexcept = 0;
  /// Chooses the form of contacts between two cloths: shared contacts, which contacts() then lacks,
  /// for an integrator that solves cloths together; or for each cloth half-spaces that move with
  /// the mean motion of both sides.
  virtual void share_contacts(bool /*shared*/) noexcept {}
  [[nodiscard]] virtual std::span<const SharedContact> shared_contacts() const noexcept {
    return {};
  }
  /// Contacts of a cloth with bodies and the ground: the first ones of contacts(cloth).
  [[nodiscard]] virtual std::span<const Contact> obstacle_contacts(
      std::size_t cloth) const noexcept {
    return contacts(cloth);
  }
  /// Whether the last detect found anything near a cloth, so that proposals may have passed through
  /// it.
  [[nodiscard]] virtual bool anything_near() const noexcept { return false; }
  /// Filters the proposals before a solve, so that it starts without intersections. Velocities and
  /// marks stay unchanged.
  /// @return number of points moved; 0 for methods without a filter
  virtual int filter_guess(std::span<const MovingCloth> /*cloths*/,
                           [[maybe_unused]] double time_step, ThreadTeam& /*team*/) noexcept {
    return 0;
  }
  /// Contact response after the solve: pushes penetrating samples out, removes their inward
  /// velocity and applies friction. Mates are treated alike, so they stay equal.
  /// @param forces  normal forces of contacts(cloth) as solved, in their order; empty where the
  ///                integrator does not report them [N]
  /// @return how many samples were in contact with obstacles
  virtual int correct(std::size_t cloth, const MovingCloth& moving, std::span<const float> forces,
                      double time_step, ThreadTeam& team) noexcept = 0;
  /// Last change of positions in a step: a point that would pass through a surface stops before it,
  /// with an inelastic impact.
  /// @param end  unless_falls: where the result has points that fell back, proposals are unfinished
  /// @return zeros for methods without a filter
  virtual FilterCounts filter(std::span<const MovingCloth> cloths, double time_step,
                              ThreadTeam& team, FilterEnd end = FilterEnd::whole) noexcept = 0;
  /// Adds contacts for what the last filter had to hold back to what the next detect of the same
  /// step finds, until a commit. The step must have been rolled back, not shortened.
  /// @param time_step  its length [s]
  /// @return whether any of them was not known
  virtual bool learn_struck(std::span<const MovingCloth> /*cloths*/,
                            [[maybe_unused]] double time_step) noexcept {
    return false;
  }
  /// Accepts the step: bodies stay at its end.
  virtual void commit() noexcept {}
  /// Discards the step: bodies and the marks of samples return to the last commit.
  virtual void rollback() noexcept {}
  /// Ends a frame: drops what is known for its steps alone.
  virtual void end_frame() noexcept {}
  /// Drops what earlier steps cached to shorten searches: what follows depends on states, marks and
  /// struck contacts alone.
  virtual void forget() noexcept {}
  /// State of a cloth's samples beyond their positions, for resuming a run: inside marks [n * n],
  /// then for the cloth itself and each later cloth whether the pair may be tangled. Empty where
  /// there is no such state.
  virtual void save_marks(std::size_t cloth, std::vector<int>& marks) const = 0;
  virtual void restore_marks(std::size_t cloth, std::span<const int> marks) = 0;
  /// Contacts that the filter asked for and the next step begins with, for resuming a run.
  [[nodiscard]] virtual std::span<const StruckContact> struck() const noexcept { return {}; }
  virtual void restore_struck(std::span<const StruckContact> /*kept*/) {}
  /// Number of contacts of cloth with itself or other cloth that the last detect found.
  [[nodiscard]] virtual int self_contacts() const noexcept = 0;
  /// Number of crossings of cloth edges with cloth triangles at the start of the last detected
  /// step, which are being untangled; 0 where there are none, and for methods without untangling.
  [[nodiscard]] virtual int crossings() const noexcept = 0;
  /// Smallest signed distance of a particle to an obstacle (negative inside), for reports. Gaps to
  /// bodies are measured up to twice the thickness only; infinite where nothing is found near. [m]
  virtual double smallest_gap(std::size_t cloth, const Planes3& positions,
                              ThreadTeam& team) noexcept = 0;
};

/// Bodies and ground plane of a scene.
/// @param ground  height of the ground plane, if any; its friction is `ground_friction`
struct Obstacles {
  std::vector<Body> bodies;
  std::optional<double> ground;
  double ground_friction = 0.5;
};
/// @param cloths  their mates are kept by reference
std::unique_ptr<Collider> make_collider(const ColliderOptions& options, const Obstacles& obstacles,
                                        std::span<const CollidingCloth> cloths);

// Overloads for one kind of collider, each defined in its own source.
std::unique_ptr<Collider> make_collider_of(const PyramidOptions& options,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths);
std::unique_ptr<Collider> make_collider_of(const PolarMapOptions& options,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths);
std::unique_ptr<Collider> make_collider_of(const SphereTreeOptions& options,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths);
std::unique_ptr<Collider> make_collider_of(const SpatialHashOptions& options,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths);
std::unique_ptr<Collider> make_collider_of(const ImageSpaceOptions& options,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths);

}  // namespace weft
