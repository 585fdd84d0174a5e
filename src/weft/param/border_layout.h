#pragma once

#include <array>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/vec.h"

namespace weft {

/// How many samples a chart has. A single number is the side of a square.
struct ChartSize {
  int rows = 0, cols = 0;
  constexpr ChartSize() = default;
  constexpr ChartSize(int side) : rows(side), cols(side) {}  // NOLINT(google-explicit-constructor)
  constexpr ChartSize(int all_rows, int all_cols) : rows(all_rows), cols(all_cols) {}
  [[nodiscard]] constexpr bool is_square() const { return rows == cols; }
  /// Sample intervals around it.
  [[nodiscard]] constexpr int around() const { return 2 * (rows - 1) + 2 * (cols - 1); }
  /// Border positions of its corners, from the first on.
  [[nodiscard]] constexpr std::array<int, 4> corners() const {
    return {0, cols - 1, cols - 1 + rows - 1, 2 * (cols - 1) + rows - 1};
  }
  friend bool operator==(const ChartSize&, const ChartSize&) = default;
};

/// A grid over the same chart that is so many times as fine.
constexpr ChartSize refined(ChartSize size, int scale) {
  return {scale * (size.rows - 1) + 1, scale * (size.cols - 1) + 1};
}

/// The placement of the paths of a cut around a chart, in whole sample intervals. Border positions
/// t run counter-clockwise from 0 at (u, v) = (0, 0) to ChartSize::around, first along v = 0.
struct BorderLayout {
  ChartSize size;
  std::vector<int> first;      ///< [P] border position of each path's first node, in [0, around)
  std::vector<int> intervals;  ///< [P] sample intervals of each path, >= 1; mates have the same
};

/// The point (u, v) in [0, cols - 1] x [0, rows - 1] at border position t, for any t in
/// [0, around]; exact for whole t.
Vec2d border_point(ChartSize size, double t);

/// The border position of a point on the border of a chart, in [0, around); the exact inverse of
/// border_point where that is exact.
double border_position_of(ChartSize size, Vec2d point);

/// The index of the sample at a border position, row * stride + col.
int chart_sample(ChartSize size, int position, int stride);

struct LayoutOptions {
  ChartSize size = 257;
  int rotation = 0;  ///< border position of the first path's first node
  /// Round interval counts to multiples of a power of two: the largest that divides rows - 1 and
  /// cols - 1 and changes no path by more than a thirty-second of its share. With a rotation that
  /// is a multiple too, mates then match on coarser levels of the image.
  bool align = true;
};

/// Stage 5: assigns interval counts to the paths in proportion to their lengths, by largest
/// remainder, so that mates match, no loop collapses, and the counts sum to `around`.
/// @throws TopologyError when the chart is too small for the cut, naming the least square that
/// works
BorderLayout lay_out_border(const CutDisk& cut, const LayoutOptions& options);

/// The side of the least square for which lay_out_border succeeds.
int min_size(const CutDisk& cut);

/// Whether a chart has sample intervals enough around it for all paths of a cut.
bool has_room(ChartSize size, const CutDisk& cut);

/// Whether any path's number of intervals is not fixed. Where none is, only charts fit with
/// as many around them as their sum, and squares only where that is a multiple of 4.
bool has_free_path(const CutDisk& cut);

/// Splits the border edges that contain a corner of the chart, and their mates, so that every
/// corner is a border vertex. Mates stay mates; path and border indices are updated.
void split_at_corners(CutDisk& cut, const BorderLayout& layout);

/// The border position t of every border vertex, by arc length along its path; nodes are whole
/// numbers, mated vertices lie at exactly corresponding positions. [border.size()]
std::vector<double> border_positions(const CutDisk& cut, const BorderLayout& layout);

}  // namespace weft
