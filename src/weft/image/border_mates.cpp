#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "weft/core/disjoint_sets.h"
#include "weft/error.h"
#include "weft/geometry_image.h"

namespace weft {
namespace {

// Sample indices row * n + col fit an int up to here.
constexpr int max_side = 46340;

std::string describe(const MateInterval& interval) {
  return fmt::format("mates {} {} {}", interval.first, interval.mate, interval.count);
}

std::string describe(const Chart& chart) {
  return fmt::format("chart '{}' of {} x {} samples at ({}, {})", chart.name, chart.rows,
                     chart.cols, chart.row, chart.col);
}

void check_size(int size) {
  if (size < 2 || size > max_side)
    throw InputError("", fmt::format("an image side of {}", size),
                     fmt::format("2 .. {}", max_side));
}

int chart_border_sample(const Chart& chart, int size, int position) {
  const int right = chart.cols - 1, down = chart.rows - 1;
  const auto at = [&](int row, int col) { return (chart.row + row) * size + chart.col + col; };
  if (position < right) return at(0, position);
  if (position < right + down) return at(position - right, right);
  if (position < 2 * right + down) return at(down, 2 * right + down - position);
  return at(2 * (right + down) - position, 0);
}

}  // namespace

int border_sample(int size, int position) {
  return chart_border_sample({"", 0, 0, size, size}, size, position);
}

int border_position(int size, int sample) {
  const int side = size - 1;
  const int row = sample / size;
  const int col = sample % size;
  if (row == 0) return col;
  if (col == side) return side + row;
  if (row == side) return 3 * side - col;
  if (col == 0) return 4 * side - row;
  return -1;
}

BorderMates::BorderMates(int size, std::vector<MateInterval> intervals)
    : size_(size), charts_{{"", 0, 0, size, size}}, intervals_(std::move(intervals)) {
  check_size(size);
  place_charts();
  join(false);
}

BorderMates::BorderMates(int size, std::vector<Chart> charts, std::vector<MateInterval> intervals)
    : size_(size), charts_(std::move(charts)), intervals_(std::move(intervals)) {
  check_size(size);
  if (charts_.empty()) throw InputError("", "an image without charts", "at least one is wanted");
  const bool is_whole = charts_.size() == 1 && charts_[0].rows == size && charts_[0].cols == size;
  if (!is_whole) chart_of_.assign(static_cast<std::size_t>(size) * size, -1);
  place_charts();
  join(true);
}

void BorderMates::place_charts() {
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    const Chart& chart = charts_[k];
    const bool inside = chart.row >= 0 && chart.col >= 0 && chart.rows <= size_ - chart.row &&
                        chart.cols <= size_ - chart.col;
    const int least = chart_of_.empty() ? 2 : min_image_size;
    if (!inside || chart.rows < least || chart.cols < least)
      throw InputError(
          "", describe(chart),
          fmt::format("charts of {} samples a side and more within {} x {}", least, size_, size_));
    for (int r = chart.row; r < chart.row + chart.rows && !chart_of_.empty(); ++r)
      for (int c = chart.col; c < chart.col + chart.cols; ++c) {
        int& owner = chart_of_[static_cast<std::size_t>(r) * size_ + c];
        if (owner >= 0)
          throw InputError("", describe(chart) + " that overlaps another",
                           "charts side by side are wanted");
        owner = static_cast<int>(k);
      }
    for (int t = 0; t < chart.border_length(); ++t)
      border_samples_.push_back(chart_border_sample(chart, size_, t));
    first_position_.push_back(static_cast<int>(border_samples_.size()));
  }
}

void BorderMates::check(const MateInterval& interval, bool overlapping) const {
  const int positions = border_length();
  const auto is_position = [&](int t) { return t >= 0 && t <= positions; };
  int most = positions;
  for (const int position : {interval.first, interval.mate}) {
    const auto above =
        std::upper_bound(first_position_.begin(), first_position_.end() - 1, position);
    if (is_position(position) && above != first_position_.end() - 1)
      most = std::min(most, *above - *(above - 1));
    else if (is_position(position))
      most = std::min(most, positions - *(above - 1));
  }
  if (!overlapping) most /= 2;
  if (is_position(interval.first) && is_position(interval.mate) && interval.count >= 1 &&
      interval.count <= most)
    return;
  throw InputError(
      "", describe(interval),
      fmt::format("border positions in 0 .. {} and a count in 1 .. {}", positions - 1, most));
}

void BorderMates::join(bool overlapping) {
  const int positions = border_length();
  DisjointSets classes(positions);
  std::vector<bool> taken(static_cast<std::size_t>(positions), false);
  // A border edge is called by the position that it begins at; one has one mate.
  const auto take = [&](int edge, const MateInterval& interval) {
    if (taken[edge] && !overlapping)
      throw InputError("", fmt::format("{} that meet other mates at {}", describe(interval), edge),
                       "runs of border samples that do not overlap are wanted");
    keep_manifold_ = keep_manifold_ && !taken[edge] && !interval.turned;
    taken[edge] = true;
  };
  // A border of m charts is joined by m - 1 runs: more than all borders together is no use.
  std::int64_t joined = 0;
  for (MateInterval& interval : intervals_) {
    check(interval, overlapping);
    joined += interval.count;
    if (joined > positions)
      throw InputError("", fmt::format("runs of mates of more than {} intervals", positions),
                       "each border edge joined once is wanted");
    const int back = interval.turned ? 1 : -1;
    interval.first = along_border(interval.first, 0);
    interval.mate = along_border(interval.mate, 0);
    for (int k = 0; k < interval.count; ++k) take(along_border(interval.first, k), interval);
    for (int k = 0; k < interval.count; ++k)
      take(along_border(interval.mate, interval.turned ? k : -k - 1), interval);
    for (int k = 0; k <= interval.count; ++k)
      classes.join(along_border(interval.first, k), along_border(interval.mate, back * k));
  }
  // Of each class its least sample, which need not lie at its least position.
  std::vector<int> least(static_cast<std::size_t>(positions), size_ * size_);
  for (int t = 0; t < positions; ++t) {
    int& sample = least[classes.root(t)];
    sample = std::min(sample, border_samples_[t]);
  }
  border_representative_.resize(static_cast<std::size_t>(positions));
  for (int t = 0; t < positions; ++t) border_representative_[t] = least[classes.root(t)];
  if (!chart_of_.empty()) shelter_holes();
  collect_classes();
}

void BorderMates::shelter_holes() {
  representative_.resize(chart_of_.size());
  for (int s = 0; s < size_ * size_; ++s) representative_[s] = s;
  for (int t = 0; t < border_length(); ++t)
    representative_[border_samples_[t]] = border_representative_[t];
  for (int s = 0; s < size_ * size_; ++s) {
    if (!is_hole(s)) continue;
    const int left = s % size_ > 0 ? s - 1 : -1, above = s >= size_ ? s - size_ : -1;
    representative_[s] = left >= 0    ? representative_[left]
                         : above >= 0 ? representative_[above]
                                      : border_representative_[0];
  }
}

void BorderMates::collect_classes() {
  struct Member {
    int representative, is_hole, sample;
    auto operator<=>(const Member&) const = default;
  };
  std::vector<Member> members;
  members.reserve(border_representative_.size());
  for (int t = 0; t < border_length(); ++t)
    members.push_back({border_representative_[t], 0, border_samples_[t]});
  for (int s = 0; s < static_cast<int>(chart_of_.size()); ++s)
    if (is_hole(s)) members.push_back({representative_[s], 1, s});
  std::sort(members.begin(), members.end());
  for (std::size_t i = 0; i < members.size();) {
    std::size_t end = i;
    while (end < members.size() && members[end].representative == members[i].representative) ++end;
    if (end - i > 1) {
      for (std::size_t k = i; k < end; ++k) samples_.push_back(members[k].sample);
      starts_.push_back(static_cast<int>(samples_.size()));
    }
    i = end;
  }
}

std::span<const int> BorderMates::copies(int index) const {
  const std::span<const int> all = mates(index);
  if (chart_of_.empty()) return all;
  const auto first_hole =
      std::partition_point(all.begin(), all.end(), [&](int s) { return !is_hole(s); });
  return all.first(static_cast<std::size_t>(first_hole - all.begin()));
}

int BorderMates::along_border(int position, int steps) const {
  const auto above = std::upper_bound(first_position_.begin(), first_position_.end() - 1, position);
  const int begin = *(above - 1);
  const int around = (above == first_position_.end() - 1 ? border_length() : *above) - begin;
  return begin + ((position - begin + steps) % around + around) % around;
}

int BorderMates::representative(int sample) const {
  if (!representative_.empty()) return representative_[static_cast<std::size_t>(sample)];
  if (size_ == 0) return sample;
  const int position = border_position(size_, sample);
  return position < 0 ? sample : border_representative_[position];
}

}  // namespace weft
