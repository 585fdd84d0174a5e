#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "weft/core/planes.h"
#include "weft/image/geometry_image.h"
#include "weft/mesh/triangle_mesh.h"
#include "weft/view/camera.h"

namespace weft {

/// fabric: two-sided, woven, with sheen. body: satin plaster.
enum class Look { fabric, body };

/// A surface to draw, straight from its grid of positions. Pointers must outlive the call to draw.
/// Samples that are not finite are drawn at the sample before them.
struct DrawnSurface {
  const Planes3* positions = nullptr;  ///< [n x n] world [m], n >= 2
  const BorderMates* mates = nullptr;  ///< so that normals are smooth across seams
  const NormalMap* normals = nullptr;  ///< shading of bodies; null: made from the positions
  Vec3f colour{0.42F, 0.05F, 0.07F};   ///< linear RGB
  const Planes3* colours =
      nullptr;  ///< [m x m], m >= 1, linear RGB that `colour` is times; or null
  Look look = Look::fabric;
  float threads = 300;  ///< of the weave along a side of the image, for fabric; 0: none
  /// Differs whenever what the pointers lead to does: a surface that was drawn with it before, in
  /// the same place of the list, is not looked at again. 0: look always.
  std::uint64_t revision = 0;
};

/// A plain mesh to draw as a body, some of its edges as lines. Pointers must outlive the call to
/// draw.
struct DrawnMesh {
  const TriangleMesh* mesh = nullptr;
  std::vector<std::array<int, 2>> marked_edges;  ///< pairs of vertices
  Vec3f colour{0.62F, 0.60F, 0.57F};             ///< linear RGB
  std::vector<Vec3f> colours;                    ///< of each vertex instead, [V] or none
  Vec3f mark_colour{0.75F, 0.05F, 0.03F};        ///< linear RGB
  double mark_width = 2;                         ///< in pixels of a picture 480 high
};

/// Where the one light that throws sharp shadows stands, seen from the scene [rad]; azimuth 0 is
/// +z.
struct KeyLight {
  double azimuth = -0.75, elevation = 0.92;
  friend bool operator==(const KeyLight&, const KeyLight&) = default;
};

struct DrawnScene {
  std::vector<DrawnSurface> surfaces;
  std::optional<double> ground;  ///< height, with soft shadow
  Camera camera;
  std::vector<DrawnMesh> meshes;
  KeyLight light;
  bool on_white = false;  ///< white paper behind all, instead of a backdrop
  /// The light of the picture before is good enough, where it was of the same surfaces: for
  /// windows, as light costs more than the rest where there is no graphics hardware.
  bool keep_light = false;
};

}  // namespace weft
