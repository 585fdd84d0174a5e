#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// Two runs of border samples that are the same curve, walked in opposite directions: border
/// positions first + k and mate - k, for k in 0 .. count, modulo 4 (n - 1), are one surface point
/// each.
struct MateInterval {
  int first = 0, mate = 0, count = 0;
  friend bool operator==(const MateInterval&, const MateInterval&) = default;
};

/// Which samples of an image's border are the same point of the surface. Classes may have any size,
/// so cut nodes of any valence fit. Border positions run from 0 at (row 0, col 0) along row 0, then
/// up the last column, back along the last row and down the first column: 4 (n - 1) in all.
class BorderMates {
 public:
  BorderMates() = default;
  /// @param intervals  positions in 0 .. 4 (n - 1), the last being the first again; counts in
  ///                   1 .. 2 (n - 1); no border edge in two runs, so that every border gives a
  ///                   manifold
  /// @throws InputError when n < 2, a position or count is out of range, or runs overlap
  BorderMates(int size, std::vector<MateInterval> intervals);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const std::vector<MateInterval>& intervals() const { return intervals_; }
  /// Classes of two samples or more, each ascending; ordered by smallest sample (row * n + col).
  [[nodiscard]] int class_count() const { return static_cast<int>(starts_.size()) - 1; }
  [[nodiscard]] std::span<const int> mates(int index) const {
    return std::span(samples_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }
  /// The smallest sample of the class of `sample`, or the sample itself.
  [[nodiscard]] int representative(int sample) const;

 private:
  void collect_classes();

  int size_ = 0;
  std::vector<MateInterval> intervals_;
  std::vector<int> starts_{0}, samples_;    // classes, compressed rows
  std::vector<int> border_representative_;  // [4 (n - 1)] by border position
};

/// Sample index of a border position, and back (-1 for an interior sample).
int border_sample(int size, int position);
int border_position(int size, int sample);

/// The similarity from the unit cube to the world: world = lower + scale * cube.
struct WorldMap {
  Vec3d lower;       ///< [m]
  double scale = 1;  ///< [m], > 0
  [[nodiscard]] Vec3d to_world(Vec3f cube) const { return lower + scale * vec_cast<double>(cube); }
};

/// A surface as an n x n picture whose colours are positions. Sample (row, col) lies at v = row, u
/// = col of the square map; dP/du x dP/dv points outwards. A value.
struct GeometryImage {
  Planes3 cube;  ///< [n x n] positions in [0, 1]^3; mates hold equal bits
  BorderMates mates;
  WorldMap world;
  std::string source;       ///< file name (without folder) or builtin:NAME that it was made from
  std::string source_hash;  ///< 16 hexadecimal digits over that mesh, or empty

  [[nodiscard]] int size() const { return cube.size(); }
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
///         cube or not finite, a world without size, or mates that differ
void check_image(const GeometryImage& image, std::string_view name);

/// World positions of all samples; mates are equal.
Planes3 world_positions(const GeometryImage& image);

/// The samples of a grid as a mesh: each quad split along its shorter diagonal (at the border as
/// the topology wants, weft/image/diagonals.h), mates joined, triangles with a repeated vertex left
/// out.
struct RebuiltMesh {
  TriangleMesh mesh;           ///< world positions
  std::vector<int> vertex_of;  ///< [n * n] mesh vertex of every sample. A corner of the square
                               ///< between two mates lies in no triangle (its quad is folded onto
                               ///< itself): it has its neighbours' vertex
  std::vector<int> sample_of;  ///< [V] the representative sample of every vertex, ascending
};
RebuiltMesh rebuild_mesh(const GeometryImage& image);

/// The triangulation of the grid that rebuilding, drawing, collision and checks share, also after
/// samples have moved: the triangles of `rebuild_mesh`, in the same order, as sample indices, mates
/// not joined. Counter-clockwise in the square, u to the right and v up.
std::vector<Triangle> grid_triangles(const GeometryImage& image);

}  // namespace weft
