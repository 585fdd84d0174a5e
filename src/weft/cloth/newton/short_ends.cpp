#include "weft/cloth/newton/short_ends.h"

namespace weft {
namespace {

/// Blocks of a stencil: the centre, and those to neighbours in the order of spring_offsets.
enum StencilBlock { centre, right, down, below_right, below_left };

/// An entry of a block of some node.
struct Place {
  int row = 0, col = 0;
  StencilBlock block = centre;
};

/// The entry of M between two lines across an end, of its last node but one, a, and its last, b.
struct Across {
  Place aa, ab, ba, bb;
};

/// S M S^T.
void fold_across(const Across& m, PlaneSet& stencil) {
  for (int k = 0; k < block_entries; ++k) {
    const auto at = [&](const Place& p) -> float& {
      return stencil(p.row, p.col, p.block * block_entries + k);
    };
    const float aa = at(m.aa), ab = at(m.ab), ba = at(m.ba), bb = at(m.bb);
    at(m.aa) = aa - ab - ba + bb;
    at(m.ab) = 2 * (ab - bb);
    at(m.ba) = 2 * (ba - bb);
    at(m.bb) = 4 * bb;
  }
}

/// The same on one such line, whose block between a and b is stored once.
void fold_along(const Place& a, const Place& ab, const Place& b, PlaneSet& stencil) {
  for (int k = 0; k < block_entries; ++k) {
    const auto at = [&](const Place& p) -> float& {
      return stencil(p.row, p.col, p.block * block_entries + k);
    };
    const float between = at(ab), last = at(b);
    at(a) += last - 2 * between;
    at(ab) = 2 * (between - last);
    at(b) = 4 * last;
  }
}

void fold_last_column(const Chart& chart, PlaneSet& stencil) {
  const int a = chart.col + chart.cols - 2, b = a + 1;
  for (int r = chart.row; r < chart.row + chart.rows; ++r) {
    fold_along({r, a, centre}, {r, a, right}, {r, b, centre}, stencil);
    fold_across({{r, a, down}, {r, a, below_right}, {r, b, below_left}, {r, b, down}}, stencil);
  }
}

void fold_last_row(const Chart& chart, PlaneSet& stencil) {
  const int a = chart.row + chart.rows - 2, b = a + 1;
  for (int c = chart.col; c < chart.col + chart.cols; ++c) {
    fold_along({a, c, centre}, {a, c, down}, {b, c, centre}, stencil);
    if (c + 1 == chart.col + chart.cols) break;
    fold_across({{a, c, right}, {a, c, below_right}, {a, c + 1, below_left}, {b, c, right}},
                stencil);
  }
}

/// Calls change(value of the last node but one, value of the last) on each line across the ends.
template <class Change>
void each_end(const Chart& chart, bool of_rows, PaddedVectors& field, const Change& change) {
  const int lines = of_rows ? chart.cols : chart.rows;
  for (PaddedPlane* plane : {&field.x, &field.y, &field.z})
    for (int i = 0; i < lines; ++i) {
      const int row = chart.row + (of_rows ? chart.rows - 1 : i);
      const int col = chart.col + (of_rows ? i : chart.cols - 1);
      change(of_rows ? (*plane)(row - 1, col) : (*plane)(row, col - 1), (*plane)(row, col));
    }
}

}  // namespace

ShortEnds::ShortEnds(const LevelLayout& fine, const LevelLayout& coarse) {
  for (std::size_t k = 0; k < fine.charts.size(); ++k) {
    const End end{coarse.charts[k], fine.charts[k].rows % 2 == 0, fine.charts[k].cols % 2 == 0};
    if (end.rows || end.cols) ends_.push_back(end);
  }
}

void ShortEnds::extrapolate(const Workers& workers, PaddedVectors& values) const {
  const Range mine = workers.share(static_cast<int>(ends_.size()));
  const auto go_on = [](float before, float& last) { last = 2 * last - before; };
  for (int i = mine.first; i < mine.last; ++i) {
    if (ends_[i].cols) each_end(ends_[i].chart, false, values, go_on);
    if (ends_[i].rows) each_end(ends_[i].chart, true, values, go_on);
  }
}

void ShortEnds::fold(const Workers& workers, PaddedVectors& restricted) const {
  const Range mine = workers.share(static_cast<int>(ends_.size()));
  const auto give_back = [](float& before, float& last) {
    before -= last;
    last *= 2;
  };
  for (int i = mine.first; i < mine.last; ++i) {
    if (ends_[i].cols) each_end(ends_[i].chart, false, restricted, give_back);
    if (ends_[i].rows) each_end(ends_[i].chart, true, restricted, give_back);
  }
}

void ShortEnds::fold(const Workers& workers, PlaneSet& stencil) const {
  const Range mine = workers.share(static_cast<int>(ends_.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    if (ends_[i].cols) fold_last_column(ends_[i].chart, stencil);
    if (ends_[i].rows) fold_last_row(ends_[i].chart, stencil);
  }
}

}  // namespace weft
