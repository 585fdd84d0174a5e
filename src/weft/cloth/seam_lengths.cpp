#include "weft/cloth/seam_lengths.h"

#include <algorithm>
#include <tuple>

namespace weft {
namespace {

/// Edges that are more times as long as what they are sewn to are gathered as if they were so many.
constexpr float max_gathered = 4;

bool before(const SeamLength& a, const SeamLength& b) {
  return std::tie(a.from, a.to) < std::tie(b.from, b.to);
}

}  // namespace

SeamLengths::SeamLengths(const Planes3& rest, const BorderMates& mates, int step) : mates_(mates) {
  const int n = mates.size();
  for (int index = 0; index < mates.class_count(); ++index)
    for (const int s : mates.copies(index)) {
      if (s % n + step < n) add(rest, s, s + step);
      if (s / n + step < n) add(rest, s, s + step * n);
    }
  const auto shorter_first = [](const SeamLength& a, const SeamLength& b) {
    return std::tie(a.from, a.to, a.length) < std::tie(b.from, b.to, b.length);
  };
  std::sort(lengths_.begin(), lengths_.end(), shorter_first);
  const auto same = [](const SeamLength& a, const SeamLength& b) {
    return a.from == b.from && a.to == b.to;
  };
  lengths_.erase(std::unique(lengths_.begin(), lengths_.end(), same), lengths_.end());
}

SeamLength SeamLengths::between(int from, int to) const {
  const auto [first, last] = std::minmax({mates_.representative(from), mates_.representative(to)});
  return {first, last};
}

void SeamLengths::add(const Planes3& rest, int from, int to) {
  if (!mates_.same_chart(from, to)) return;
  SeamLength seam = between(from, to);
  if (seam.from == seam.to) return;
  seam.length = spring_length(rest.at(from), rest.at(to));
  lengths_.push_back(seam);
}

float SeamLengths::shortest(int from, int to, float length) const {
  const SeamLength wanted = between(from, to);
  const auto found = std::lower_bound(lengths_.begin(), lengths_.end(), wanted, before);
  if (found == lengths_.end() || before(wanted, *found)) return length;
  return std::clamp(found->length, length / max_gathered, length);
}

}  // namespace weft
