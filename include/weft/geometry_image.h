#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// A rectangle of samples in an image: one disk of the surface. Rows row .. row + rows - 1, columns
/// col .. col + cols - 1.
struct Chart {
  std::string name;  ///< may be empty
  int row = 0, col = 0, rows = 0, cols = 0;
  /// How many samples lie along its border.
  [[nodiscard]] int border_length() const { return 2 * (rows - 1) + 2 * (cols - 1); }
  friend bool operator==(const Chart&, const Chart&) = default;
};

/// Two runs of border samples that are the same curve. Walked in opposite directions, which is how
/// an oriented surface is joined, border positions first + k and mate - k are one surface point
/// each, for k in 0 .. count; where it is `turned`, first + k and mate + k are. Positions are
/// counted within the border of the chart that a run begins in, and end in the same.
struct MateInterval {
  int first = 0, mate = 0, count = 0;
  bool turned = false;
  friend bool operator==(const MateInterval&, const MateInterval&) = default;
};

/// Which samples of an image are the same point of the surface. Classes may have any size, so cut
/// nodes of any valence and edges of any number of triangles fit.
///
/// Border positions of a chart run from 0 at its first row and column along its first row, then up
/// its last column, back along its last row and down its first column. Those of the second chart
/// follow those of the first, and so on. Samples of no chart ("holes") belong to the class of a
/// sample beside them, so that whatever follows the classes keeps them at a valid place near by.
class BorderMates {
 public:
  BorderMates() = default;
  /// One chart that is the whole image.
  /// @param intervals  positions in 0 .. 4 (n - 1), the last being the first again; counts in
  ///                   1 .. 2 (n - 1); no border edge in two runs, so that every border gives a
  ///                   manifold
  /// @throws InputError when n < 2, a position or count is out of range, or runs overlap
  BorderMates(int size, std::vector<MateInterval> intervals);
  /// Several charts. Border edges may be in several runs: the surface's edges have as many
  /// triangles then.
  /// @throws InputError when a chart is not in the image, narrower than min_image_size, or overlaps
  ///         another; when a position or count is out of range, or the runs together are longer
  ///         than all borders
  BorderMates(int size, std::vector<Chart> charts, std::vector<MateInterval> intervals);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const std::vector<Chart>& charts() const { return charts_; }
  [[nodiscard]] const std::vector<MateInterval>& intervals() const { return intervals_; }
  /// Classes of two samples or more, each ascending but for holes, which come last; ordered by
  /// their first sample (row * n + col).
  [[nodiscard]] int class_count() const { return static_cast<int>(starts_.size()) - 1; }
  [[nodiscard]] std::span<const int> mates(int index) const {
    return std::span(samples_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }
  /// mates(index) without holes: one sample or more.
  [[nodiscard]] std::span<const int> copies(int index) const;
  /// The sample that stands for the class of `sample`, the first of it; the sample itself where it
  /// has none. Never a hole.
  [[nodiscard]] int representative(int sample) const;
  /// Whether every border edge is in one run at most and none is turned: seams then join charts to
  /// an oriented manifold.
  [[nodiscard]] bool keep_manifold() const { return keep_manifold_; }
  /// Border positions of all charts together, and where those of a chart begin.
  [[nodiscard]] int border_length() const { return first_position_.back(); }
  [[nodiscard]] int first_position(int chart) const { return first_position_[chart]; }
  /// The border position some steps further along the border of its chart, or back.
  [[nodiscard]] int along_border(int position, int steps) const;
  /// The sample at a border position.
  [[nodiscard]] int sample_at(int position) const { return border_samples_[position]; }
  /// [n x n] the chart that each sample lies in, -1 for holes; empty for a single chart, which all
  /// lie in.
  [[nodiscard]] const std::vector<int>& chart_of() const { return chart_of_; }
  [[nodiscard]] bool is_hole(int sample) const {
    return !chart_of_.empty() && chart_of_[static_cast<std::size_t>(sample)] < 0;
  }
  /// Whether two samples lie in the same chart. @pre both are in the image
  [[nodiscard]] bool same_chart(int a, int b) const {
    return chart_of_.empty() || (!is_hole(a) && chart_of_[static_cast<std::size_t>(a)] ==
                                                    chart_of_[static_cast<std::size_t>(b)]);
  }
  /// Whether the cell from (row, col) to (row + 1, col + 1) lies in a chart; false outside of the
  /// image.
  [[nodiscard]] bool has_cell(int row, int col) const {
    return row >= 0 && col >= 0 && row + 1 < size_ && col + 1 < size_ &&
           same_chart(row * size_ + col, (row + 1) * size_ + col + 1);
  }

 private:
  void place_charts();
  void check(const MateInterval& interval, bool overlapping) const;
  void join(bool overlapping);
  void shelter_holes();
  void collect_classes();

  int size_ = 0;
  bool keep_manifold_ = true;
  std::vector<Chart> charts_;
  std::vector<MateInterval> intervals_;
  std::vector<int> first_position_{0};      // [charts + 1]
  std::vector<int> border_samples_;         // by border position
  std::vector<int> chart_of_;               // [n * n], or none
  std::vector<int> starts_{0}, samples_;    // classes, compressed rows
  std::vector<int> border_representative_;  // by border position
  std::vector<int> representative_;         // [n * n] of several charts, or none
};

/// Sample index of a border position of an image of one chart, and back (-1 for an interior
/// sample).
int border_sample(int size, int position);
int border_position(int size, int sample);

/// The similarity from the unit cube to the world: world = lower + scale * cube.
struct WorldMap {
  Vec3d lower;       ///< [m]
  double scale = 1;  ///< [m], > 0
  [[nodiscard]] Vec3d to_world(Vec3f cube) const { return lower + scale * vec_cast<double>(cube); }
};

/// A surface as an n x n picture whose colours are positions: one chart that fills it, or several
/// charts beside each other. Sample (row, col) lies at v = row, u = col of its chart's map; dP/du x
/// dP/dv points outwards. A value.
struct GeometryImage {
  Planes3 cube;  ///< [n x n] positions in [0, 1]^3; mates hold equal bits
  BorderMates mates;
  WorldMap world;
  std::string source;       ///< file name (without folder) or builtin:NAME that it was made from
  std::string source_hash;  ///< 16 hexadecimal digits over that mesh, or empty
  /// [n x n] the surface's colours, linear RGB in [0, 1], or of size 0: none; mates hold equal
  /// bits.
  Planes3 colours{};

  [[nodiscard]] int size() const { return cube.size(); }
  [[nodiscard]] bool has_colours() const { return colours.size() > 0; }
  /// Whether it is one square chart joined to an oriented manifold, as those of the paper are.
  [[nodiscard]] bool has_one_chart() const {
    return mates.charts().size() <= 1 && mates.chart_of().empty() && mates.keep_manifold();
  }
  [[nodiscard]] Vec3d world_position(int row, int col) const {
    return world.to_world(cube.at(row, col));
  }
};

/// Smallest n of a geometry image.
inline constexpr int min_image_size = 5;
/// Largest n of a geometry image.
inline constexpr int largest_image_size = 8193;

/// Unit outward normals, n x n, in the same square as the geometry image they go with; of any size.
struct NormalMap {
  Planes3 normal;
  [[nodiscard]] int size() const { return normal.size(); }
};

/// True when all samples of every class hold the same bits.
bool mates_bit_equal(const GeometryImage& image);

/// Refuses an image that violates the invariants of GeometryImage, as one made by a caller may.
/// @param name  of the image in the error
/// @throws InputError for a side out of range, mates of another size, positions outside the unit
///         cube or not finite, a world without size, mates that differ, or colours of another size
///         or outside of [0, 1]
void check_image(const GeometryImage& image, std::string_view name);

/// World positions of all samples; mates are equal.
Planes3 world_positions(const GeometryImage& image);

/// The samples of a grid as a mesh: each quad of a chart split along its shorter diagonal (at the
/// border as the topology wants, weft/image/diagonals.h), mates joined, triangles with a repeated
/// vertex left out.
struct RebuiltMesh {
  TriangleMesh mesh;           ///< world positions
  std::vector<int> vertex_of;  ///< [n * n] mesh vertex of every sample. A corner of a chart
                               ///< between two mates lies in no triangle (its quad is folded onto
                               ///< itself): it has its neighbours' vertex
  std::vector<int> sample_of;  ///< [V] the representative sample of every vertex, ascending
};
RebuiltMesh rebuild_mesh(const GeometryImage& image);

/// How rebuild_mesh splits the quads of an image, and a simulation those of a cloth or body made
/// from it: [(n - 1) * (n - 1)] by rows, 1 where the diagonal joins (row, col) and (row + 1, col +
/// 1), 0 where the other two corners, or where there is no surface.
std::vector<char> rising_quads(const GeometryImage& image);

/// The colours of the vertices of a rebuilt mesh, linear RGB; empty where the image has none. [V]
std::vector<Vec3f> vertex_colours(const GeometryImage& image, const RebuiltMesh& rebuilt);

/// A coarser level of an image: every 2^level-th row and column, mates joined as they were.
/// @return nothing where charts or seams do not lie on those, or the level has another topology
std::optional<GeometryImage> coarser_image(const GeometryImage& image, int level);
/// The coarsest level that an image has; 0: itself alone.
int coarsest_level(const GeometryImage& image);

/// The triangulation of the grid that rebuilding, drawing, collision and checks share, also after
/// samples have moved: the triangles of `rebuild_mesh`, in the same order, as sample indices, mates
/// not joined. Counter-clockwise in the square, u to the right and v up.
std::vector<Triangle> grid_triangles(const GeometryImage& image);

}  // namespace weft
