#include "weft/collide/seam_strips.h"

#include <algorithm>
#include <cstdlib>

namespace weft {
namespace {

/// An edge of a chart's border and the cells inwards of it.
struct EdgeCells {
  SeamStrips::Frame frame;     ///< along the edge, and inwards
  std::array<int, 2> cells{};  ///< beside the border, and behind that
};

int cell_at(const BorderMates& mates, int row, int col) {
  return mates.has_cell(row, col) ? row * (mates.size() - 1) + col : -1;
}

/// The edge from one sample to the next.
EdgeCells edge_between(const BorderMates& mates, int from, int to) {
  const int n = mates.size(), row = from / n, col = from % n, step = to > from ? 1 : -1;
  EdgeCells edge;
  edge.frame.along_rows = std::abs(to - from) == 1;
  edge.frame.along = step;
  const int r = std::min(row, to / n), c = std::min(col, to % n);
  const auto behind = [&](int k) {
    return edge.frame.along_rows ? cell_at(mates, r + k, c) : cell_at(mates, r, c + k);
  };
  // Of the two cells beside a border edge one is in its chart.
  edge.frame.across = behind(0) >= 0 ? 1 : -1;
  edge.cells =
      edge.frame.across > 0 ? std::array{behind(0), behind(1)} : std::array{behind(-1), behind(-2)};
  return edge;
}

}  // namespace

SeamStrips::SeamStrips(const BorderMates& mates) {
  for (const MateInterval& interval : mates.intervals()) add(mates, interval);
  if (!strips_.empty()) collect_places((mates.size() - 1) * (mates.size() - 1));
}

/// A strip for each part of the run that is straight on both sides.
void SeamStrips::add(const BorderMates& mates, const MateInterval& interval) {
  const int back = interval.turned ? 1 : -1;
  const auto sample = [&](int position, int steps) {
    return mates.sample_at(mates.along_border(position, steps));
  };
  bool begun = false;
  for (int k = 0; k < interval.count; ++k) {
    const EdgeCells own =
        edge_between(mates, sample(interval.first, k), sample(interval.first, k + 1));
    const EdgeCells other =
        edge_between(mates, sample(interval.mate, back * k), sample(interval.mate, back * (k + 1)));
    Frame outwards = own.frame;
    outwards.across = -outwards.across;
    const std::array sides{outwards, other.frame};
    if (!begun || strips_.back().sides != sides) strips_.push_back({columns(), 0, sides});
    begun = true;
    ++strips_.back().count;
    cells_.insert(cells_.end(), {own.cells[1], own.cells[0], other.cells[0], other.cells[1]});
  }
}

void SeamStrips::collect_places(int cells) {
  starts_.assign(static_cast<std::size_t>(cells) + 2, 0);
  for (const int cell : cells_)
    if (cell >= 0) ++starts_[static_cast<std::size_t>(cell) + 2];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  places_.resize(static_cast<std::size_t>(starts_.back()));
  for (int s = 0; s < static_cast<int>(strips_.size()); ++s)
    for (int col = 0; col < strips_[s].count; ++col)
      for (int row = 0; row < rows; ++row)
        if (const int cell = column(strips_[s], col)[row]; cell >= 0)
          places_[starts_[static_cast<std::size_t>(cell) + 1]++] = {s, row, col};
  starts_.pop_back();
}

}  // namespace weft
