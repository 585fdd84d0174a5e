#pragma once

#include "weft/cloth/kernels/row_pointers.h"
#include "weft/grid.h"
#include "weft/vec.h"

namespace weft {

/// Three vectors of one length, each coordinate contiguous and padded with zeros like a row of a
/// Grid.
class Vectors3 {
 public:
  Vectors3() = default;
  explicit Vectors3(int count) : planes_(3, count) {}
  [[nodiscard]] Row3 rows() { return {planes_.row(0), planes_.row(1), planes_.row(2)}; }
  [[nodiscard]] ConstRow3 rows() const { return {planes_.row(0), planes_.row(1), planes_.row(2)}; }
  [[nodiscard]] Vec3f at(int i) const { return {planes_(0, i), planes_(1, i), planes_(2, i)}; }
  void set(int i, Vec3f v) {
    planes_(0, i) = v.x;
    planes_(1, i) = v.y;
    planes_(2, i) = v.z;
  }

 private:
  Grid<float> planes_;
};

}  // namespace weft
