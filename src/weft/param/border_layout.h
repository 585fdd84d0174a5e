#pragma once

#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/vec.h"

namespace weft {

/// The placement of the paths of a cut around the square, in whole sample intervals. Border
/// positions t run counter-clockwise from 0 at (u, v) = (0, 0) to 4 (n - 1), first along v = 0.
struct BorderLayout {
  int size = 0;                ///< n
  std::vector<int> first;      ///< [P] border position of each path's first node, in [0, 4 (n - 1))
  std::vector<int> intervals;  ///< [P] sample intervals of each path, >= 1; mates have the same
};

/// The point (u, v) in [0, n - 1]^2 at border position t, for any t in [0, 4 (n - 1)]; exact for
/// whole t.
Vec2d border_point(int size, double t);

/// The border position of a point on the border of the square, in [0, 4 (n - 1)); the exact inverse
/// of border_point where that is exact.
double border_position_of(int size, Vec2d point);

struct LayoutOptions {
  int size = 257;
  int rotation = 0;  ///< border position of the first path's first node
  /// Round interval counts to multiples of a power of two: the largest that divides n - 1 and
  /// changes no path by more than a thirty-second of its share. With a rotation that is a multiple
  /// too, mates then match on coarser levels of the image.
  bool align = true;
};

/// Stage 5: assigns interval counts to the paths in proportion to their lengths, by largest
/// remainder, so that mates match, no loop collapses, and the counts sum to 4 (n - 1).
/// @throws TopologyError when n is too small for the cut, naming the least n that works
BorderLayout lay_out_border(const CutDisk& cut, const LayoutOptions& options);

/// The least n for which lay_out_border succeeds.
int min_size(const CutDisk& cut);

/// Whether any path's number of intervals is not fixed. Where none is, only one size fits: that of
/// min_size, and only if their sum is a multiple of 4.
bool has_free_path(const CutDisk& cut);

/// Splits the border edges that contain a corner of the square, and their mates, so that every
/// corner is a border vertex. Mates stay mates; path and border indices are updated.
void split_at_corners(CutDisk& cut, const BorderLayout& layout);

/// The border position t of every border vertex, by arc length along its path; nodes are whole
/// numbers, mated vertices lie at exactly corresponding positions. [border.size()]
std::vector<double> border_positions(const CutDisk& cut, const BorderLayout& layout);

}  // namespace weft
