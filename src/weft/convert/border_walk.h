#pragma once

#include <vector>

#include "weft/param/square_map.h"

namespace weft {

/// A point on an edge of a disk: (1 - fraction) * from + fraction * to.
struct EdgePoint {
  int from = 0, to = 0;  ///< disk vertices
  double fraction = 0;   ///< in [0, 1)
};

/// Interpolates a value at a point of an edge; at a vertex it is the vertex's own, bit for bit.
template <class Value>
Value interpolate(EdgePoint point, const Value& from, const Value& to) {
  return point.fraction == 0 ? from : from + point.fraction * (to - from);
}

/// The surface points of the border samples of a mapped disk. Points of both mates are computed on
/// one path of the pair, with integer arithmetic for the position along it, so that both get the
/// same point.
class BorderWalk {
 public:
  /// Keeps a reference: the disk must outlive it.
  explicit BorderWalk(const MappedDisk& mapped);

  /// The point at border position `index`, in 0 .. around - 1, of a grid of samples over the same
  /// chart, as much finer or coarser along rows as along columns.
  [[nodiscard]] EdgePoint at(int index, ChartSize size) const;

  /// The surface point of at(index, size), given by the disk vertices at this border position
  /// rather than those of its mate: for values that may differ on the two sides of the cut.
  [[nodiscard]] EdgePoint on_own_side(int index, ChartSize size) const;

 private:
  /// A point on the path of a pair that is used for both mates: between its vertices `edge` and
  /// `edge` + 1, or at the last one.
  struct PathPoint {
    int path = 0, own_path = 0;
    int edge = 0;
    double fraction = 0;
  };
  [[nodiscard]] PathPoint find(int index, ChartSize size) const;

  struct Path {
    int first = 0;  ///< border position of its first node
    int intervals = 0;
    int mate = -1;
    std::vector<int> vertices;  ///< disk vertices, both end nodes included
    std::vector<double> knots;  ///< positions of the vertices along the path, 0 .. intervals
  };
  ChartSize size_;
  std::vector<Path> paths_;
  std::vector<int> path_at_;  ///< [around] the path on each interval between two samples
};

}  // namespace weft
