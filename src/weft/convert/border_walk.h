#pragma once

#include <vector>

#include "weft/param/square_map.h"

namespace weft {

/// A point of a disk's edge: (1 - fraction) * from + fraction * to.
struct EdgePoint {
  int from = 0, to = 0;  ///< disk vertices
  double fraction = 0;   ///< in [0, 1)
};

/// The value at a point of an edge; at a vertex the vertex's own, bit for bit.
template <class Value>
Value interpolate(EdgePoint point, const Value& from, const Value& to) {
  return point.fraction == 0 ? from : from + point.fraction * (to - from);
}

/// Where on the surface the border samples of a mapped disk lie. Both mates are looked up on one
/// path of their pair, with whole-number arithmetic for the place along it, so that they get the
/// same point.
class BorderWalk {
 public:
  /// Keeps a reference: the disk must outlive it.
  explicit BorderWalk(const MappedDisk& mapped);

  /// The point at border position `index`, in 0 .. 4 (size - 1) - 1, of a map of size x size
  /// samples over the same square.
  [[nodiscard]] EdgePoint at(int index, int size) const;

  /// The same surface point by the disk vertices that lie at this border position themselves, not
  /// those of its mate: for what may differ on both sides of the cut.
  [[nodiscard]] EdgePoint on_own_side(int index, int size) const;

 private:
  /// A point on the path of a pair that both mates are looked up on: between its vertices `edge`
  /// and `edge` + 1, or at the last one.
  struct PathPoint {
    int path = 0, own_path = 0;
    int edge = 0;
    double fraction = 0;
  };
  [[nodiscard]] PathPoint find(int index, int size) const;

  struct Path {
    int first = 0;  ///< border position of its first node
    int intervals = 0;
    int mate = -1;
    std::vector<int> vertices;  ///< disk vertices, both nodes among them
    std::vector<double> knots;  ///< their place along the path, 0 .. intervals
  };
  int size_;
  std::vector<Path> paths_;
  std::vector<int>
      path_at_;  ///< [4 (n - 1)] the path on each interval between neighbouring samples
};

}  // namespace weft
