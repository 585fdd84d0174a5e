#include "weft/image/diagonals.h"

#include <algorithm>
#include <array>

#include "weft/core/assert.h"

namespace weft {
namespace {

Diagonal shorter(const GeometryImage& image, int row, int col) {
  const auto at = [&](int r, int c) { return vec_cast<double>(image.cube.at(r, c)); };
  const double rising = squared_length(at(row + 1, col + 1) - at(row, col));
  const double falling = squared_length(at(row, col + 1) - at(row + 1, col));
  if (rising != falling) return rising < falling ? Diagonal::rising : Diagonal::falling;
  return (row + col) % 2 == 0 ? Diagonal::rising : Diagonal::falling;
}

// Sets the diagonals of the quads along the border, where joined mates could give two edges the
// same ends. With the layout of weft/param/border_layout.h this is possible at two places: the two
// quads at the tip of a cut (a leaf: its neighbours on both sides are mates), and the quads around
// a corner of the square, whose inner sample is adjacent to border samples of two sides.
class BorderDiagonals {
 public:
  BorderDiagonals(const BorderMates& mates, int chart, Grid<Diagonal>& diagonals)
      : mates_(mates),
        n_(mates.size()),
        chart_(mates.charts()[chart]),
        first_(mates.first_position(chart)),
        around_(chart_.border_length()),
        diagonals_(diagonals) {}

  void set_all() {
    for (const int corner : corners()) set_corner(corner);
    for (int t = 0; t < around_; ++t) {
      const auto [begin, end] = side_of(t);
      if (t > begin && t + 1 < end) set_side(t, t == begin + 1, t + 2 == end);
    }
  }

 private:
  /// The border positions of the corners.
  [[nodiscard]] std::array<int, 4> corners() const {
    const int right = chart_.cols - 1, down = chart_.rows - 1;
    return {0, right, right + down, 2 * right + down};
  }
  /// Where the side begins and ends that a border position lies on.
  [[nodiscard]] std::array<int, 2> side_of(int t) const {
    const std::array<int, 4> begins = corners();
    const int side =
        static_cast<int>(std::upper_bound(begins.begin(), begins.end(), t) - begins.begin());
    return {begins[side - 1], side < 4 ? begins[side] : around_};
  }
  [[nodiscard]] int sample(int t) const {
    return mates_.sample_at(first_ + (t + around_) % around_);
  }
  [[nodiscard]] int point(int t) const { return mates_.representative(sample(t)); }
  [[nodiscard]] bool is_leaf(int t) const { return point(t - 1) == point(t + 1); }

  // Splits the quad on the border edge from t to t + 1 by the diagonal that ends at border position
  // `end`.
  void split(int t, int end) {
    const int a = sample(end);
    const int b = sample(end == t ? t + 1 : t);
    const int row_step = b / n_ - a / n_;
    const int col_step = b % n_ - a % n_;
    // The inner side is to the left of t -> t + 1, to the right when seen from t + 1.
    const int turn = end == t ? 1 : -1;
    const int row = a / n_ + row_step + turn * col_step;  // the diagonal's other end
    const int col = a % n_ + col_step - turn * row_step;
    const bool rising = (row > a / n_) == (col > a % n_);
    diagonals_(std::min(row, a / n_), std::min(col, a % n_)) =
        rising ? Diagonal::rising : Diagonal::falling;
  }

  // A corner quad is split through the corner, so that no triangle has three border samples. Where
  // the corner is a leaf its quad is folded onto itself: split across, both triangles have two
  // mates as corners and are left out.
  void set_corner(int t) { split(t, is_leaf(t) ? t + 1 : t); }

  // The other quads: along the side, t .. t + 1. @param starts, ends  next to a corner
  void set_side(int t, bool starts, bool ends) {
    if (is_leaf(t)) return split(t, t);
    if (is_leaf(t + 1)) return split(t, t + 1);
    // The corner's inner sample is adjacent to t - 2 already, and may become adjacent to t - 3.
    if (starts && (point(t + 1) == point(t - 2) || point(t + 1) == point(t - 3)))
      return split(t, t);
    if (ends && point(t) == point(t + 3)) return split(t, t + 1);
  }

  const BorderMates& mates_;
  int n_;
  Chart chart_;
  int first_, around_;
  Grid<Diagonal>& diagonals_;
};

}  // namespace

Grid<Diagonal> choose_diagonals(const GeometryImage& image) {
  const int n = image.size();
  WEFT_ASSERT(n >= min_image_size);
  Grid<Diagonal> diagonals(n - 1, n - 1, Diagonal::none);
  const BorderMates unjoined(n, {});
  const BorderMates& mates = image.mates.size() > 0 ? image.mates : unjoined;
  for (int k = 0; k < static_cast<int>(mates.charts().size()); ++k) {
    const Chart& chart = mates.charts()[k];
    for (int row = chart.row; row < chart.row + chart.rows - 1; ++row)
      for (int col = chart.col; col < chart.col + chart.cols - 1; ++col)
        diagonals(row, col) = shorter(image, row, col);
    BorderDiagonals(mates, k, diagonals).set_all();
  }
  return diagonals;
}

std::vector<char> rising_quads(const GeometryImage& image) {
  const Grid<Diagonal> diagonals = choose_diagonals(image);
  std::vector<char> rising;
  for (int row = 0; row < image.size() - 1; ++row)
    for (int col = 0; col < image.size() - 1; ++col)
      rising.push_back(diagonals(row, col) == Diagonal::rising ? 1 : 0);
  return rising;
}

}  // namespace weft
