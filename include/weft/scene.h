#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "weft/colliders.h"
#include "weft/convert.h"
#include "weft/integrators.h"
#include "weft/material.h"
#include "weft/mesh.h"

namespace weft {

/// Where a surface stands: scaled, rotated about x, then y, then z [degrees], moved [m].
struct Placement {
  Vec3d scale{1, 1, 1};
  Vec3d rotate;
  Vec3d translate;
};

/// Where something that is moved stands at a time; in between linearly.
struct MotionKey {
  double time = 0;  ///< [s]
  Vec3d rotate;     ///< about x, then y, then z [degrees]
  Vec3d translate;  ///< [m]
};

/// A pin as a scene names it.
struct ImagePin {
  Vec2d uv;  ///< in [0, 1]^2: the nearest sample
};
struct NearestPin {
  Vec3d point;  ///< [m], after placement: the nearest sample
};
struct RegionPin {
  Vec2d lower, upper;  ///< all samples within
};
using PinPlace = std::variant<ImagePin, NearestPin, RegionPin>;
struct ScenePin {
  template <class Place>
  ScenePin(Place at, std::vector<MotionKey> moves = {})  // NOLINT(google-explicit-constructor)
      : place(at), path(std::move(moves)) {}
  PinPlace place;
  /// From the rest place, about the middle of all samples that the pin holds; ascending times.
  std::vector<MotionKey> path;
};

/// Samples of a cloth that are tied to a body's surface, as a scene names them.
struct SceneAttachment {
  std::string body;  ///< its name
  PinPlace place;
};

struct SceneCloth {
  std::string name = "cloth";
  Surface surface = "builtin:sheet";
  int size = 257;
  Placement placement;
  Material material;
  double friction = 0.4;
  std::optional<bool> self_collision;  ///< none: where the collider can
  Vec3d velocity;                      ///< at the start [m/s]
  std::vector<ScenePin> pins;
  /// A sample that a pin holds too follows the body.
  std::vector<SceneAttachment> attach;
};

struct SceneBody {
  std::string name = "body";
  Surface surface;
  int size = 257;
  Placement placement;
  double friction = 0.4;
  /// From the placed body, turned about its placed origin (its placement's translate); ascending
  /// times. Only one of motion and animation.
  std::vector<MotionKey> motion;
  std::string animation;  ///< a point cache (PC2, MDD) of the surface's vertices; empty: none
  /// Eases the body from its rest place to where motion or animation begin, which start after it.
  /// [s]
  double lead_in = 0;
};

/// A scene file as a value; every default is the file's default.
struct Scene {
  Vec3d gravity{0, -9.81, 0};  ///< [m/s^2]
  double frame_rate = 60;      ///< [1/s]
  int substeps = 4;
  int frames = 120;
  std::optional<double> ground = 0.0;
  std::optional<WindOptions> wind;  ///< none: no air
  IntegratorOptions integrator;
  /// A step; none: what suits the integrator. Only for those of has_limiter.
  std::optional<int> limiter_passes;
  ColliderOptions collider;
  MeshFrame files;  ///< what the numbers of meshes and caches mean, read and written
  std::vector<SceneCloth> cloths;
  std::vector<SceneBody> bodies;
};

}  // namespace weft
