#include "weft/collide/baselines/polar_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/core/math.h"

namespace weft {
namespace {

struct Angles {
  double polar = 0, azimuth = 0;  ///< [0, pi], (-pi, pi]
};
Angles angles_of(Vec3d direction) {
  const double r = length(direction);
  if (!(r > 0)) return {};
  return {arc_cosine(direction.y / r), arc_tangent(direction.z, direction.x)};
}

using Corners = std::array<Vec3d, 3>;

/// A rectangle of cells; columns may run past the last one and are taken modulo the size.
struct CellRange {
  int first_row = 0, last_row = 0, first_col = 0, last_col = 0;  // inclusive
};

/// Splits triangles until each piece spans about a cell, and visits every cell that a piece may
/// touch.
template <class Visit>
class Rasterizer {
 public:
  Rasterizer(int size, const Visit& visit) : size_(size), visit_(visit) {}

  void split(const Corners& p, int depth) const {
    const double span = angular_span(p);
    if (span <= pi / size_ || depth == max_splits) return cover(p, span);
    const Corners mid{0.5 * (p[0] + p[1]), 0.5 * (p[1] + p[2]), 0.5 * (p[2] + p[0])};
    split({p[0], mid[0], mid[2]}, depth + 1);
    split({p[1], mid[1], mid[0]}, depth + 1);
    split({p[2], mid[2], mid[1]}, depth + 1);
    split(mid, depth + 1);
  }

 private:
  static constexpr int max_splits = 7;

  /// Upper bound of the longest edge as an angle: pi where the piece reaches the centre.
  static double angular_span(const Corners& p) {
    const double longest = std::sqrt(std::max(
        {squared_length(p[0] - p[1]), squared_length(p[1] - p[2]), squared_length(p[2] - p[0])}));
    const double nearest =
        std::sqrt(std::min({squared_length(p[0]), squared_length(p[1]), squared_length(p[2])})) -
        longest;
    // An edge of length l at distance d or more spans at most 2 asin(l / 2d) <= (pi / 2) l / d.
    return nearest > 0 ? std::min(pi, pi / 2 * longest / nearest) : pi;
  }

  void cover(const Corners& p, double span) const {
    const Angles first = angles_of(p[0]);
    double min_polar = first.polar, max_polar = first.polar, min = 0, max = 0;
    for (const Vec3d& corner : {p[1], p[2]}) {
      const Angles a = angles_of(corner);
      min_polar = std::min(min_polar, a.polar);
      max_polar = std::max(max_polar, a.polar);
      double turn = a.azimuth - first.azimuth;
      if (turn > pi) turn -= 2 * pi;
      if (turn < -pi) turn += 2 * pi;
      min = std::min(min, turn);
      max = std::max(max, turn);
    }
    // Great circles bulge towards the pole: an edge of angle s by at most s / 2, and far from the
    // poles by less than s^2 / (4 sin polar).
    const double sine_least = std::min(sine(min_polar), sine(max_polar));
    const double bulge = sine_least > 2 * span ? span * span / (4 * sine_least) : span / 2;
    // A piece that winds around a pole, or ends near it, may meet every azimuth.
    const bool around = max - min >= 3 || min_polar - bulge <= 0 || max_polar + bulge >= pi;
    if (around && min_polar <= span) min_polar = 0;
    if (around && max_polar >= pi - span) max_polar = pi;
    visit_cells({row_of(min_polar - bulge - hair), row_of(max_polar + bulge + hair),
                 around ? 0 : col_of(first.azimuth + min - hair),
                 around ? size_ - 1 : col_of(first.azimuth + max + hair)});
  }

  void visit_cells(const CellRange& range) const {
    for (int row = range.first_row; row <= range.last_row; ++row)
      for (int col = range.first_col; col <= range.last_col; ++col)
        visit_(row * size_ + (col % size_ + size_) % size_);
  }

  // Rounding may put a corner on either side of a cell's edge, so ranges are widened by a hair.
  // [rad]
  static constexpr double hair = 1e-9;
  [[nodiscard]] int row_of(double polar) const {
    return std::clamp(static_cast<int>(std::floor(polar / pi * size_)), 0, size_ - 1);
  }
  [[nodiscard]] int col_of(double azimuth) const {
    return static_cast<int>(std::floor((azimuth + pi) / (2 * pi) * size_));
  }

  int size_;
  const Visit& visit_;
};

/// Calls visit(cell, triangle) once for each pair, triangles ascending.
template <class Visit>
void for_each_pair(const GridSurface& surface, Vec3d centre, int size, const Visit& visit) {
  std::vector<int> last(static_cast<std::size_t>(size) * size, -1);
  const auto triangles = surface.triangles();
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    const auto once = [&](int cell) {
      if (last[cell] == t) return;
      last[cell] = t;
      visit(cell, t);
    };
    const auto [a, b, c] = triangles[t];
    Rasterizer(size, once)
        .split({surface.position(a) - centre, surface.position(b) - centre,
                surface.position(c) - centre},
               0);
  }
}

}  // namespace

PolarTable::PolarTable(const GridSurface& surface, Vec3d centre, int size) : size_(size) {
  fill(surface, centre);
  sort_entries(surface, centre);
  find_farthest(surface, centre);
}

void PolarTable::fill(const GridSurface& surface, Vec3d centre) {
  starts_.assign(static_cast<std::size_t>(size_) * size_ + 1, 0);
  std::vector<std::pair<int, int>> pairs;
  for_each_pair(surface, centre, size_, [&](int cell, int triangle) {
    ++starts_[cell + 1];
    pairs.emplace_back(cell, triangle);
  });
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  entries_.resize(pairs.size());
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  for (const auto& [cell, triangle] : pairs) entries_[next[cell]++] = triangle;
}

void PolarTable::sort_entries(const GridSurface& surface, Vec3d centre) {
  std::vector<double> nearest;
  for (const auto& [a, b, c] : surface.triangles())
    nearest.push_back(std::min({squared_length(surface.position(a) - centre),
                                squared_length(surface.position(b) - centre),
                                squared_length(surface.position(c) - centre)}));
  for (int cell = 0; cell < size_ * size_; ++cell)
    std::sort(
        entries_.begin() + starts_[cell], entries_.begin() + starts_[cell + 1],
        [&](int p, int q) { return nearest[p] != nearest[q] ? nearest[p] < nearest[q] : p < q; });
}

void PolarTable::find_farthest(const GridSurface& surface, Vec3d centre) {
  const auto of_cell = [&](int cell) {
    double max = 0;
    for (const int t : entries(cell))
      for (const int corner : surface.triangles()[t])
        max = std::max(max, squared_length(surface.position(corner) - centre));
    return std::sqrt(max);
  };
  std::vector<double> own(static_cast<std::size_t>(size_) * size_);
  for (int cell = 0; cell < size_ * size_; ++cell) own[cell] = of_cell(cell);
  farthest_.resize(own.size());
  for (int row = 0; row < size_; ++row)
    for (int col = 0; col < size_; ++col) {
      double max = 0;
      for (int r = std::max(0, row - 1); r <= std::min(size_ - 1, row + 1); ++r)
        for (int turn = -1; turn <= 1; ++turn)
          max = std::max(max, own[r * size_ + (col + turn + size_) % size_]);
      // Widened so that rounding to float never cuts.
      farthest_[row * size_ + col] = static_cast<float>(max * (1 + 1e-6));
    }
}

int PolarTable::cell(Vec3d direction) const noexcept {
  const Angles a = angles_of(direction);
  const int row = std::clamp(static_cast<int>(a.polar / pi * size_), 0, size_ - 1);
  const int col = std::clamp(static_cast<int>((a.azimuth + pi) / (2 * pi) * size_), 0, size_ - 1);
  return row * size_ + col;
}

}  // namespace weft
