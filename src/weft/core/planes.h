#pragma once

#include "weft/core/grid.h"
#include "weft/core/vec.h"

namespace weft {

/// One vector a sample of an n x n grid, one plane a coordinate (structure of arrays).
struct Planes3 {
  Grid<float> x, y, z;

  Planes3() = default;
  explicit Planes3(int n) : x(n, n), y(n, n), z(n, n) {}
  [[nodiscard]] int size() const { return x.rows(); }
  [[nodiscard]] Vec3f at(int row, int col) const { return {x(row, col), y(row, col), z(row, col)}; }
  void set(int row, int col, Vec3f p) {
    x(row, col) = p.x;
    y(row, col) = p.y;
    z(row, col) = p.z;
  }
  /// By sample index row * n + col.
  [[nodiscard]] Vec3f at(int sample) const { return at(sample / size(), sample % size()); }
  void set(int sample, Vec3f p) { set(sample / size(), sample % size(), p); }
};

/// The farthest that any sample goes between two of the same size. [m]
double largest_displacement(const Planes3& from, const Planes3& to) noexcept;

}  // namespace weft
