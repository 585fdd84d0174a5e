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

}  // namespace weft
