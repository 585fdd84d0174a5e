#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "weft/convert/convert.h"
#include "weft/image/geometry_image.h"
#include "weft/mesh/io/mesh_faces.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// A sample of an image as a blend of vertices.
struct BlendedVertex {
  std::array<int, 3> vertices{};
  std::array<double, 3> weights{1, 0, 0};
};

/// How the samples of an image follow the vertices of the mesh that it was made from.
struct SampleBlends {
  int vertices = 0;                   ///< of the mesh as it was read
  std::vector<BlendedVertex> blends;  ///< [n * n]; mates are equal
};

/// The mesh that an image was made from, as its author knows it.
struct SourceMesh {
  std::vector<Vec3d> positions;  ///< [V] as read: y up [m]
  MeshFaces faces;
  /// [V] where each vertex lies in the square, in sample units: x along columns, y along rows. On
  /// the cut it is the first of several places; not finite where a vertex is on no surface.
  std::vector<Vec2d> places;
};

/// A surface as users name it: builtin:NAME, a geometry image (.exr, .png), or a mesh that is
/// converted.
struct LoadedSurface {
  GeometryImage image;
  std::optional<NormalMap> normals;     ///< where it came from a mesh
  std::vector<std::string> notes;       ///< repairs and the like
  std::optional<SampleBlends> follows;  ///< with keep_places, where it came from a mesh
  std::optional<SourceMesh> source;     ///< with keep_source, where it came from a mesh
};
/// @throws InputError, TopologyError, UsageError as the stages
LoadedSurface load_surface(const std::string& name, const ConvertOptions& options);

/// True when a name ends as geometry images do: .exr or .png.
bool is_image_name(const std::string& name);

/// True for geometry images and for built-in shapes that are images by nature: what load_surface
/// makes without a mesh.
bool is_image_surface(const std::string& name);

/// Reads a mesh from a file or builtin:NAME. @throws InputError, UsageError
TriangleMesh load_mesh(const std::string& name);

}  // namespace weft
