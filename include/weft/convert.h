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
#include "weft/garment.h"
#include "weft/geometry_image.h"
#include "weft/image_quality.h"
#include "weft/mesh.h"
#include "weft/mesh_colours.h"
#include "weft/parameterizer.h"
#include "weft/progress.h"
#include "weft/repair.h"

namespace weft {

/// The value of ConvertOptions::size that asks for a size chosen from the mesh.
inline constexpr int automatic_size = 0;

/// The largest ConvertOptions::max_charts.
inline constexpr int largest_chart_count = 4096;

/// Of how many charts an image may be.
enum class ChartChoice {
  automatic,  ///< one where that will do, else as few as make the mesh possible; more of those
              ///< that are stretched where that image is poor
  pieces,     ///< one for each connected piece
  texture,    ///< one for each island of the mesh's texture coordinates
  regions,    ///< ConvertOptions::max_charts compact ones; more where the mesh has more pieces
  one         ///< a mesh of several pieces is refused
};

struct ConvertOptions {
  ChartChoice charts = ChartChoice::automatic;
  int max_charts = 1;  ///< for ChartChoice::regions, from 1 to largest_chart_count
  int size = 257;      ///< or automatic_size; the image tells which it was
  Parameterizer parameterizer = StretchOptions{};
  ComponentChoice component{};  ///< `only`: of several components all, unless `charts` is `one`
  int seed_triangle = -1;       ///< of the input, before repair; -1: choose
  std::optional<Seam> seam{};   ///< cut here, and elsewhere only as far as it must be for a disk
  bool augment = true;
  int normal_map_size = 0;  ///< 0: none
  bool keep_uv = false;     ///< sample the mesh's own texture coordinates too
  std::shared_ptr<const SurfaceColours> colours{};  ///< of the mesh's triangles, to be sampled too
  bool keep_places = false;  ///< record where on the mesh each sample lies (load_surface)
  bool keep_warp = false;  ///< where it has texture coordinates, the direction of u (load_surface)
  bool keep_source = false;  ///< keep the mesh and where its vertices lie (load_surface)
  MeshFrame files{};         ///< unit and up axis of mesh files (load_surface)
  /// Move samples off the surface, so that the triangles between them fit it best.
  bool fit_samples = false;
  bool measure = true;               ///< the distance between image and mesh
  double spacing = default_spacing;  ///< of the samples of a sewing pattern (load_surface) [m]
  std::uint64_t seed = 1;            ///< of the surface points that it is measured at
  int threads = 1;
  Progress* progress = nullptr;
};

/// Wall-clock seconds of `convert_mesh`; `load` is checking and repairing (reading is the
/// caller's).
struct StageSeconds {
  double load = 0, cut = 0, map = 0, sample = 0, measure = 0, total = 0;
};

struct MappedDisk;
struct Piece;

/// A chart of an image, with the piece of the mesh that it was made from.
struct ConvertedChart {
  std::shared_ptr<const MappedDisk> mapped;  ///< for what draws it (weft/drawing.h)
  Chart place;
  std::shared_ptr<const Piece> piece{};
};

/// The result of convert_mesh.
struct Conversion {
  RepairedMesh input;
  std::vector<std::string> warnings;  ///< deviations from the options
  CutSummary cut;
  int rounds = 0;  ///< paths added to the cut to improve the map
  MapQuality map_quality;
  std::string parameterizer;           ///< name as on the command line
  std::vector<ConvertedChart> charts;  ///< the largest area first
  GeometryImage image;
  std::optional<NormalMap> normals;
  /// With colours, [m x m] where m - 1 is a multiple of n - 1: the image's own are means of these.
  std::optional<Planes3> colour_map;
  std::optional<Planes3> texture;  ///< with keep_uv: x = u, y = v; mates differ along seams of it
  ImageQuality quality;
  StageSeconds seconds;
};

/// Converts a mesh to a geometry image. The image's mates are bit-equal and the rebuilt mesh has
/// the input's topology; otherwise it throws.
/// @param name  what errors and the image's metadata call the mesh: a path or builtin:NAME
/// The seam's vertices are those of `mesh`, before repair.
/// @throws InputError, TopologyError as the stages, InputError when texture coordinates are to be
///         kept or followed and the mesh lacks them; UsageError for a size that no image may have,
///         or such a number of charts
Conversion convert_mesh(const TriangleMesh& mesh, const std::string& name,
                        const ConvertOptions& options);

struct CutDisk;

/// A mesh cut open to a disk as for a conversion, without its map.
struct CutPreview {
  RepairedMesh input;
  /// Of each piece of the mesh, the largest first, for what draws it (weft/drawing.h).
  std::vector<std::shared_ptr<const CutDisk>> disks;
  int min_size = 0;  ///< least size of an image that holds the plain cuts
  /// Whether ChartChoice::automatic makes more charts than `disks` where the image of these is
  /// poor.
  bool may_be_split = false;
};
struct CutPreviewOptions {
  bool augment = false;  ///< lengthen the cut as a conversion would, where that betters the map
  int size = 257;        ///< of the image that it is lengthened for, where that is one chart
  Progress* progress = nullptr;
};
/// @param name  what errors call the mesh  @throws InputError, TopologyError as repair_mesh
CutPreview preview_cut(const TriangleMesh& mesh, const std::string& name,
                       const CutPreviewOptions& options = {});

/// A sample of an image as a barycentric combination of mesh vertices.
struct BlendedVertex {
  std::array<int, 3> vertices{};
  std::array<double, 3> weights{1, 0, 0};
};

/// All samples of an image as combinations of the vertices of its source mesh.
struct SampleBlends {
  int vertices = 0;                   ///< of the mesh as it was read
  std::vector<BlendedVertex> blends;  ///< [n * n]; mates are equal
};

/// The source mesh of an image, with its original vertices and polygons.
struct SourceMesh {
  std::vector<Vec3d> positions;  ///< [V] as read: y up [m]
  MeshFaces faces;
  /// [V] positions of the vertices in the square, in sample units: x along columns, y along rows. A
  /// vertex on the cut has the first of its positions; one outside the surface is not finite.
  std::vector<Vec2d> places;
};

/// A surface to load: by name (builtin:NAME, a geometry image in .exr, .png or .weft, a mesh file,
/// a sewing pattern in .json), or from memory. Copies share the data in memory.
struct Surface {
  std::string name;  ///< of a surface in memory: its name in error messages
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

/// A loaded surface.
struct LoadedSurface {
  GeometryImage image;
  std::optional<NormalMap> normals;          ///< where the surface came from a mesh
  std::vector<std::string> notes;            ///< repairs and the like
  std::optional<SampleBlends> follows;       ///< with keep_places, where it came from a mesh
  std::optional<SourceMesh> source;          ///< with keep_source, where it came from a mesh
  std::shared_ptr<const Garment> garment{};  ///< where it came from a sewing pattern
  std::optional<Planes3> texture{};          ///< with keep_uv, see Conversion
  /// With keep_warp, where the mesh has texture coordinates: the direction in which u grows along
  /// the surface, 0 where it does not. [n x n]
  std::optional<Planes3> warp{};
};
/// @throws InputError, TopologyError, UsageError as convert_mesh, check_image and make_garment
LoadedSurface load_surface(const Surface& surface, const ConvertOptions& options);

/// True when a name ends as geometry images do: .exr, .png or .weft.
bool is_image_name(const std::string& name);

/// True for surfaces that load_surface makes without a mesh: geometry images, and built-in shapes
/// that are images by nature.
bool is_image_surface(const Surface& surface);

/// Reads a mesh from a file or builtin:NAME. @throws InputError, UsageError
TriangleMesh load_mesh(const std::string& name);

}  // namespace weft
