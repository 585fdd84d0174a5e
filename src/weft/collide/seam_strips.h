#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/geometry_image.h"

namespace weft {

/// Straight seams of a grid of samples with the cells on both sides of them, as grids of their own:
/// two rows of cells of one side, two of the other. Rows run along the seam, from the first side to
/// the second.
class SeamStrips {
 public:
  static constexpr int rows = 4;
  /// Where the steps of a strip point in the image: along the image's rows or columns, forwards (1)
  /// or backwards (-1).
  struct Frame {
    bool along_rows = true;  ///< the strip's rows lie along rows of the image
    int along = 1, across = 1;
    friend bool operator==(const Frame&, const Frame&) = default;
  };
  struct Strip {
    int first = 0, count = 0;      ///< columns, counted through all strips
    std::array<Frame, 2> sides{};  ///< of rows 0 and 1, and of rows 2 and 3
  };
  /// A cell's place in a strip.
  struct Place {
    int strip = 0, row = 0, col = 0;
  };

  SeamStrips() = default;
  explicit SeamStrips(const BorderMates& mates);

  [[nodiscard]] std::span<const Strip> strips() const { return strips_; }
  /// Of all strips.
  [[nodiscard]] int columns() const { return static_cast<int>(cells_.size()) / rows; }
  /// The cells of a strip's column, by rows; -1 where a chart has no second row of cells.
  [[nodiscard]] std::span<const int> column(const Strip& strip, int col) const {
    return std::span(cells_).subspan(static_cast<std::size_t>(strip.first + col) * rows, rows);
  }
  /// A cell may lie in several strips. @pre there are strips
  [[nodiscard]] std::span<const Place> places(int cell) const {
    return std::span(places_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
  }

 private:
  void add(const BorderMates& mates, const MateInterval& interval);
  void collect_places(int cells);

  std::vector<Strip> strips_;
  std::vector<int> cells_;  // column after column
  std::vector<int> starts_;
  std::vector<Place> places_;  // by cells, compressed rows
};

}  // namespace weft
