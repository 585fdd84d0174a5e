#pragma once

#include <array>
#include <vector>

#include "weft/collide/cell_features.h"
#include "weft/collide/seam_strips.h"
#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/image/diagonals.h"

namespace weft {

/// Topology of a grid of samples as a surface: its triangles and its classes of mates, the same at
/// every time.
class SurfaceGrid {
 public:
  SurfaceGrid() = default;
  /// @param diagonals  [(n - 1) x (n - 1)]; empty: all rising
  /// @param sewn  the classes that samples are being sewn into; null: those of `mates`
  SurfaceGrid(int size, const BorderMates& mates, const Grid<Diagonal>& diagonals,
              const BorderMates* sewn = nullptr);

  [[nodiscard]] int size() const { return size_; }       ///< n: samples a side
  [[nodiscard]] int cells() const { return size_ - 1; }  ///< cells a side
  /// The representative of a sample's class of mates.
  [[nodiscard]] int point(int sample) const { return point_[static_cast<std::size_t>(sample)]; }
  /// The next sample of its class of mates, after the last the first again.
  [[nodiscard]] int next_copy(int sample) const {
    return next_copy_[static_cast<std::size_t>(sample)];
  }
  /// The representative of the class that a sample is being sewn into; its point where there is no
  /// sewing. Parts of the surface that share it are neighbours, though they may not touch yet.
  [[nodiscard]] int joint(int sample) const {
    return joint_.empty() ? point(sample) : joint_[static_cast<std::size_t>(sample)];
  }
  /// Whether two samples lie in the same chart.
  [[nodiscard]] bool same_chart(int a, int b) const {
    return chart_.empty() ||
           chart_[static_cast<std::size_t>(a)] == chart_[static_cast<std::size_t>(b)];
  }
  /// Whether its seams are being sewn.
  [[nodiscard]] bool is_sewn() const { return !joint_.empty(); }
  /// The samples of one of a cell's two triangles.
  /// @param half  0 or 1
  [[nodiscard]] std::array<int, 3> triangle(int cell, int half) const {
    return triangle_from(first_sample(cell), cell, half);
  }
  [[nodiscard]] std::array<int, 3> triangle(int row, int col, int half) const {
    return triangle_from(row * size_ + col, row * cells() + col, half);
  }
  /// The cells on both sides of its seams.
  [[nodiscard]] const SeamStrips& seams() const { return seams_; }
  /// Whether a cell lies in no chart: its triangles are folded, and nothing is near it.
  [[nodiscard]] bool missing(int cell) const {
    return diagonal_[static_cast<std::size_t>(cell)] == Diagonal::none;
  }
  /// Whether a cell is divided by its rising diagonal.
  [[nodiscard]] bool rises(int cell) const {
    return diagonal_[static_cast<std::size_t>(cell)] == Diagonal::rising;
  }
  /// Whether any cell lies in no chart.
  [[nodiscard]] bool has_missing() const { return has_missing_; }
  /// Which of a cell's corners its two triangles have.
  [[nodiscard]] std::array<int, 3> triangle_corners(int cell, int half) const {
    if (diagonal_[static_cast<std::size_t>(cell)] == Diagonal::falling)
      return half == 0 ? std::array{0, 1, 2} : std::array{1, 3, 2};
    return half == 0 ? std::array{0, 1, 3} : std::array{0, 3, 2};
  }
  /// The four samples of a cell.
  [[nodiscard]] std::array<int, 4> corners(int cell) const {
    const int s = first_sample(cell);
    return {s, s + 1, s + size_, s + size_ + 1};
  }
  /// The samples of one of a cell's edges, in the order of CellFeatures.
  [[nodiscard]] std::array<int, 2> edge(int cell, int number) const {
    const std::array c = corners(cell);
    switch (number) {
      case 0:
        return {c[0], c[1]};
      case 1:
        return {c[0], c[2]};
      case 3:
        return {c[2], c[3]};
      case 4:
        return {c[1], c[3]};
      default:
        return rises(cell) ? std::array{c[0], c[3]} : std::array{c[1], c[2]};
    }
  }
  /// Those of its points and edges that belong to a cell.
  [[nodiscard]] const CellFeatures& features(int cell) const {
    return features_[static_cast<std::size_t>(cell)];
  }
  [[nodiscard]] int first_sample(int cell) const { return cell / cells() * size_ + cell % cells(); }
  /// True for a degenerate triangle: two of its corners are one surface point.
  [[nodiscard]] bool folded(const std::array<int, 3>& triangle) const {
    const int a = point(triangle[0]), b = point(triangle[1]), c = point(triangle[2]);
    return a == b || b == c || c == a;
  }

 private:
  [[nodiscard]] std::array<int, 3> triangle_from(int first, int cell, int half) const {
    const int a = first, b = a + 1, d = a + size_, c = d + 1;
    const Diagonal diagonal = diagonal_[static_cast<std::size_t>(cell)];
    if (diagonal == Diagonal::none) return {a, a, a};
    if (diagonal == Diagonal::falling) return half == 0 ? std::array{a, b, d} : std::array{b, c, d};
    return half == 0 ? std::array{a, b, c} : std::array{a, c, d};
  }

  int size_ = 0;
  bool has_missing_ = false;
  std::vector<int> point_;          // [n * n]
  std::vector<int> next_copy_;      // [n * n]
  std::vector<int> chart_;          // [n * n], or none for a single chart
  std::vector<int> joint_;          // [n * n], or none
  std::vector<Diagonal> diagonal_;  // [(n - 1)^2]
  SeamStrips seams_;
  std::vector<CellFeatures> features_;  // [(n - 1)^2]
};

/// A surface during a step: every sample moves on a straight line from start to end.
struct MovingSurface {
  const SurfaceGrid* grid = nullptr;
  const Planes3* start = nullptr;  ///< [n x n] [m]
  const Planes3* end = nullptr;    ///< [n x n] [m]; the start where it stands still
  /// Identifier of this motion of this surface, so that no hierarchy is fitted to it twice; 0:
  /// none.
  int name = 0;
};

}  // namespace weft
