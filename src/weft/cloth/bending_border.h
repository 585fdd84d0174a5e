#pragma once

#include <span>
#include <vector>

#include "weft/cloth/rest_shape.h"

namespace weft {

/// Cosine of 60 degrees. A border that turns by more has a corner, where the second derivative
/// along it means nothing; one that turns by less at a corner of its chart is smooth there in the
/// rest shape.
constexpr double corner_cosine = 0.5;

/// A grid neighbour of one of a particle's samples, with its stencil weight.
struct Neighbour {
  int sample = 0, place = 0;  ///< sample of the class; index of the weight plane
  int other = 0;              ///< representative of the neighbouring particle
  Vec3d edge{};               ///< rest vector to the neighbour [m]
  double share = 1;           ///< 1/2 on seams, where a mate stores the same edge
  bool border = false;        ///< along a free border
  double x = 0, y = 0;        ///< coordinates in the tangent plane, in mean edges
  double wish = 0, cost = 1;  ///< target weight, penalty of its change
  double weight = 0;
};

/// The neighbourhood of one particle in the rest shape.
struct Surroundings {
  std::vector<Neighbour> ring;
  Vec3d area_vector;
  std::vector<Vec3d> rows;  ///< direction of the warp at each sample, unit length or 0
  bool cut = false;         ///< at some sample the rest shape tells the warp, whatever the rows are
  double spacing = 0;       ///< mean length of the straight edges [m]
  bool free = false;        ///< on a free border
};

/// Whether a neighbour lies along a row or column.
inline bool straight(const Neighbour& at) { return at.place < straight_bending_neighbours; }

/// Which border edges of the charts are sewn to others.
class SewnEdges {
 public:
  explicit SewnEdges(const BorderMates& mates);
  /// @param a, b  two samples beside each other on a border
  [[nodiscard]] bool sewn(int a, int b) const;

 private:
  std::vector<bool> sewn_;  // [2 n n] the edges from each sample down, and to the right
};

/// Collects the neighbourhoods of particles from a rest shape.
class RingReader {
 public:
  /// @param shape  kept by reference
  explicit RingReader(const RestShape& shape);

  /// @param samples  all samples of one particle, without holes
  [[nodiscard]] Surroundings read(std::span<const int> samples) const;

 private:
  [[nodiscard]] Vec3d place(int sample) const;
  [[nodiscard]] bool inside(int sample, int row, int col) const;
  void add_sample(int sample, Surroundings& around) const;
  void mark_border(int sample, Neighbour& at) const;
  [[nodiscard]] Vec3d row_direction(int row, int col) const;
  void add_area(int row, int col, Surroundings& around) const;

  const RestShape& shape_;
  int n_;
  SewnEdges sewn_;
};

/// The free-border term of the bending energy,
///   -(1 - nu) B integral of (x_uu . x_vv - x_uv . x_uv),  B = sqrt(B_warp B_weft),
/// without which a saddle would have no energy. For any map it equals an integral of x_u . d(x_v)
/// over the border, evaluated here on the triangles that have an edge on the border. With nu = 0 it
/// and the Laplacian's energy add up to the Hessian energy,
///   B/2 integral of |x_uu|^2 + 2 |x_uv|^2 + |x_vv|^2,
/// exactly so on a uniform grid [stein18]. Vanishes on affine maps.
/// @param bending  B [N m]
/// @return empty without a free border, or with slivers on it
BorderBending make_border_bending(const RestShape& shape, double bending);

}  // namespace weft
