#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "weft/methods.h"

namespace weft {

/// Capabilities of a collider.
struct ColliderTraits {
  bool filters = true;         ///< filters motion, so that nothing passes through anything
  bool self_collision = true;  ///< can keep a cloth from passing through itself
  bool containers = true;      ///< can keep cloth inside of a body
  bool moving_bodies = true;   ///< can keep cloth out of bodies that move
  bool several_charts = true;  ///< takes bodies whose image has several charts
};

/// The default collider: mip pyramids as bounding volume hierarchies, and a filter of separating
/// planes against penetration.
struct PyramidOptions {
  static constexpr std::string_view name = "pyramid";
  static constexpr ColliderTraits traits{};
  template <class Visit>
  static void visit_options(const Visit& /*visit*/) {}
};

/// Colliders that replace the broad phase of PyramidOptions, for comparison: by a sphere tree over
/// the image [benes05], a spatial hash [teschner03], or depth images [govindaraju03].
struct SphereTreeOptions {
  static constexpr std::string_view name = "sphere_tree";
  static constexpr ColliderTraits traits{.several_charts = false};
  template <class Visit>
  static void visit_options(const Visit& /*visit*/) {}
};
struct SpatialHashOptions {
  static constexpr std::string_view name = "spatial_hash";
  static constexpr ColliderTraits traits{.several_charts = false};
  template <class Visit>
  static void visit_options(const Visit& /*visit*/) {}
};
struct ImageSpaceOptions {
  static constexpr std::string_view name = "image_space";
  static constexpr ColliderTraits traits{.several_charts = false};
  template <class Visit>
  static void visit_options(const Visit& /*visit*/) {}
};

/// The collider of the paper: an angular table of the body [zink07, section 5].
struct PolarMapOptions {
  int size = 0;  ///< cells a side of the table; 0: the body's image size
  /// From the surface point on the particle's ray, walk over neighbouring samples to the closest
  /// point, and push no deeper than a tenth of the body's side. False: the printed method, whose
  /// radial point may lie far from the closest one, so that single pushes are far too deep.
  bool walk = true;

  static constexpr std::string_view name = "polar_map";
  static constexpr ColliderTraits traits{.filters = false,
                                         .self_collision = false,
                                         .containers = false,
                                         .moving_bodies = false,
                                         .several_charts = false};
  template <class Visit>
  static void visit_options(const Visit& visit) {
    visit("size", &PolarMapOptions::size, OptionRange{0, 8193});
    visit("walk", &PolarMapOptions::walk, OptionRange{});
  }
};
using ColliderOptions = std::variant<PyramidOptions, PolarMapOptions, SphereTreeOptions,
                                     SpatialHashOptions, ImageSpaceOptions>;
using Colliders = Methods<ColliderOptions>;

/// The name of a collider in scene file and command line.
inline std::string_view name_of(const ColliderOptions& options) {
  return Colliders::name_of(options);
}

/// Numbers of intersections that cloths have.
struct IntersectionCounts {
  std::int64_t self = 0;    ///< pairs of triangles of one cloth
  std::int64_t cloths = 0;  ///< pairs of triangles of two cloths
  std::int64_t bodies = 0;  ///< pairs of triangles of a cloth and a body
  std::int64_t ground = 0;  ///< triangles of cloths with a corner below the ground
  [[nodiscard]] std::int64_t total() const { return self + cloths + bodies + ground; }
};

}  // namespace weft
