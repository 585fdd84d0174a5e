#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/camera.h"
#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/mesh.h"
#include "weft/picture.h"
#include "weft/vec.h"

namespace weft {

struct CutDisk;
struct MappedDisk;
struct Pattern;

/// fabric: two-sided, woven, with sheen. body: satin plaster.
enum class Look { fabric, body };

/// A surface to draw, straight from its grid of positions. Pointers must outlive the call to draw.
/// Samples that are not finite are drawn at the sample before them.
struct DrawnSurface {
  const Planes3* positions = nullptr;  ///< [n x n] world [m], n >= 2
  const BorderMates* mates =
      nullptr;  ///< so that normals are smooth across seams, and nothing lies between charts
  /// [(n - 1) * (n - 1)] how quads are split, see rising_quads; null: in turn one way and the
  /// other. Split otherwise than a simulation sees it, folded cloth would show what lies behind it.
  const std::vector<char>* rising = nullptr;
  const NormalMap* normals = nullptr;  ///< shading of bodies; null: made from the positions
  Vec3f colour{0.42F, 0.05F, 0.07F};   ///< linear RGB
  const Planes3* colours =
      nullptr;  ///< [m x m], m >= 1, linear RGB, multiplied by `colour`; or null
  Look look = Look::fabric;
  float threads = 300;  ///< of the weave along a side of the image, for fabric; 0: none
  /// Version of the data behind the pointers. A surface with the same revision at the same index of
  /// the list is not uploaded again. 0: always upload.
  std::uint64_t revision = 0;
};

/// A plain mesh to draw as a body, some of its edges as lines. Pointers must outlive the call to
/// draw.
struct DrawnMesh {
  const TriangleMesh* mesh = nullptr;
  std::vector<std::array<int, 2>> marked_edges;  ///< pairs of vertices
  Vec3f colour{0.62F, 0.60F, 0.57F};             ///< linear RGB
  std::vector<Vec3f> colours;                    ///< [V] per vertex, instead of `colour`; or none
  Vec3f mark_colour{0.75F, 0.05F, 0.03F};        ///< linear RGB
  double mark_width = 2;                         ///< in pixels of a picture 480 high
  /// As DrawnSurface::revision, of the mesh and its colours.
  std::uint64_t revision = 0;
};

/// Direction of the key light, which casts sharp shadows, seen from the scene [rad]; azimuth 0 is
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
  bool on_white = false;  ///< white background instead of a backdrop
  /// Reuse the light and shadows of the previous picture if it had the same surfaces: for windows,
  /// since light costs more than all else without graphics hardware.
  bool keep_light = false;
};

/// Draws scenes offscreen through EGL without a display (software or hardware). One renderer a
/// thread.
class Renderer {
 public:
  /// @throws Error when no OpenGL 3.3 core context can be made, saying what is missing
  Renderer(int width, int height);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  ~Renderer();
  /// Buffers are kept between calls: redrawing surfaces that moved is cheaper than drawing new
  /// ones.
  Picture draw(const DrawnScene& scene);

 private:
  struct Device;
  std::unique_ptr<Device> device_;
};

/// What the colours of a drawing mean.
struct Legend {
  std::string title;
  std::function<Vec3f(double)> colour;  ///< at a position of the scale in [0, 1], display space
  struct Mark {
    double place = 0;  ///< in [0, 1]
    std::string label;
  };
  std::vector<Mark> marks;
};
/// The scale of stretch_colour.
Legend stretch_legend(const std::string& title);
/// The scale of amount_colour. @param largest  what the end of the scale stands for, with its unit
Legend amount_legend(const std::string& title, const std::string& largest);

/// Puts a strip with the scale below the picture, as wide as it is.
void add_legend(Picture& picture, const Legend& legend);
/// The height of such a strip [pixels].
int legend_height(int width);

/// A curve on a surface, drawn as a round tube.
struct DrawnCurve {
  std::vector<Vec3d> points;  ///< [m]
  Vec3f colour;               ///< display space
};

/// A mesh with the colours, curves and nodes to draw on it. The mesh must outlive the drawing.
struct SurfaceDrawing {
  const TriangleMesh* mesh = nullptr;
  std::vector<Vec3f> colours;  ///< of each vertex, display space; none: plaster
  std::vector<DrawnCurve> curves;
  std::vector<Vec3d> nodes;     ///< drawn as dark balls
  double curve_radius = 0.005;  ///< in diagonals of the mesh's box
  std::optional<Legend> legend;
  bool show_edges = false;
  bool on_white = false;
};

struct ViewFrom {
  int width = 1280, height = 720;           ///< pixels
  double azimuth = 0.45, elevation = 0.25;  ///< of the eye [rad]; azimuth 0 looks from +z
};

/// A round tube along a curve; empty for fewer than two points.
TriangleMesh tube(std::span<const Vec3d> points, double radius);

/// Draws pictures of a SurfaceDrawing, all of the view's size, legend included.
class SurfacePainter {
 public:
  /// @throws Error as Renderer
  SurfacePainter(const SurfaceDrawing& drawing, const ViewFrom& view);
  Picture draw(const Camera& camera);
  /// Width over height of what a camera sees: the picture without its legend.
  [[nodiscard]] double aspect() const;

 private:
  SurfaceDrawing drawing_;
  Vec3d origin_;  // of what is drawn, in the drawing's coordinates: the middle of its mesh
  TriangleMesh surface_, marks_;  // marks: tubes and balls
  DrawnScene scene_;
  std::array<int, 2> size_;  // without the legend
  Renderer renderer_;
};

/// One picture of a drawing that frames its whole mesh.
Picture draw_surface(const SurfaceDrawing& drawing, const ViewFrom& view);
/// One picture of a drawing on a white background, as in figures.
Picture draw_on_white(SurfaceDrawing drawing, const ViewFrom& view);

/// A surface with seams closed, and a number at each vertex.
struct SurfaceValues {
  TriangleMesh mesh;
  std::vector<double> values;  ///< [V]
};

/// The L2 stretch around each vertex, scaled as MapQuality is: 1 where lengths are kept.
SurfaceValues stretch_on_surface(const MappedDisk& mapped);
/// The L2 stretch of an image, with its samples as the map.
SurfaceValues stretch_on_surface(const GeometryImage& image);

/// Distance of the rebuilt surface from a mesh: at each vertex the maximum over the midpoints of
/// the triangles around it and of their edges [m].
SurfaceValues error_on_surface(const GeometryImage& image, const TriangleMesh& mesh);

/// Colours by stretch_colour, with the legend.
SurfaceDrawing draw_stretch(const SurfaceValues& stretch);
/// Colours by amount_colour up to the largest value, with the legend in percent of the diagonal.
SurfaceDrawing draw_error(const SurfaceValues& error);

/// The geometry image itself: x, y, z of the unit cube as red, green, blue, row 0 at the top. Small
/// images are enlarged a whole number of times, without smoothing.
/// @param min_side  sides below it are enlarged to reach it [pixels]
Picture colours_of(const GeometryImage& image, int min_side = 256);

/// The panels of a sewing pattern laid flat as in their file, grain upwards, with their names. Both
/// edges of a stitch have one colour; edges that are sewn to nothing are dark. Names are left out
/// of pictures that would have no room but for them.
/// @param width, height  of the picture [pixels]
Picture draw_pattern(const Pattern& pattern, int width, int height);

struct MapDrawing {
  int side = 1024;  ///< of the square [pixels]
  /// Triangles coloured by stretch: blue where the map has more area than needed, red where it has
  /// too little.
  bool stretch = true;
  bool edges = true;  ///< of the triangles, as lines
};

/// The parameterization in the square, row v = 0 at the top as in the image.
Picture draw_map(const MappedDisk& mapped, const MapDrawing& options = {});

/// A run of the square's border, from border position `first` over `count` sample intervals.
struct BorderBand {
  int first = 0, count = 0;
  Vec3f colour;  ///< display space
};

/// The bands of all pairs of mates: two runs each, in the pair's colour, pairs in order of their
/// smallest border position.
std::vector<BorderBand> border_bands(const BorderMates& mates);
/// The bands of a mapped disk; true borders are dark.
std::vector<BorderBand> border_bands(const MappedDisk& mapped);

/// A square picture with a frame around it that shows the bands, nodes (where bands begin and end)
/// as ticks. @param size  n of the bands' border positions
Picture framed_by_mates(const Picture& square, const std::vector<BorderBand>& bands, int size);

/// The picture of an image of several charts, whose mates' samples have the colours of their bands.
/// @param picture  a whole number of pixels a sample
Picture marked_by_mates(const Picture& picture, const BorderMates& mates);

/// The curves of a cut on the surface, each pair of mates once, and its nodes: colours as the bands
/// of the same disk.
void add_cut(SurfaceDrawing& drawing, const CutDisk& cut);
/// The curves and nodes of the cut of a mapped disk.
void add_cut(SurfaceDrawing& drawing, const MappedDisk& mapped);
/// The border of an image in space, coloured as its bands.
void add_cut(SurfaceDrawing& drawing, const GeometryImage& image);

/// Transforms the normal map of a surface that moved: each texel's normal by the inverse transpose
/// of the map of the tangents and normal of the samples around it, so that detail finer than the
/// samples is kept. Where the grid has no area, before or after, its own normals are used.
/// @param rest     [n x n] positions before [m], finite
/// @param normals  [k x k] normals before, any size k >= 2
/// @param moved    [n x n] positions after [m], finite
/// @param mates    of the same n, whose maps are joined, and whose charts nothing is interpolated
///                 between; or null
/// @throws UsageError when the grids differ in size
NormalMap carried_normals(const Planes3& rest, const NormalMap& normals, const Planes3& moved,
                          const BorderMates* mates);

}  // namespace weft
