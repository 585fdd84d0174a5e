#include <algorithm>
#include <numeric>
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

void check_range(const MateInterval& interval, int around) {
  const auto is_position = [&](int t) { return t >= 0 && t <= around; };
  if (is_position(interval.first) && is_position(interval.mate) && interval.count >= 1 &&
      interval.count <= around / 2)
    return;
  throw InputError(
      "", describe(interval),
      fmt::format("border positions in 0 .. {} and a count in 1 .. {}", around - 1, around / 2));
}

// Marks the border edges from `first` on as mated; one edge has one mate.
void take_edges(std::vector<bool>& taken, int first, const MateInterval& interval) {
  const int around = static_cast<int>(taken.size());
  for (int k = 0; k < interval.count; ++k) {
    const int edge = (first + k) % around;
    if (taken[edge])
      throw InputError("", fmt::format("{} that meet other mates at {}", describe(interval), edge),
                       "runs of border samples that do not overlap");
    taken[edge] = true;
  }
}

}  // namespace

int border_sample(int size, int position) {
  const int side = size - 1;
  const int along = position % side;
  switch (position / side) {
    case 0:
      return along;
    case 1:
      return along * size + side;
    case 2:
      return side * size + side - along;
    default:
      return (side - along) * size;
  }
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
    : size_(size), intervals_(std::move(intervals)) {
  if (size < 2 || size > max_side)
    throw InputError("", fmt::format("an image side of {}", size),
                     fmt::format("2 .. {}", max_side));
  const int around = 4 * (size - 1);
  DisjointSets classes(around);
  std::vector<bool> taken(static_cast<std::size_t>(around), false);
  for (MateInterval& interval : intervals_) {
    check_range(interval, around);
    interval.first %= around;
    interval.mate %= around;
    take_edges(taken, interval.first, interval);
    take_edges(taken, interval.mate + around - interval.count, interval);
    for (int k = 0; k <= interval.count; ++k)
      classes.join((interval.first + k) % around, (interval.mate + around - k) % around);
  }
  // The smallest sample of each class, which need not be at its smallest border position.
  std::vector<int> least(static_cast<std::size_t>(around), size * size);
  for (int t = 0; t < around; ++t) {
    int& sample = least[classes.root(t)];
    sample = std::min(sample, border_sample(size_, t));
  }
  border_representative_.resize(static_cast<std::size_t>(around));
  for (int t = 0; t < around; ++t) border_representative_[t] = least[classes.root(t)];
  collect_classes();
}

void BorderMates::collect_classes() {
  const int around = static_cast<int>(border_representative_.size());
  std::vector<std::pair<int, int>> members;  // representative, sample
  members.reserve(border_representative_.size());
  for (int t = 0; t < around; ++t)
    members.emplace_back(border_representative_[t], border_sample(size_, t));
  std::sort(members.begin(), members.end());
  for (std::size_t i = 0; i < members.size();) {
    std::size_t end = i;
    while (end < members.size() && members[end].first == members[i].first) ++end;
    if (end - i > 1) {
      for (std::size_t k = i; k < end; ++k) samples_.push_back(members[k].second);
      starts_.push_back(static_cast<int>(samples_.size()));
    }
    i = end;
  }
}

int BorderMates::representative(int sample) const {
  if (size_ == 0) return sample;
  const int position = border_position(size_, sample);
  return position < 0 ? sample : border_representative_[position];
}

}  // namespace weft
