#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"

namespace weft {

/// One of the six view directions along the coordinate axes.
struct ViewDirection {
  int axis = 0;  ///< 0: x, 1: y, 2: z
  bool backwards = false;
};
inline constexpr int view_count = 6;
/// @param index  0 to view_count - 1
inline ViewDirection view_direction(int index) { return {index / 2, index % 2 != 0}; }

/// Layered depth image of boxes along an axis: at each pixel the nearest blocks that boxes belong
/// to, each with the depth where it begins. Boxes are drawn a pixel larger than they are, so that
/// none is missed between pixels or by rounding [govindaraju04].
template <int Layers>
class DepthImage {
 public:
  static constexpr int side = 128;  ///< pixels

  /// Clears the image.
  /// @param window  what is seen; not empty
  void clear(const Box3f& window, ViewDirection view);
  /// Draws a box. Boxes outside the window, or with NaNs, leave nothing.
  /// @param block  >= 0, the block that the box belongs to
  void draw(const Box3f& box, int block);
  /// Whether a box lies by more than `reach` [m] before all blocks drawn at its pixels.
  /// @param ignored  (block) whether a block does not count; of Layers - 1 blocks at most
  template <class Ignored>
  [[nodiscard]] bool is_before_all(const Box3f& box, float reach, const Ignored& ignored) const;

 private:
  struct Entry {
    float depth = HUGE_VALF;
    int block = -1;
  };
  using Pixel = std::array<Entry, Layers>;  // by depth
  struct Rectangle {
    int first_row, last_row, first_col, last_col;
  };

  [[nodiscard]] static float along(const Vec3f& p, int axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }
  [[nodiscard]] float near_depth(const Box3f& box) const {
    return view_.backwards ? -along(box.upper, view_.axis) : along(box.lower, view_.axis);
  }
  [[nodiscard]] float far_depth(const Box3f& box) const {
    return view_.backwards ? -along(box.lower, view_.axis) : along(box.upper, view_.axis);
  }
  [[nodiscard]] static int pixel_of(float coordinate, float first, float per_length);
  [[nodiscard]] Rectangle rectangle_of(const Box3f& box, float reach) const;
  static void insert(Pixel& pixel, const Entry& entry);

  ViewDirection view_;
  Box3f window_;
  float pixels_a_row_ = 0, pixels_a_col_ = 0;  // by lengths [1/m]
  std::vector<Pixel> pixels_ = std::vector<Pixel>(static_cast<std::size_t>(side) * side);
};

template <int Layers>
void DepthImage<Layers>::clear(const Box3f& window, ViewDirection view) {
  std::fill(pixels_.begin(), pixels_.end(), Pixel{});
  view_ = view;
  window_ = window;
  const auto density = [&](int axis) {
    const float length = along(window.upper, axis) - along(window.lower, axis);
    const float per_length = static_cast<float>(side) / length;
    return std::isfinite(per_length) && per_length > 0 ? per_length : 0;
  };
  pixels_a_row_ = density((view.axis + 1) % 3);
  pixels_a_col_ = density((view.axis + 2) % 3);
}

template <int Layers>
int DepthImage<Layers>::pixel_of(float coordinate, float first, float per_length) {
  if (per_length == 0) return 0;  // the window has no size, or no end
  // In double precision, so that far coordinates do not overflow; NaNs are outside.
  const double at = (double{coordinate} - first) * per_length;
  if (!(at > -1)) return -2;
  return at < side ? static_cast<int>(at) : side + 1;
}

template <int Layers>
typename DepthImage<Layers>::Rectangle DepthImage<Layers>::rectangle_of(const Box3f& box,
                                                                        float reach) const {
  const int row_axis = (view_.axis + 1) % 3, col_axis = (view_.axis + 2) % 3;
  const auto first = [&](int axis, float per_length) {
    return std::max(
        0, pixel_of(along(box.lower, axis) - reach, along(window_.lower, axis), per_length) - 1);
  };
  const auto last = [&](int axis, float per_length) {
    return std::min(
        side - 1,
        pixel_of(along(box.upper, axis) + reach, along(window_.lower, axis), per_length) + 1);
  };
  return {first(row_axis, pixels_a_row_), last(row_axis, pixels_a_row_),
          first(col_axis, pixels_a_col_), last(col_axis, pixels_a_col_)};
}

/// Inserts an entry: a pixel keeps the nearest blocks in their order, each once.
template <int Layers>
void DepthImage<Layers>::insert(Pixel& pixel, const Entry& entry) {
  int from = 0;
  while (from + 1 < Layers && pixel[from].block != entry.block) ++from;
  if (!(entry.depth < pixel[from].depth)) return;
  for (; from > 0 && entry.depth < pixel[from - 1].depth; --from) pixel[from] = pixel[from - 1];
  pixel[from] = entry;
}

template <int Layers>
void DepthImage<Layers>::draw(const Box3f& box, int block) {
  const float depth = near_depth(box);
  const Rectangle at = rectangle_of(box, 0);
  for (int r = at.first_row; r <= at.last_row; ++r)
    for (int c = at.first_col; c <= at.last_col; ++c)
      insert(pixels_[static_cast<std::size_t>(r) * side + c], {depth, block});
}

template <int Layers>
template <class Ignored>
bool DepthImage<Layers>::is_before_all(const Box3f& box, float reach,
                                       const Ignored& ignored) const {
  const float end = far_depth(box);
  const Rectangle at = rectangle_of(box, reach);
  for (int r = at.first_row; r <= at.last_row; ++r)
    for (int c = at.first_col; c <= at.last_col; ++c)
      for (const Entry& entry : pixels_[static_cast<std::size_t>(r) * side + c]) {
        if (entry.depth - end > reach) break;
        if (!ignored(entry.block)) return false;
      }
  return true;
}

}  // namespace weft
