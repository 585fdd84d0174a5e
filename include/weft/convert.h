#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "weft/cut.h"
#include "weft/geometry_image.h"
#include "weft/image_quality.h"
#include "weft/mesh.h"
#include "weft/parameterizer.h"
#include "weft/progress.h"
#include "weft/repair.h"

namespace weft {

/// Asks for a size that suits the mesh, instead of a number.
inline constexpr int automatic_size = 0;

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
  /// Move samples off the surface, so that the triangles between them fit it best.
  bool fit_samples = false;
  bool measure = true;     ///< how far image and mesh are apart
  std::uint64_t seed = 1;  ///< of the points that this is measured at
  int threads = 1;
  Progress* progress = nullptr;
};

/// Wall-clock seconds of `convert_mesh`; `load` is checking and repairing (reading is the
/// caller's).
struct StageSeconds {
  double load = 0, cut = 0, map = 0, sample = 0, measure = 0, total = 0;
};

struct MappedDisk;

/// Everything that a conversion made and found.
struct Conversion {
  RepairedMesh input;
  std::vector<std::string> warnings;  ///< what was not done as asked for
  CutSummary cut;
  int rounds = 0;  ///< paths that were added to the cut to better the map
  MapQuality map_quality;
  std::string parameterizer;  ///< name as on the command line
  /// The cut surface in its square, for what draws it (weft/drawing.h).
  std::shared_ptr<const MappedDisk> mapped;
  GeometryImage image;
  std::optional<NormalMap> normals;
  std::optional<Planes3> texture;  ///< with keep_uv: x = u, y = v; mates differ along seams of it
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

struct CutDisk;

/// How a mesh would be opened for its image.
struct CutPreview {
  RepairedMesh input;
  std::shared_ptr<const CutDisk> disk;  ///< for what draws it (weft/drawing.h)
  int min_size = 0;                     ///< least size of an image that holds the plain cut
};
struct CutPreviewOptions {
  bool augment = false;  ///< lengthen the cut as a conversion would, where that betters the map
  int size = 257;        ///< of the image that it is lengthened for
  Progress* progress = nullptr;
};
/// @param name  what errors call the mesh  @throws InputError, TopologyError as repair_mesh
CutPreview preview_cut(const TriangleMesh& mesh, const std::string& name,
                       const CutPreviewOptions& options = {});

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

/// A surface as users give it: by name (builtin:NAME, a geometry image in .exr or .png, a mesh's
/// file), or as it is in memory. Copies share what is in memory.
struct Surface {
  std::string name;  ///< for one in memory what errors call it
  std::shared_ptr<const TriangleMesh> mesh{};
  std::shared_ptr<const GeometryImage> image{};

  Surface() = default;
  Surface(std::string by_name) : name(std::move(by_name)) {}  // NOLINT(google-explicit-constructor)
  Surface(const char* by_name) : name(by_name) {}             // NOLINT(google-explicit-constructor)
  Surface(const std::filesystem::path& file)                  // NOLINT(google-explicit-constructor)
      : name(file.string()) {}
  /// A mesh that is converted when it is loaded. [m], y up
  Surface(TriangleMesh given, std::string called)
      : name(std::move(called)), mesh(std::make_shared<const TriangleMesh>(std::move(given))) {}
  Surface(GeometryImage given, std::string called)
      : name(std::move(called)), image(std::make_shared<const GeometryImage>(std::move(given))) {}
  [[nodiscard]] bool in_memory() const { return mesh != nullptr || image != nullptr; }
  friend bool operator==(const Surface&, const Surface&) = default;
};

/// A surface once loaded.
struct LoadedSurface {
  GeometryImage image;
  std::optional<NormalMap> normals;     ///< where it came from a mesh
  std::vector<std::string> notes;       ///< repairs and the like
  std::optional<SampleBlends> follows;  ///< with keep_places, where it came from a mesh
  std::optional<SourceMesh> source;     ///< with keep_source, where it came from a mesh
};
/// @throws InputError, TopologyError, UsageError as convert_mesh and check_image
LoadedSurface load_surface(const Surface& surface, const ConvertOptions& options);

/// True when a name ends as geometry images do: .exr or .png.
bool is_image_name(const std::string& name);

/// True for geometry images and for built-in shapes that are images by nature: what load_surface
/// makes without a mesh.
bool is_image_surface(const Surface& surface);

/// Reads a mesh from a file or builtin:NAME. @throws InputError, UsageError
TriangleMesh load_mesh(const std::string& name);

}  // namespace weft
