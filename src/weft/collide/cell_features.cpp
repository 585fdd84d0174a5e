#include "weft/collide/cell_features.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>
#include <utility>

#include "weft/collide/moving_surface.h"

namespace weft {
namespace {

/// Hands out each feature once.
class FeatureOwners {
 public:
  explicit FeatureOwners(const SurfaceGrid& grid)
      : grid_(grid),
        features_(static_cast<std::size_t>(grid.cells()) * grid.cells()),
        taken_(static_cast<std::size_t>(grid.size()) * grid.size()),
        copies_(taken_.size()) {
    for (int s = 0; s < grid.size() * grid.size(); ++s) ++copies_[grid.joint(s)];
  }

  std::vector<CellFeatures> assign() {
    // What cells begin goes first, so that features at seams stay with the cell they begin.
    for_cells([&](int cell) {
      take_corners(cell, {0});
      take_edges(cell, {0, 1, 2});
    });
    for_cells([&](int cell) {
      take_corners(cell, {1, 2, 3});
      take_edges(cell, {3, 4});
      const std::array corners = grid_.corners(cell);
      features_[cell].at_seam = std::any_of(corners.begin(), corners.end(), [&](int sample) {
        return copies_[grid_.joint(sample)] > 1;
      });
    });
    return std::move(features_);
  }

 private:
  template <typename Do>
  void for_cells(Do&& run) const {
    for (int cell = 0; cell < grid_.cells() * grid_.cells(); ++cell)
      if (!grid_.missing(cell)) run(cell);
  }

  void take_corners(int cell, std::initializer_list<int> corners) {
    for (const int corner : corners) {
      char& taken = taken_[grid_.point(grid_.corners(cell)[corner])];
      if (taken == 0) features_[cell].own_corners |= 1 << corner;
      taken = 1;
    }
  }

  void take_edges(int cell, std::initializer_list<int> edges) {
    for (const int edge : edges) {
      const auto [from, to] = grid_.edge(cell, edge);
      std::array points{grid_.point(from), grid_.point(to)};
      if (points[0] == points[1]) continue;
      std::sort(points.begin(), points.end());
      const bool own =
          at_border(cell, edge) ? border_.insert(points).second : edge < CellFeatures::last_edges;
      if (own) features_[cell].own_edges |= 1 << edge;
    }
  }

  /// Whether the cell alone has the edge, of all cells beside each other in the image.
  [[nodiscard]] bool at_border(int cell, int edge) const {
    const int row = cell / grid_.cells(), col = cell % grid_.cells();
    switch (edge) {
      case 0:
        return absent(row - 1, col);
      case 1:
        return absent(row, col - 1);
      case 3:
        return absent(row + 1, col);
      case 4:
        return absent(row, col + 1);
      default:
        return false;
    }
  }
  [[nodiscard]] bool absent(int row, int col) const {
    const int n = grid_.cells();
    return row < 0 || col < 0 || row >= n || col >= n || grid_.missing(row * n + col);
  }

  const SurfaceGrid& grid_;
  std::vector<CellFeatures> features_;
  std::vector<char> taken_;              // by points
  std::vector<int> copies_;              // samples of each joint
  std::set<std::array<int, 2>> border_;  // edges taken, by points
};

}  // namespace

std::vector<CellFeatures> assign_features(const SurfaceGrid& grid) {
  return FeatureOwners(grid).assign();
}

}  // namespace weft
