#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace weft {

/// The default: mip pyramids as bounding hierarchies, planes that nothing passes.
struct PyramidOptions {};

/// The same with other broad phases, to compare with: spheres in a tree over the image [benes05], a
/// hashed grid of space [teschner03], and depth images [govindaraju03].
struct SphereTreeOptions {};
struct SpatialHashOptions {};
struct ImageSpaceOptions {};

/// The paper's angular table [zink07, section 5].
struct PolarMapOptions {
  int size = 0;  ///< cells a side of the table; 0: the body's image size
  /// From the surface point on the particle's ray, walk over neighbouring samples to the closest
  /// point, and push no deeper than a tenth of the body's side. False: the printed method, whose
  /// radial point may lie far from the closest one, so that single pushes are far too deep.
  bool walk = true;
};
using ColliderOptions = std::variant<PyramidOptions, PolarMapOptions, SphereTreeOptions,
                                     SpatialHashOptions, ImageSpaceOptions>;
std::string_view name_of(const ColliderOptions& options);
/// The collider of that name, with default options; nothing where there is none.
std::optional<ColliderOptions> collider_named(std::string_view name);
/// Whether it can keep a cloth from passing through itself.
bool knows_self_collision(const ColliderOptions& options);
/// Whether it can keep cloth inside of a body.
bool knows_containers(const ColliderOptions& options);
/// Whether it can keep cloth out of bodies that move.
bool knows_moving_bodies(const ColliderOptions& options);

/// What cloths pass through.
struct IntersectionCounts {
  std::int64_t self = 0;    ///< pairs of triangles of one cloth
  std::int64_t cloths = 0;  ///< of two cloths
  std::int64_t bodies = 0;  ///< of a cloth and a body
  std::int64_t ground = 0;  ///< triangles of cloths with a corner below the ground
  [[nodiscard]] std::int64_t total() const { return self + cloths + bodies + ground; }
};

}  // namespace weft
