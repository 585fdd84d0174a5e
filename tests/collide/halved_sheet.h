#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/grid.h"

namespace weft::test {

/// A sheet of 9 x 9 samples, and the same cut along its middle column: the right half lies in the
/// image turned and mirrored in one of eight ways.
class HalvedSheet {
 public:
  static constexpr int n = 9, half = 4, size = 22, place = 12;

  explicit HalvedSheet(int way) : way_(way) {
    const bool lies = way_ % 2 == 1;
    charts_ = {{"", 0, 0, n, half + 1}, {"", 0, place, lies ? half + 1 : n, lies ? n : half + 1}};
    const BorderMates apart(size, charts_, {});
    const int mate = position_of(apart, image_sample(0, half, true));
    const int next = position_of(apart, image_sample(1, half, true));
    // Down the last column of the left half.
    const bool turned = next == apart.along_border(mate, 1);
    mates = BorderMates(size, charts_, {{half, mate, n - 1, turned}});
  }

  /// The sample of the image at a place of the sheet, in one of its halves.
  [[nodiscard]] int image_sample(int row, int col, bool right) const {
    if (!right) return row * size + col;
    int r = way_ & 2 ? n - 1 - row : row, c = way_ & 4 ? n - 1 - col : col - half;
    if (way_ & 1) std::swap(r, c);
    return r * size + place + c;
  }
  /// The cell of the image of a cell of the sheet.
  [[nodiscard]] int image_cell(int row, int col) const {
    const bool right = col >= half;
    const int a = image_sample(row, col, right), b = image_sample(row + 1, col + 1, right);
    return std::min(a / size, b / size) * (size - 1) + std::min(a % size, b % size);
  }
  /// Positions of the sheet at the samples of the image.
  [[nodiscard]] Planes3 image_of(const Planes3& sheet) const {
    Planes3 image(size);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        if (c <= half) image.set(image_sample(r, c, false), sheet.at(r, c));
        if (c >= half) image.set(image_sample(r, c, true), sheet.at(r, c));
      }
    return image;
  }

  BorderMates mates;

 private:
  static int position_of(const BorderMates& mates, int sample) {
    int position = mates.first_position(1);
    while (mates.sample_at(position) != sample) ++position;
    return position;
  }

  int way_;
  std::vector<Chart> charts_;
};

}  // namespace weft::test
