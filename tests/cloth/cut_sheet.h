#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/cloth/sheets.h"
#include "weft/cloth/newton/level_layout.h"

namespace weft::testing {

/// A flat 1 m square cut into rectangles that are charts of one image, sewn together again.
struct CutSheet {
  Planes3 rest;
  BorderMates mates;
  std::vector<int> uncut;  ///< [n n] the sample of the uncut sheet at each place, -1 in no chart

  /// @param samples  a side of the uncut sheet
  /// @param parts  the rectangles, in samples of the uncut sheet; neighbours share a border
  CutSheet(int samples, const std::vector<Chart>& parts) : samples_(samples), parts_(parts) {
    place_charts();
    BorderMates alone(size_, charts_, {});
    uncut.assign(static_cast<std::size_t>(size_) * size_, -1);
    for (std::size_t k = 0; k < charts_.size(); ++k)
      for (int r = 0; r < charts_[k].rows; ++r)
        for (int c = 0; c < charts_[k].cols; ++c)
          uncut[(charts_[k].row + r) * size_ + charts_[k].col + c] =
              (parts_[k].row + r) * samples_ + parts_[k].col + c;
    mates = BorderMates(size_, charts_, seams(alone));
    const Planes3 whole = flat_sheet(samples);
    rest = Planes3(size_);
    for (int s = 0; s < size_ * size_; ++s)
      rest.set(s, whole.at(uncut[static_cast<std::size_t>(mates.representative(s))]));
  }

  /// The field of the uncut sheet at the samples of this one.
  [[nodiscard]] Planes3 cut(const Planes3& whole) const {
    Planes3 result(size_);
    for (int s = 0; s < size_ * size_; ++s)
      result.set(s, whole.at(uncut[static_cast<std::size_t>(mates.representative(s))]));
    return result;
  }

  /// The sample here of a sample of the uncut sheet.
  [[nodiscard]] int sample_of(int whole) const {
    return static_cast<int>(std::find(uncut.begin(), uncut.end(), whole) - uncut.begin());
  }

 private:
  /// Moves the parts away from each other.
  void place_charts() {
    std::set<int> rows, cols;
    for (const Chart& part : parts_) {
      rows.insert(part.row);
      cols.insert(part.col);
    }
    for (Chart chart : parts_) {
      const auto cuts = [](const std::set<int>& all, int at) {
        return static_cast<int>(std::distance(all.begin(), all.find(at)));
      };
      chart.row += (LevelLayout::gap + 1) * cuts(rows, chart.row);
      chart.col += (LevelLayout::gap + 1) * cuts(cols, chart.col);
      charts_.push_back(chart);
      size_ = std::max({size_, chart.row + chart.rows, chart.col + chart.cols});
    }
  }

  /// The longest runs of border edges that two charts share.
  [[nodiscard]] std::vector<MateInterval> seams(const BorderMates& alone) const {
    const auto place = [&](int position) {
      return uncut[static_cast<std::size_t>(alone.sample_at(position))];
    };
    const auto next = [&](int position) { return alone.along_border(position, 1); };
    std::map<std::pair<int, int>, int> edge_from;  // by its ends in order
    for (int p = 0; p < alone.border_length(); ++p) edge_from[{place(p), place(next(p))}] = p;
    const auto mate_of = [&](int p) {
      const auto found = edge_from.find({place(next(p)), place(p)});
      return found == edge_from.end() ? -1 : next(found->second);
    };
    std::vector<MateInterval> runs;
    for (int p = 0; p < alone.border_length(); ++p) {
      const int mate = mate_of(p);
      if (mate < 0 || alone.chart_of()[static_cast<std::size_t>(alone.sample_at(mate))] <
                          alone.chart_of()[static_cast<std::size_t>(alone.sample_at(p))])
        continue;
      if (!runs.empty() && alone.along_border(runs.back().first, runs.back().count) == p &&
          alone.along_border(runs.back().mate, -runs.back().count) == mate)
        ++runs.back().count;
      else
        runs.push_back({p, mate, 1});
    }
    return runs;
  }

  int samples_, size_ = 0;
  std::vector<Chart> parts_, charts_;
};

/// Four squares.
inline std::vector<Chart> quarters(int samples) {
  const int half = samples / 2 + 1, there = half - 1;
  return {{"", 0, 0, half, half},
          {"", 0, there, half, samples - there},
          {"", there, 0, samples - there, half},
          {"", there, there, samples - there, samples - there}};
}

/// A square between four rectangles, each of which reaches past it.
inline std::vector<Chart> pinwheel(int samples) {
  const int last = samples - 1, x1 = last / 3, x2 = last - last / 4, y1 = last / 4, y2 = last / 2;
  return {{"", 0, 0, y1 + 1, x2 + 1},
          {"", 0, x2, y2 + 1, last - x2 + 1},
          {"", y2, x1, last - y2 + 1, last - x1 + 1},
          {"", y1, 0, last - y1 + 1, x1 + 1},
          {"", y1, x1, y2 - y1 + 1, x2 - x1 + 1}};
}

}  // namespace weft::testing
