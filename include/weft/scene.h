#pragma once

#include <filesystem>
#include <memory>
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
#include "weft/point_cache.h"

namespace weft {

/// Transform of a surface: scaled, rotated about x, then y, then z [degrees], moved [m].
struct Placement {
  Vec3d scale{1, 1, 1};
  Vec3d rotate;
  Vec3d translate;
};

/// A key of a motion, which is linear between its keys.
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
  /// From the rest position, about the middle of the pin's samples; ascending times.
  std::vector<MotionKey> path;
};

/// Samples of a cloth that are tied to a body's surface, as a scene names them.
struct SceneAttachment {
  std::string body;  ///< its name
  PinPlace place;
};

/// A cloth's rest shape from the texture coordinates of its mesh: flat, with the warp along u.
struct TextureRest {
  /// Metres a unit of the texture; nothing: as many as give the flat shape the area of the placed
  /// mesh.
  std::optional<double> scale{};
};

struct SceneCloth {
  std::string name = "cloth";
  Surface surface = "builtin:sheet";
  int size = 257;
  double spacing = default_spacing;  ///< of the samples of a sewing pattern [m]
  /// Of a sewing pattern: how many garments are worn below it, from which its panels start the
  /// farther outside; none: as many garments as the scene lists before it.
  std::optional<int> layer;
  std::optional<TextureRest> rest;  ///< none: the mesh as it is placed
  Placement placement;
  Material material;
  double friction = 0.4;
  std::optional<bool> self_collision;  ///< none: if the collider supports it
  Vec3d velocity;                      ///< at the start [m/s]
  std::vector<ScenePin> pins;
  /// Attachments; a sample that is also pinned follows the body.
  std::vector<SceneAttachment> attach;
};

/// The motion of a surface's vertices: by the name of its file (whatever read_point_cache reads),
/// or in memory. Copies share what is in memory.
struct Animation {
  std::string name;                            ///< of one in memory: its name in error messages
  std::string clip{};                          ///< of a glTF file: its animation; empty: the first
  std::shared_ptr<const PointCache> points{};  ///< [m], y up

  Animation() = default;
  Animation(std::string file) : name(std::move(file)) {}  // NOLINT(google-explicit-constructor)
  Animation(const char* file) : name(file) {}             // NOLINT(google-explicit-constructor)
  Animation(std::string file, std::string of_file)
      : name(std::move(file)), clip(std::move(of_file)) {}
  Animation(PointCache given, std::string called)
      : name(std::move(called)), points(std::make_shared<const PointCache>(std::move(given))) {}
  [[nodiscard]] bool empty() const { return name.empty() && points == nullptr; }
  [[nodiscard]] bool in_memory() const { return points != nullptr; }
};

struct SceneBody {
  std::string name = "body";
  Surface surface;
  int size = 257;
  Placement placement;
  double friction = 0.4;
  /// From the placed body, rotated about its placed origin (its placement's translate); ascending
  /// times. Only one of motion and animation.
  std::vector<MotionKey> motion;
  Animation animation;
  /// Time that the body stays at its rest position before all that, so that garments are sewn on
  /// it. [s]
  double wait = 0;
  /// Time in which the body eases from its rest position to the start of motion or animation, which
  /// begin after it. [s]
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
  /// Rate at which cloth that is not being sewn loses its velocity, so that it comes to rest
  /// sooner, in folds as good as others. No model of air. [1/s], >= 0
  double air_damping = 0;
  IntegratorOptions integrator;
  /// Passes of the strain limiter a step; none: the integrator's default. Only for integrators with
  /// has_limiter.
  std::optional<int> limiter_passes;
  ColliderOptions collider;
  MeshFrame files;  ///< unit and up axis of meshes and caches, read and written
  std::vector<SceneCloth> cloths;
  std::vector<SceneBody> bodies;
};

}  // namespace weft
