#include "weft/sim/sewing/unpicking.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Seams that are open so long after they should have closed are taken apart, and again each such
/// time. [s]
constexpr double first = 0.6, every = 0.4;
/// So many samples along a seam to both sides of what is stuck are taken apart, too.
constexpr int reach = 3;
/// After so many attempts a garment is left as it is, so that it comes to rest.
constexpr int max_attempts = 12;

int frames_of(double seconds, double length) {
  return std::max(2, static_cast<int>(std::lround(seconds / length)));
}

/// Calls visit(next, second) for the samples one and two steps from one within its panel.
template <class Visit>
void for_ways_inwards(const Garment& garment, int sample, const Visit& visit) {
  const int n = garment.flat.size();
  for (const int step : {-n, -1, 1, n}) {
    const int next = sample + step, second = next + step;
    // Two steps along a row stay in it.
    const bool in_row = std::abs(step) == n || second / n == sample / n;
    if (second >= 0 && second < n * n && in_row && garment.image.mates.same_chart(sample, second))
      visit(next, second);
  }
}

}  // namespace

Vec3d way_inwards(const Garment& garment, int sample, const Planes3& position) {
  Vec3d sum;
  for_ways_inwards(garment, sample, [&](int, int second) {
    sum += vec_cast<double>(position.at(second) - position.at(sample));
  });
  return normalized(sum);
}

Unpicking::Unpicking(const Garment& garment)
    : garment_(garment), chosen_(garment.sewn.class_count()) {}

bool Unpicking::begin_frame(int since, double length) {
  std::fill(chosen_.begin(), chosen_.end(), char{});
  frame_length_ = length;
  const int begun = since - frames_of(first, length), period = frames_of(every, length);
  attempt_ = begun < 0 ? -1 : begun / period;
  return begun >= 0 && begun % period == 0 && attempt_ < max_attempts;
}

void Unpicking::choose(std::span<const std::vector<int>> along, std::span<const char> stuck) {
  for (const std::vector<int>& classes : along) {
    const auto count = static_cast<int>(classes.size());
    for (int i = 0; i < count; ++i)
      for (int j = std::max(0, i - reach); j <= std::min(count - 1, i + reach); ++j)
        if (stuck[classes[i]] != 0) chosen_[classes[j]] = 1;
  }
}

Vec3d Unpicking::retreat_of(int sample, const Planes3& position) const {
  double row = 0;
  for_ways_inwards(garment_, sample, [&](int next, int) {
    row = std::max(row, double{length(garment_.flat.at(next) - garment_.flat.at(sample))});
  });
  // By one row of samples, or by two, in turn.
  const double way = (1 + attempt_ % 2) * row;
  return (way / frame_length_) * way_inwards(garment_, sample, position);
}

}  // namespace weft
