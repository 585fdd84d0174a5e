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

/// A body as placed in the scene.
struct Body {
  Planes3 positions;  ///< [n x n] world [m]
  BorderMates mates;
  double friction = 0.4;
  Grid<Diagonal> diagonals{};  ///< [(n - 1) x (n - 1)]; empty: all rising
  /// By which it is known where the body is sharp, so that this does not hang on when a run was
  /// resumed; empty: the positions. [n x n] [m]
  Planes3 shape{};
};

/// What a collider needs to know of a cloth it serves.
struct CollidingCloth {
  const BorderMates& mates;
  int size = 0;                ///< n: samples a side
  Grid<Diagonal> diagonals{};  ///< as of a body
  double thickness = 0.002;    ///< the gap that is kept [m]
  double friction = 0.4;       ///< of the cloth; of a pair: the geometric mean
  double rest_spacing = 0;     ///< mean distance of neighbouring samples at rest [m]
  bool self_collision = false;
  double self_thickness = 0.002;  ///< the gap that is kept to other cloth, below rest_spacing [m]
  /// The cloth at rest, by which it is known what is too near along it for a contact; null: nothing
  /// but neighbours. Kept by pointer. [n x n] [m]
  const Planes3* rest = nullptr;
  /// Of each closed body, whether it keeps the cloth in; empty: none does.
  std::vector<char> kept_in{};
  /// Of each sample, the number from 1 of a closed body on whose wrong side it begins, 0: of none;
  /// empty: that is found out in the first step, and all is to be kept out. [n * n]
  std::vector<int> wrong_side{};

  [[nodiscard]] bool is_kept_in(std::size_t body) const {
    return body < kept_in.size() && kept_in[body] != 0;
  }
};

/// The state of a cloth during a step, as far as a collider touches it.
struct MovingCloth {
  const Planes3& start;             ///< positions at the start of the step [m]
  Planes3& position;                ///< proposed [m]
  Planes3& velocity;                ///< proposed [m/s]
  const Grid<float>& inverse_mass;  ///< 0: pinned, never moved
};

/// What a filter did to the proposals of a step; points are samples, mates counted once.
struct FilterCounts {
  int moved = 0;      ///< points that are elsewhere than proposed
  int stopped = 0;    ///< of these, points held back on their way
  int fell_back = 0;  ///< of these, points put back to where the step began
  int whole = 0;      ///< cloths of which all points were
  FilterCounts& operator+=(const FilterCounts& other) {
    moved += other.moved;
    stopped += other.stopped;
    fell_back += other.fell_back;
    whole += other.whole;
    return *this;
  }
};

/// Keeps the cloths of a scene out of its bodies, and out of each other and themselves where it
/// can. Cloths come in the order in which they were given. Nothing allocates or throws once warmed
/// up. In a step: move_bodies where bodies move; detect, filter_guess, as often as wanted; after
/// the integrators' work correct, any number of times; filter; commit. Instead of commit, rollback
/// forgets the step: what follows has the bits that it would have without.
class Collider {
 public:
  Collider() = default;
  Collider(const Collider&) = delete;
  Collider& operator=(const Collider&) = delete;
  virtual ~Collider() = default;
  /// Begins a step at whose end the bodies stand at `ends`; they start from where the last step
  /// left them. @param ends  of each body [n x n] world [m], mates equal, valid until commit or
  /// rollback; null where it stands still
  virtual void move_bodies(std::span<const Planes3* const> ends, ThreadTeam& team) noexcept = 0;
  /// Finds the contacts of a step from the proposals.
  virtual void detect(std::span<const MovingCloth> cloths, double time_step,
                      ThreadTeam& team) noexcept = 0;
  /// What detect found for one cloth, for its integrator; empty for methods that only push.
  [[nodiscard]] virtual std::span<const Contact> contacts(std::size_t cloth) const noexcept = 0;
  /// Whether contacts between two cloths are to be found as shared ones, which contacts() lacks
  /// then, for who solves cloths together; else each cloth gets planes that move as both do on the
  /// mean.
  virtual void share_contacts(bool /*shared*/) noexcept {}
  [[nodiscard]] virtual std::span<const SharedContact> shared_contacts() const noexcept {
    return {};
  }
  /// Those of contacts(cloth) with bodies and the ground, which come first.
  [[nodiscard]] virtual std::span<const Contact> obstacle_contacts(
      std::size_t cloth) const noexcept {
    return contacts(cloth);
  }
  /// Whether the last detect found anything near a cloth, so that proposals may have passed through
  /// it.
  [[nodiscard]] virtual bool anything_near() const noexcept { return false; }
  /// Takes back what proposals passed through, so that a solve starts where nothing crosses.
  /// Nothing is remembered of it, and velocities stay. @return how many points it moved; 0 for
  /// methods that promise nothing
  virtual int filter_guess(std::span<const MovingCloth> /*cloths*/, double /*time_step*/,
                           ThreadTeam& /*team*/) noexcept {
    return 0;
  }
  /// Pushes out what is inside, stops its inward velocity, and holds it by friction. Mates are
  /// treated alike, so they stay equal.
  /// @param forces  normal forces of contacts(cloth) as solved, in their order; empty where the
  ///                integrator does not tell [N]
  /// @return how many samples were in contact with obstacles
  virtual int correct(std::size_t cloth, const MovingCloth& moving, std::span<const float> forces,
                      double time_step, ThreadTeam& team) noexcept = 0;
  /// The last change of positions in a step: what would pass through something stays before it, and
  /// strikes it without bouncing. @return nothing for methods that promise nothing
  virtual FilterCounts filter(std::span<const MovingCloth> cloths, double time_step,
                              ThreadTeam& team) noexcept = 0;
  /// The step stands: bodies are where it took them.
  virtual void commit() noexcept {}
  /// The step is as if it had not been: bodies, and what is known of samples, as at the last
  /// commit.
  virtual void rollback() noexcept {}
  /// What makes searches shorter and depends on steps before is forgotten: what follows depends on
  /// states and marks alone.
  virtual void forget() noexcept {}
  /// What the collider knows of a cloth's samples beyond their positions, for a run that goes on
  /// later: which are inside bodies, [n * n], and with which cloths, itself first and then those
  /// after it, it may be tangled. Empty where there is nothing to know.
  virtual void save_marks(std::size_t cloth, std::vector<int>& marks) const = 0;
  virtual void restore_marks(std::size_t cloth, std::span<const int> marks) = 0;
  /// How many contacts of a cloth with itself or another the last detect found.
  [[nodiscard]] virtual int self_contacts() const noexcept = 0;
  /// Edges of cloth that passed through cloth at the start of the last step that was detected, and
  /// are being untangled; 0 where cloths are free, and for methods that do not look.
  [[nodiscard]] virtual int crossings() const noexcept = 0;
  /// The least signed distance of a particle to an obstacle (negative inside), for reports. Gaps to
  /// bodies are known up to twice the thickness only; infinite where nothing is known to be near.
  /// [m]
  virtual double smallest_gap(std::size_t cloth, const Planes3& positions,
                              ThreadTeam& team) noexcept = 0;
};

/// @param ground  height of the ground plane, if any; its friction is `ground_friction`
struct Obstacles {
  std::vector<Body> bodies;
  std::optional<double> ground;
  double ground_friction = 0.5;
};
/// @param cloths  their mates are kept by reference
std::unique_ptr<Collider> make_collider(const ColliderOptions& options, const Obstacles& obstacles,
                                        std::span<const CollidingCloth> cloths);

// The same of one kind, each defined in its own source.
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
