#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "weft/collide/moving_surface.h"

namespace weft {

/// Marks of the samples where two cloths, or a cloth and itself, are on wrong sides of each other.
class TangleMarks {
 public:
  /// Clears all marks of two surfaces; of a cloth with itself both are the same.
  void clear(const SurfaceGrid& a, const SurfaceGrid& b);
  void mark_layer(int side, int sample, int contour, int layer);
  void mark_wrong(int side, int sample) { marks_[at(side)][sample] |= wrong; }

  /// Union of the marks of a feature's samples.
  [[nodiscard]] std::uint64_t of(int side, const SurfaceGrid& grid,
                                 const std::array<int, 3>& samples) const {
    std::uint64_t all = 0;
    for (const int sample : samples) all |= marks_[at(side)][grid.point(sample)];
    return all;
  }
  /// Whether two features lie beside a contour in its two layers: no plane may separate them then,
  /// as it would keep the layers crossed.
  [[nodiscard]] static bool entangled(std::uint64_t a, std::uint64_t b) {
    return ((a & first_layers) << layers & b) != 0 || ((b & first_layers) << layers & a) != 0;
  }
  /// Whether contacts between two features would push the wrong way.
  [[nodiscard]] static bool misled(std::uint64_t a, std::uint64_t b) {
    return ((a | b) & wrong) != 0 || entangled(a, b);
  }

 private:
  // Bits of a sample: beside a contour in its first or its second layer, where contours share bits
  // if there are many; and in a region that has gone through the other cloth.
  static constexpr int layers = 31;
  static constexpr std::uint64_t first_layers = (std::uint64_t{1} << layers) - 1;
  static constexpr std::uint64_t wrong = std::uint64_t{1} << 63;
  [[nodiscard]] std::size_t at(int side) const {
    return static_cast<std::size_t>(same_ ? 0 : side);
  }
  std::array<std::vector<std::uint64_t>, 2> marks_;  // [n * n] of each side
  bool same_ = false;
};

}  // namespace weft
