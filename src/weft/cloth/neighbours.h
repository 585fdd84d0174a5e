#pragma once

#include <algorithm>
#include <array>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/row_pointers.h"

namespace weft {

/// Row and column offsets of the six spring directions.
struct SpringOffset {
  int down = 0, right = 0;
};
inline constexpr std::array<SpringOffset, spring_directions> spring_offsets{
    {{0, 1}, {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}}};

/// One of the twelve spring neighbours of the particles of a row: for columns first .. last - 1,
/// the particle (row, c) is joined to (other_row, c + shift) by the spring at (spring_row, c +
/// spring_shift) of its direction's plane.
struct NeighbourRow {
  int direction = 0;
  int other_row = 0, shift = 0;
  int spring_row = 0, spring_shift = 0;
  int first = 0, last = 0;
};

/// The spring neighbours of a row that lie within the image, for the first `directions` directions.
class NeighbourRows {
 public:
  NeighbourRows(int size, int row, int directions = spring_directions) {
    for (int direction = 0; direction < directions; ++direction) {
      const auto [down, right] = spring_offsets[direction];
      add(size, {direction, row + down, right, row, 0});
      add(size, {direction, row - down, -right, row - down, -right});
    }
  }
  [[nodiscard]] const NeighbourRow* begin() const { return rows_.data(); }
  [[nodiscard]] const NeighbourRow* end() const { return rows_.data() + count_; }

 private:
  void add(int size, NeighbourRow row) {
    if (row.other_row < 0 || row.other_row >= size) return;
    row.first = row.shift < 0 ? -row.shift : 0;
    row.last = row.shift > 0 ? size - row.shift : size;
    if (row.first < row.last) rows_[count_++] = row;
  }
  std::array<NeighbourRow, 2 * spring_directions> rows_;
  int count_ = 0;
};

/// The number of directions that have springs; those of second neighbours come last.
inline int used_directions(const Cloth& cloth) {
  return cloth.material.bend_springs > 0 ? spring_directions : bend_u;
}

inline ConstRow3 shifted(ConstRow3 row, int shift) {
  return {row.x + shift, row.y + shift, row.z + shift};
}
inline Row3 shifted(Row3 row, int shift) { return {row.x + shift, row.y + shift, row.z + shift}; }
inline ConstRow3 row_of(const Planes3& planes, int r) {
  return {planes.x.row(r), planes.y.row(r), planes.z.row(r)};
}
inline Row3 row_of(Planes3& planes, int r) {
  return {planes.x.row(r), planes.y.row(r), planes.z.row(r)};
}
/// Sets a row of `size` samples to zero.
inline void clear(Row3 row, int size) {
  for (float* values : {row.x, row.y, row.z}) std::fill(values, values + size, 0.0F);
}

}  // namespace weft
