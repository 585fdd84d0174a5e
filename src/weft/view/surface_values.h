#pragma once

#include <vector>

#include "weft/image/geometry_image.h"
#include "weft/mesh/triangle_mesh.h"
#include "weft/param/square_map.h"
#include "weft/view/surface_drawing.h"

namespace weft {

/// A surface with seams closed, and a number at each vertex.
struct SurfaceValues {
  TriangleMesh mesh;
  std::vector<double> values;  ///< [V]
};

/// The L2 stretch around each vertex, scaled as MapQuality is: 1 where lengths are kept.
SurfaceValues stretch_on_surface(const MappedDisk& mapped);
/// The same of the samples as a map.
SurfaceValues stretch_on_surface(const GeometryImage& image);

/// How far the rebuilt surface is from a mesh: around each vertex the largest distance of the
/// middles of triangles and edges [m].
SurfaceValues error_on_surface(const GeometryImage& image, const TriangleMesh& mesh);

/// Colours by stretch_colour, with the legend.
SurfaceDrawing draw_stretch(const SurfaceValues& stretch);
/// Colours by amount_colour up to the largest value, with the legend in percent of the diagonal.
SurfaceDrawing draw_error(const SurfaceValues& error);

}  // namespace weft
