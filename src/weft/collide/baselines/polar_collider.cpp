// The paper's collider: particles are pushed out of bodies along the rays of a polar map.
#include <algorithm>
#include <cmath>

#include "weft/collide/baselines/polar_map.h"
#include "weft/collide/collider.h"
#include "weft/vec.h"

namespace weft {
namespace {

/// One particle during a step, for the response to an obstacle.
struct StruckParticle {
  Vec3d start;     ///< at the start of the step [m]
  Vec3d position;  ///< proposed [m]
  Vec3d velocity;  ///< proposed [m/s]
};

/// Push of an obstacle on a particle.
struct Push {
  Vec3d normal;      ///< unit, out of the obstacle
  double depth = 0;  ///< how far the particle has to move along the normal, >= 0 [m]
  double hold = 0;   ///< tangential motion that friction may take: the coefficient times the depth
                     ///< of the step [m]
};

/// Moves the particle out, stops its velocity into the obstacle, and takes back as much of the
/// tangential motion of this step as friction may: at most `hold`, all of it when it was less
/// (sticking). The velocity loses the same over the time step, but is never reversed.
void respond(const Push& push, double time_step, StruckParticle& particle) noexcept {
  const Vec3d n = push.normal;
  particle.position += push.depth * n;
  const double inward = dot(particle.velocity, n);
  if (inward < 0) particle.velocity -= inward * n;

  const Vec3d moved = particle.position - particle.start;
  const Vec3d slid = moved - dot(moved, n) * n;
  const double slid_length = length(slid);
  if (slid_length > 0) particle.position -= std::min(1.0, push.hold / slid_length) * slid;

  const Vec3d along = particle.velocity - dot(particle.velocity, n) * n;
  const double speed = length(along);
  if (speed > 0) particle.velocity -= std::min(1.0, push.hold / (time_step * speed)) * along;
}

constexpr int no_sample = -1;
/// Passes over the obstacles: pushing out of one may push into the next (a crotch, a body on the
/// ground).
constexpr int max_turns = 4;
/// Remaining depth, in thicknesses, that counts as rounding.
constexpr double settled = 1e-6;
/// Distance from a contact's plane, in thicknesses, beyond which a particle is no longer pressed
/// against it.
constexpr double left_surface = 0.1;

double pair_friction(double a, double b) { return std::sqrt(a * b); }

/// A body with its polar map, shared by all cloths.
struct MappedBody {
  PolarMap map;
  double friction = 0;
};

/// Pushes one cloth out of bodies.
class Pusher {
 public:
  Pusher(const std::vector<MappedBody>& bodies, const Obstacles& obstacles,
         const CollidingCloth& cloth)
      : bodies_(bodies),
        mates_(cloth.mates),
        thickness_(cloth.thickness),
        friction_(cloth.friction),
        ground_(obstacles.ground),
        ground_friction_(pair_friction(obstacles.ground_friction, cloth.friction)) {}

  void detect(const MovingCloth& cloth, ThreadTeam& team) noexcept {
    if (nothing_there()) return;
    const int n = cloth.position.size();
    slots_.resize(static_cast<std::size_t>(n) * n);
    contacts_.reserve(slots_.size());
    pressed_depth_.resize(slots_.size());
    team.run([&](Worker& worker) {
      const Range rows = worker.share(n);
      for (int s = rows.first * n; s < rows.last * n; ++s) slots_[s] = contact_of(cloth, s);
    });
    detected_ = true;
    contacts_.clear();
    for (int s = 0; s < n * n; ++s)
      if (slots_[s].samples[0] == s && mates_.representative(s) == s)
        contacts_.push_back(slots_[s]);
  }
  [[nodiscard]] std::span<const Contact> contacts() const noexcept { return contacts_; }

  int correct(const MovingCloth& cloth, std::span<const float> forces, double time_step,
              ThreadTeam& team) noexcept {
    if (nothing_there()) return 0;
    const int n = cloth.position.size();
    if (detected_) take_forces(cloth, forces, time_step);
    touched_.resize(n);
    team.run([&](Worker& worker) {
      const Range rows = worker.share(n);
      for (int r = rows.first; r < rows.last; ++r) {
        touched_[r] = 0;
        for (int c = 0; c < n; ++c) touched_[r] += correct_particle(cloth, r * n + c, time_step);
      }
    });
    detected_ = false;
    int total = 0;
    for (const int count : touched_) total += count;
    return total;
  }

  double smallest_gap(const Planes3& positions, ThreadTeam& team) noexcept {
    const int n = positions.size();
    row_gaps_.resize(n);
    team.run([&](Worker& worker) {
      const Range rows = worker.share(n);
      for (int r = rows.first; r < rows.last; ++r) {
        row_gaps_[r] = HUGE_VAL;
        for (int c = 0; c < n; ++c) {
          const Vec3d point = vec_cast<double>(positions.at(r, c));
          const auto found = deepest(point, point, 2 * thickness_);
          if (found) row_gaps_[r] = std::min(row_gaps_[r], found->point.gap);
        }
      }
    });
    return n > 0 ? *std::min_element(row_gaps_.begin(), row_gaps_.end()) : HUGE_VAL;
  }

 private:
  struct Nearest {
    SurfacePoint point;
    double friction = 0;
  };

  [[nodiscard]] bool nothing_there() const { return bodies_.empty() && !ground_; }

  /// The obstacle that is entered deepest, of those nearer than `reach`.
  [[nodiscard]] std::optional<Nearest> deepest(Vec3d point, Vec3d start,
                                               double reach) const noexcept {
    std::optional<Nearest> found;
    for (const MappedBody& body : bodies_) {
      const auto contact = body.map.contact(point, start, reach);
      if (contact && (!found || contact->gap < found->point.gap))
        found = {*contact, pair_friction(body.friction, friction_)};
    }
    const double gap = ground_ ? point.y - *ground_ : HUGE_VAL;
    if (gap < reach && (!found || gap < found->point.gap))
      found = {{{point.x, *ground_, point.z}, {0, 1, 0}, gap}, ground_friction_};
    return found;
  }

  [[nodiscard]] Contact contact_of(const MovingCloth& cloth, int sample) noexcept {
    Contact contact;
    pressed_depth_[sample] = 0;
    contact.samples[0] = no_sample;
    const int n = cloth.position.size();
    if (cloth.inverse_mass(sample / n, sample % n) <= 0) return contact;
    const auto found = deepest(vec_cast<double>(cloth.position.at(sample)),
                               vec_cast<double>(cloth.start.at(sample)), thickness_);
    if (!found) return contact;
    contact.samples[0] = sample;
    contact.normal = vec_cast<float>(found->point.normal);
    contact.offset =
        static_cast<float>(dot(found->point.normal, found->point.position) + thickness_);
    contact.friction = static_cast<float>(found->friction);
    pressed_depth_[sample] = thickness_ - found->point.gap;
    return contact;
  }

  /// Replaces the detected depths by the displacements due to the solver's forces, where it reports
  /// them.
  void take_forces(const MovingCloth& cloth, std::span<const float> forces, double time_step) {
    const int n = cloth.position.size();
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const int s = contacts_[i].samples[0];
      pressed_depth_[s] =
          double{forces[i]} * time_step * time_step * double{cloth.inverse_mass(s / n, s % n)};
    }
    for (int index = 0; index < mates_.class_count() && !forces.empty(); ++index)
      for (const int s : mates_.mates(index))
        pressed_depth_[s] = pressed_depth_[mates_.mates(index)[0]];
  }

  /// Applies friction for the depth by which the solve has lifted a detected particle, unless it
  /// has left the surface.
  bool hold_pressed(int sample, double time_step, StruckParticle& particle) const noexcept {
    const double pressed = detected_ ? pressed_depth_[sample] : 0;
    if (pressed <= 0) return false;
    const Contact& contact = slots_[sample];
    const Vec3d normal = vec_cast<double>(contact.normal);
    if (dot(normal, particle.position) - contact.offset > left_surface * thickness_) return false;
    respond({normal, 0, contact.friction * pressed}, time_step, particle);
    return true;
  }

  [[nodiscard]] int correct_particle(const MovingCloth& cloth, int sample,
                                     double time_step) const noexcept {
    const int n = cloth.position.size();
    if (cloth.inverse_mass(sample / n, sample % n) <= 0) return 0;
    StruckParticle particle{vec_cast<double>(cloth.start.at(sample)),
                            vec_cast<double>(cloth.position.at(sample)),
                            vec_cast<double>(cloth.velocity.at(sample))};
    int turns = hold_pressed(sample, time_step, particle) ? 1 : 0;
    for (int turn = 0; turn < max_turns; ++turn) {
      const auto found = deepest(particle.position, particle.start, thickness_);
      const double depth = found ? thickness_ - found->point.gap : 0;
      if (depth <= settled * thickness_) break;
      respond({found->point.normal, depth, found->friction * depth}, time_step, particle);
      ++turns;
    }
    if (turns == 0) return 0;
    cloth.position.set(sample, vec_cast<float>(particle.position));
    cloth.velocity.set(sample, vec_cast<float>(particle.velocity));
    return 1;
  }

  const std::vector<MappedBody>& bodies_;
  const BorderMates& mates_;
  double thickness_, friction_;
  std::optional<double> ground_;
  double ground_friction_;
  std::vector<Contact> slots_, contacts_;  // slots: [n * n], one a sample
  std::vector<double>
      pressed_depth_;      // [n * n] lift by the solver: the detected depth, or by its forces [m]
  bool detected_ = false;  // in this step
  std::vector<int> touched_;      // [n] per row
  std::vector<double> row_gaps_;  // [n]
};

/// The paper's collider: bodies stand still, cloths ignore each other and themselves.
class PushCollider final : public Collider {
 public:
  PushCollider(const PolarMapOptions& options, const Obstacles& obstacles,
               std::span<const CollidingCloth> cloths) {
    for (const Body& body : obstacles.bodies)
      bodies_.push_back({PolarMap(body, options), body.friction});
    for (const CollidingCloth& cloth : cloths) pushers_.emplace_back(bodies_, obstacles, cloth);
  }

  void move_bodies(std::span<const Planes3* const> /*ends*/,
                   ThreadTeam& /*team*/) noexcept override {}
  void detect(std::span<const MovingCloth> cloths, double /*time_step*/,
              ThreadTeam& team) noexcept override {
    for (std::size_t i = 0; i < cloths.size(); ++i) pushers_[i].detect(cloths[i], team);
  }
  [[nodiscard]] std::span<const Contact> contacts(std::size_t cloth) const noexcept override {
    return pushers_[cloth].contacts();
  }
  int correct(std::size_t cloth, const MovingCloth& moving, std::span<const float> forces,
              double time_step, ThreadTeam& team) noexcept override {
    return pushers_[cloth].correct(moving, forces, time_step, team);
  }
  FilterCounts filter(std::span<const MovingCloth> /*cloths*/, double /*time_step*/,
                      ThreadTeam& /*team*/, FilterEnd /*end*/) noexcept override {
    return {};
  }
  void save_marks(std::size_t /*cloth*/, std::vector<int>& marks) const override { marks.clear(); }
  void restore_marks(std::size_t /*cloth*/, std::span<const int> /*marks*/) override {}
  [[nodiscard]] int self_contacts() const noexcept override { return 0; }
  [[nodiscard]] int crossings() const noexcept override { return 0; }
  double smallest_gap(std::size_t cloth, const Planes3& positions,
                      ThreadTeam& team) noexcept override {
    return pushers_[cloth].smallest_gap(positions, team);
  }

 private:
  std::vector<MappedBody> bodies_;
  std::vector<Pusher> pushers_;  // one a cloth
};

}  // namespace

std::unique_ptr<Collider> make_collider_of(const PolarMapOptions& options,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths) {
  return std::make_unique<PushCollider>(options, obstacles, cloths);
}

}  // namespace weft
