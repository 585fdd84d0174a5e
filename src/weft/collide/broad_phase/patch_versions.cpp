#include "weft/collide/broad_phase/patch_versions.h"

#include <algorithm>

namespace weft {

PatchVersions::PatchVersions(int cells) {
  for (int nodes = (cells + side - 1) / side;; nodes = (nodes + 1) / 2) {
    sides_.push_back(nodes);
    versions_.emplace_back(static_cast<std::size_t>(nodes) * nodes, -1);
    if (nodes == 1) break;
  }
}

void PatchVersions::set(int row, int col, int version) {
  for (std::size_t l = 0; l < sides_.size(); ++l, row /= 2, col /= 2) {
    int& known = versions_[l][static_cast<std::size_t>(row) * sides_[l] + col];
    if (known == version) return;  // so has all above
    known = version;
  }
}

void PatchVersions::set_all(int version) {
  for (std::vector<int>& nodes : versions_) std::fill(nodes.begin(), nodes.end(), version);
}

void PatchVersions::take(const PatchVersions& from, int version) {
  for (int r = 0; r < patches(); ++r)
    for (int c = 0; c < patches(); ++c)
      if (from.of(r * patches() + c) == version) set(r, c, version);
}

void PatchVersions::set_square(const Node& first, int span, int version) {
  const auto patch_of = [&](int node) { return (node << first.level) >> level; };
  const auto last_patch = [&](int begin) {
    return std::min(patches() - 1, (((begin + span) << first.level) - 1) >> level);
  };
  for (int r = patch_of(first.row); r <= last_patch(first.row); ++r)
    for (int c = patch_of(first.col); c <= last_patch(first.col); ++c) set(r, c, version);
}

}  // namespace weft
