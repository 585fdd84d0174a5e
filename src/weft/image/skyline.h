#pragma once

#include <array>
#include <vector>

namespace weft {

/// What rectangles take of an image in which they are placed one after the other: of each column
/// how far down.
class Skyline {
 public:
  explicit Skyline(int width) : depth_(static_cast<std::size_t>(width), 0) {}

  /// Takes a rectangle as high up as there is room for it, there as far left; downwards there
  /// always is.
  /// @pre width is at most the image's  @return its column and row
  std::array<int, 2> take(int width, int height);

 private:
  std::vector<int> depth_;
};

}  // namespace weft
