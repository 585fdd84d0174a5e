#pragma once

#include <array>
#include <vector>

#include "weft/core/grid.h"
#include "weft/core/vec.h"

namespace weft {

/// Three vectors of one length, each coordinate contiguous and padded with zeros like a row of a
/// Grid.
class Vectors3 {
 public:
  Vectors3() = default;
  explicit Vectors3(int count) : planes_(3, count) {}
  [[nodiscard]] float* x() { return planes_.row(0); }
  [[nodiscard]] float* y() { return planes_.row(1); }
  [[nodiscard]] float* z() { return planes_.row(2); }
  [[nodiscard]] const float* x() const { return planes_.row(0); }
  [[nodiscard]] const float* y() const { return planes_.row(1); }
  [[nodiscard]] const float* z() const { return planes_.row(2); }
  [[nodiscard]] Vec3f at(int i) const { return {x()[i], y()[i], z()[i]}; }
  void set(int i, Vec3f v) {
    x()[i] = v.x;
    y()[i] = v.y;
    z()[i] = v.z;
  }

 private:
  Grid<float> planes_;
};

/// One row of a matrix times three vectors, in one pass over the row. The sum has sixteen fixed
/// lanes: the same bits for every vector width.
/// @param row  [stride of a Grid] padded with zeros
Vec3f row_times(const float* row, std::ptrdiff_t stride, const Vectors3& vectors);

}  // namespace weft
