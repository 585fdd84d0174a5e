#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/convert.h"
#include "weft/core/thread_team.h"
#include "weft/mesh/io/point_cache.h"
#include "weft/scene.h"
#include "weft/sim/placement.h"

namespace weft {

/// Where a path stands: linear between its keys, still before the first and after the last.
/// @pre at least one key
MotionKey key_at(std::span<const MotionKey> path, double seconds);

/// The fastest that anything goes that a path turns and moves. [m/s]
/// @param reach  how far from the middle of turning it may be [m]
double fastest_on(std::span<const MotionKey> path, double reach);

/// Where a body is at each time: a function of time alone, so a run that goes on needs nothing of
/// it. Rigid motion turns the placed body about its placed origin; an animation moves the vertices
/// that its samples lie between, linear between its samples. Both begin after `lead_in`, which
/// eases the body from its rest place to where they begin, and stand still after their end.
class BodyMotion {
 public:
  /// How files of animations are meant.
  struct Files {
    double frame_rate = 60;  ///< of those that count frames [1/s]
    MeshFrame frame;         ///< of their positions
  };
  /// @param surface  loaded with keep_places where the body is animated
  /// @throws SceneError when the animation has other vertices than the surface; InputError
  BodyMotion(const SceneBody& body, const LoadedSurface& surface, const Files& files);

  [[nodiscard]] bool moves() const { return !path_.empty() || animation_.has_value(); }
  /// n of a body that moves.
  [[nodiscard]] int size() const { return rest_.size(); }
  /// Sets the places of all samples, mates equal. @param positions  [n x n] world [m]
  void place(double seconds, Planes3& positions, ThreadTeam& team) const noexcept;
  /// The fastest that any of it goes. [m/s]
  [[nodiscard]] double fastest() const { return fastest_; }

 private:
  /// What a sample is a blend of at a time: between two samples of the animation.
  struct Instant {
    int before = 0, after = 0;
    double part = 0;
  };
  [[nodiscard]] MotionKey key_now(double seconds) const noexcept;
  [[nodiscard]] Instant instant_at(double seconds) const noexcept;
  [[nodiscard]] Vec3d animated(const Instant& instant, int sample) const noexcept;
  [[nodiscard]] double fastest_animated() const;
  /// How much of the way from rest to the beginning is done: smooth at both ends.
  [[nodiscard]] double led_in(double seconds) const noexcept;

  Planes3 rest_;  // placed [m]
  Vec3d origin_;  // of the turning [m]
  PlacementMap map_;
  double lead_in_ = 0, fastest_ = 0;
  std::vector<MotionKey> path_;
  std::optional<PointCache> animation_;  // times in seconds
  std::vector<BlendedVertex> blends_;    // [n * n]
};

/// The bodies of a scene on their ways, in its order.
class DrivenBodies {
 public:
  void add(BodyMotion motion);
  /// Finds where each is at the end of a step.
  void move_to(double seconds, ThreadTeam& team) noexcept;

  /// Where each is at the end of the step. [n x n] world [m]; null where it stands still
  [[nodiscard]] std::span<const Planes3* const> ends() const { return ends_; }
  [[nodiscard]] bool any_moves() const;
  /// The fastest that any of them goes. [m/s]
  [[nodiscard]] double fastest() const;

 private:
  std::vector<BodyMotion> motions_;
  std::vector<std::unique_ptr<Planes3>> places_;  // null where a body stands still
  std::vector<const Planes3*> ends_;
};

}  // namespace weft
