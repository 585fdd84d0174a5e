#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "weft/core/progress.h"
#include "weft/cut/open_to_disk.h"
#include "weft/cut/seam.h"
#include "weft/image/automatic_size.h"
#include "weft/image/geometry_image.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/io/mesh_faces.h"
#include "weft/mesh/repair.h"
#include "weft/mesh/units.h"
#include "weft/param/square_map.h"

namespace weft {

struct ConvertOptions {
  int size = 257;  ///< or automatic_size; the image tells which it was
  Parameterizer parameterizer = StretchOptions{};
  ComponentChoice component;
  int seed_triangle = -1;    ///< of the input, before repair; -1: choose
  std::optional<Seam> seam;  ///< cut here, and elsewhere only as far as it must be for a disk
  bool augment = true;
  int normal_map_size = 0;   ///< 0: none
  bool keep_uv = false;      ///< sample the mesh's own texture coordinates too
  bool keep_places = false;  ///< tell where on the mesh each sample lies (load_surface)
  bool keep_source = false;  ///< keep the mesh and where its vertices lie (load_surface)
  MeshFrame files;           ///< what the numbers of mesh files mean (load_surface)
  bool fit_samples =
      false;               ///< move samples so that the triangles between them fit, see fit_samples
  bool measure = true;     ///< stage 11
  std::uint64_t seed = 1;  ///< of the samples that stage 11 measures by
  int threads = 1;
  Progress* progress = nullptr;
};

/// Distances and topology of an image against the mesh it came from.
struct ImageQuality {
  bool mates_bit_equal = false;
  int euler = 0, boundaries = 0;  ///< of the rebuilt mesh
  double psnr_db = 0;             ///< 20 log10(box diagonal / larger one-sided RMS distance)
  double hausdorff_percent = 0;   ///< larger one-sided maximum, in percent of the diagonal
  OneSidedDistance from_mesh, from_image;  ///< what both are made of [m]
};
/// What psnr_db is where the surfaces are equal, so that reports hold a number.
inline constexpr double best_psnr_db = 300;
struct MeasureOptions {
  int threads = 1;
  std::uint64_t seed = 1;  ///< of the surface samples
  Progress* progress = nullptr;
};
/// All of it. @throws TopologyError when the image's samples do not make a manifold
ImageQuality measure_image(const GeometryImage& image, const TriangleMesh& mesh,
                           const MeasureOptions& options = {});
/// Without the distances, which stay 0: fast.
ImageQuality measure_topology(const GeometryImage& image);

/// Wall-clock seconds of `convert_mesh`; `load` is checking and repairing (reading is the
/// caller's).
struct StageSeconds {
  double load = 0, cut = 0, map = 0, sample = 0, measure = 0, total = 0;
};

/// Everything that a conversion made and found.
struct Conversion {
  RepairedMesh input;
  std::vector<std::string> warnings;  ///< what was not done as asked for
  CutSummary cut;
  int rounds = 0;
  MappedDisk mapped;
  GeometryImage image;
  std::optional<NormalMap> normals;
  std::optional<Planes3> texture;  ///< with keep_uv: x = u, y = v (see sample_texture)
  ImageQuality quality;
  StageSeconds seconds;
};

/// The whole way from a mesh to its geometry image. The image's mates are bit-equal and the
/// topology of the rebuilt mesh is the input's, or it throws.
/// @param name  what errors and the image's metadata call the mesh: a path or builtin:NAME
/// The seam's vertices are those of `mesh`, before repair.
/// @throws InputError, TopologyError as the stages, InputError when texture coordinates are to be
///         kept and the mesh lacks them; UsageError for a size that no image may have
Conversion convert_mesh(const TriangleMesh& mesh, const std::string& name,
                        const ConvertOptions& options);

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
