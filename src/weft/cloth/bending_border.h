#pragma once

#include <span>
#include <vector>

#include "weft/cloth/rest_shape.h"

namespace weft {

/// A neighbour of one of a particle's samples.
struct Neighbour {
  int sample = 0, place = 0;  ///< the sample of the class, and which of its planes
  int other = 0;              ///< representative of the particle there
  Vec3d edge{};               ///< to there, at rest [m]
  double share = 1;           ///< 1/2 where a second sample sees the same edge
  bool border = false;        ///< along a free border
  double x = 0, y = 0;        ///< in the tangent plane, in mean edges
  double wish = 0, cost = 1;  ///< the weight of the stencil asked for, what a change of it costs
  double weight = 0;
};

/// What surrounds one particle at rest.
struct Surroundings {
  std::vector<Neighbour> ring;
  Vec3d area_vector;
  std::vector<Vec3d> rows;  ///< where rows run at each of the samples, unit length or none
  double spacing = 0;       ///< mean straight edge [m]
  bool free = false;        ///< on a free border
};

/// Whether a neighbour lies along a row or column.
inline bool straight(const Neighbour& at) { return at.place < straight_bending_neighbours; }

/// Reads what surrounds particles off a rest shape.
class RingReader {
 public:
  /// @param shape  kept by reference
  explicit RingReader(const RestShape& shape);

  /// @param samples  all of one particle
  [[nodiscard]] Surroundings read(std::span<const int> samples) const;

 private:
  [[nodiscard]] Vec3d place(int sample) const;
  [[nodiscard]] bool inside(int row, int col) const;
  void add_sample(int sample, Surroundings& around) const;
  void mark_border(int sample, int there, Neighbour& at) const;
  [[nodiscard]] Vec3d row_direction(int row, int col) const;
  void add_area(int row, int col, Surroundings& around) const;

  const RestShape& shape_;
  int n_;
  std::vector<bool> sewn_;  // by the border position that the edge starts from
};

/// What free borders add to the Laplacian's energy, so that a saddle is not free of it,
///   -(1 - nu) B integral of (x_uu . x_vv - x_uv . x_uv),  B = sqrt(B_warp B_weft),
/// which for any map is an integral over the border: of x_u . d(x_v), here around the triangles
/// that have an edge on it. With nu = 0 both together are the energy of the whole second
/// derivative, B/2 integral of |x_uu|^2 + 2 |x_uv|^2 + |x_vv|^2, to the last term on a uniform grid
/// [stein18]. Vanishes on affine maps.
/// @param bending  B [N m]
/// @return empty where the rest shape has seams, or triangles on its border that are slivers
BorderBending make_border_bending(const RestShape& shape, double bending);

}  // namespace weft
