#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/convert.h"
#include "weft/core/thread_team.h"
#include "weft/point_cache.h"
#include "weft/scene.h"
#include "weft/sim/placement.h"

namespace weft {

/// Pose of a path at a time: linear between its keys, constant before the first and after the last.
/// @pre at least one key
MotionKey key_at(std::span<const MotionKey> path, double seconds);

/// Bound on the speed of points moved along a path. [m/s]
/// @param reach  largest distance of a point from the centre of rotation [m]
double fastest_on(std::span<const MotionKey> path, double reach);

/// Motion of a body, a function of time alone, so that a resumed run needs no state of it. Rigid
/// motion rotates the placed body about its placed origin; an animation moves the vertices that its
/// samples are blended from, linearly between its time samples. Both begin after `wait`, in which
/// the body stays at its rest position, and `lead_in`, which eases it from there to their start;
/// after their end the body stands still.
class BodyMotion {
 public:
  /// Conventions of animation files.
  struct Files {
    double frame_rate = 60;  ///< of files that count frames [1/s]
    MeshFrame frame;         ///< of positions in the files
  };
  /// @param surface  loaded with keep_places where the body is animated
  /// @throws SceneError when the animation has other vertices than the surface; InputError
  BodyMotion(const SceneBody& body, const LoadedSurface& surface, const Files& files);

  [[nodiscard]] bool moves() const { return !path_.empty() || animation_.has_value(); }
  /// Whether it changes the body's shape.
  [[nodiscard]] bool deforms() const { return animation_.has_value(); }
  /// Samples a side, n, of a body that moves.
  [[nodiscard]] int size() const { return rest_.size(); }
  /// Sets the positions of all samples at a time; mates are equal.
  /// @param positions  [n x n] world [m]
  void place(double time, Planes3& positions, ThreadTeam& team) noexcept;
  /// Where an animation of a mesh has its vertices at a time; empty for other motions.
  /// @param rest  [V] of the mesh, unplaced [m]  @return [V] world [m]
  [[nodiscard]] std::vector<Vec3d> vertices(double time, std::span<const Vec3d> rest) const;
  /// Largest speed of any of its points. [m/s]
  [[nodiscard]] double fastest() const { return fastest_; }

 private:
  /// A time between two samples of the animation.
  struct Instant {
    int before = 0, after = 0;
    double part = 0;
  };
  /// Positions of all samples at a time sample of the animation; they are kept, as long as they lie
  /// next to the time.
  struct Key {
    int sample = -1;
    Planes3 positions;  // world [m]
  };
  void set_key(int sample, Key& key, ThreadTeam& team) const noexcept;
  void place_animated(double seconds, Planes3& positions, ThreadTeam& team) noexcept;
  void place_rigid(double seconds, Planes3& positions, ThreadTeam& team) const noexcept;
  [[nodiscard]] MotionKey key_now(double seconds) const noexcept;
  [[nodiscard]] Instant instant_at(double seconds) const noexcept;
  [[nodiscard]] Vec3d animated(const Instant& instant, const BlendedVertex& blend) const noexcept;
  [[nodiscard]] double fastest_animated() const;
  [[nodiscard]] double since_wait(double time) const noexcept;
  /// Part of the lead-in displacement that is done, 0 to 1: smooth at both ends.
  [[nodiscard]] double led_in(double seconds) const noexcept;

  Planes3 rest_;  // placed [m]
  Vec3d origin_;  // centre of rotation [m]
  PlacementMap map_;
  double wait_ = 0, lead_in_ = 0, fastest_ = 0;
  std::vector<MotionKey> path_;
  std::optional<PointCache> animation_;  // times in seconds
  std::vector<BlendedVertex> blends_;    // [n * n]
  Key before_, after_;                   // the keys around the time that was placed last
  bool of_mesh_ = false;                 // whether the animation moves a mesh's vertices
};

/// Motions of the bodies of a scene, in its order.
class DrivenBodies {
 public:
  void add(BodyMotion motion);
  /// Computes the positions of moving bodies at the end of a step.
  void move_to(double seconds, ThreadTeam& team) noexcept;

  /// @pre body < number of bodies added
  [[nodiscard]] const BodyMotion& motion(std::size_t body) const { return motions_[body]; }
  /// Positions of each body at the end of the step. [n x n] world [m]; null where it stands still
  [[nodiscard]] std::span<const Planes3* const> ends() const { return ends_; }
  [[nodiscard]] bool any_moves() const;
  /// Largest speed of any of them. [m/s]
  [[nodiscard]] double fastest() const;

 private:
  std::vector<BodyMotion> motions_;
  std::vector<std::unique_ptr<Planes3>> places_;  // null where a body stands still
  std::vector<const Planes3*> ends_;
};

}  // namespace weft
