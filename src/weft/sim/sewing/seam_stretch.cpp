#include "weft/sim/sewing/seam_stretch.h"

#include <algorithm>

#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// Panels that are stretched by this along their seams, by the median, are not pulled on, and less
/// and less from half of it on: the garment is too narrow. Parts of a seam may be stretched as they
/// are caught in a crease, and are to be pulled out.
constexpr double max_stretch = 0.5;

}  // namespace

SeamStretch::SeamStretch(const Garment& garment, const Planes3& start)
    : garment_(garment),
      stretches_(garment.panel_holds.size()),
      slack_(garment.panel_holds.size(), 1.0) {
  find_slack(start);  // takes the memory that steps need
}

double SeamStretch::of_class(int index, const Planes3& position) const {
  const int n = position.size();
  double most = 0;
  for (const int s : garment_.sewn.copies(index))
    for (const int other : {s - n, s - 1, s + 1, s + n}) {
      if (other < 0 || other >= n * n || !garment_.image.mates.same_chart(s, other)) continue;
      const double rest = length(vec_cast<double>(garment_.flat.at(other) - garment_.flat.at(s)));
      const double now = length(vec_cast<double>(position.at(other) - position.at(s)));
      most = std::max(most, now / rest - 1);
    }
  return most;
}

std::vector<double> SeamStretch::along(std::span<const std::vector<int>> seams,
                                       const Planes3& position) const {
  std::vector<double> means;
  for (const std::vector<int>& classes : seams) {
    double sum = 0;
    for (const int k : classes) sum += of_class(k, position);
    means.push_back(sum / std::max<double>(1, static_cast<double>(classes.size())));
  }
  return means;
}

void SeamStretch::find_slack(const Planes3& position) {
  for (std::vector<double>& stretches : stretches_) stretches.clear();
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    if (garment_.sewn.copies(k).size() < 2) continue;
    const double stretch = of_class(k, position);
    for (const int s : garment_.sewn.copies(k))
      stretches_[panel_of(garment_.image.mates, s)].push_back(stretch);
  }
  for (std::size_t p = 0; p < slack_.size(); ++p) {
    std::vector<double>& stretches = stretches_[p];
    const auto middle = stretches.begin() + static_cast<std::ptrdiff_t>(stretches.size() / 2);
    if (middle == stretches.end()) continue;
    std::nth_element(stretches.begin(), middle, stretches.end());
    slack_[p] = std::clamp(2 - 2 * *middle / max_stretch, 0.0, 1.0);
  }
}

double SeamStretch::slack_of(int index) const {
  double least = 1;
  for (const int s : garment_.sewn.copies(index))
    least = std::min(least, slack_[panel_of(garment_.image.mates, s)]);
  return least;
}

}  // namespace weft
