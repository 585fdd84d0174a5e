#include "weft/sim/sewing/near_classes.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <utility>

namespace weft {
namespace {

/// Walks over a sewn garment from one class, the nearest samples first.
class ClassWalk {
 public:
  ClassWalk(const Garment& garment, double within)
      : garment_(garment),
        within_(within),
        class_of_(garment.sewn.size() * garment.sewn.size(), -1) {
    for (int k = 0; k < garment.sewn.class_count(); ++k)
      for (const int s : garment.sewn.mates(k)) class_of_[s] = k;
  }

  std::vector<int> from(int index) {
    away_.clear();
    reach(garment_.sewn.copies(index).front(), 0);
    std::vector<int> found;
    while (!open_.empty()) {
      const auto [away, sample] = open_.top();
      open_.pop();
      if (away > away_[sample]) continue;
      if (class_of_[sample] < 0) {
        go_on_from(sample, away);
        continue;
      }
      found.push_back(class_of_[sample]);
      for (const int s : garment_.sewn.copies(class_of_[sample])) go_on_from(s, away);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  void go_on_from(int sample, double away) {
    const int n = garment_.sewn.size();
    for (const int next : {sample - n, sample - 1, sample + 1, sample + n})
      if (next >= 0 && next < n * n && garment_.sewn.same_chart(sample, next))
        reach(next,
              away + length(vec_cast<double>(garment_.flat.at(next) - garment_.flat.at(sample))));
  }

  void reach(int sample, double away) {
    const int at = garment_.sewn.representative(sample);
    const auto [known, is_new] = away_.try_emplace(at, away);
    if (away > within_ || (!is_new && known->second <= away)) return;
    known->second = away;
    open_.emplace(away, at);
  }

  const Garment& garment_;
  double within_;
  std::vector<int> class_of_;   // of each sample; -1: none
  std::map<int, double> away_;  // of those that were reached, by representatives
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
      open_;
};

}  // namespace

std::vector<std::vector<int>> near_classes(const Garment& garment, double within) {
  ClassWalk walk(garment, within);
  std::vector<std::vector<int>> near;
  near.reserve(static_cast<std::size_t>(garment.sewn.class_count()));
  for (int k = 0; k < garment.sewn.class_count(); ++k) near.push_back(walk.from(k));
  return near;
}

}  // namespace weft
