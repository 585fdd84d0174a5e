#include "weft/core/contact_uses.h"

#include <algorithm>

namespace weft {

ContactUses::ContactUses(int samples) : index_(static_cast<std::size_t>(samples)) {}

void ContactUses::clear() {
  for (const Added& added : added_) index_[added.sample] = 0;
  samples_.clear();
  added_.clear();
  starts_.assign(1, 0);
  min_ = static_cast<int>(index_.size());
  max_ = -1;
}

void ContactUses::add(int sample, Use use) {
  added_.push_back({sample, use});
  ++index_[sample];
  min_ = std::min(min_, sample);
  max_ = std::max(max_, sample);
}

void ContactUses::finish() {
  for (int sample = min_; sample <= max_; ++sample) {
    if (index_[sample] == 0) continue;
    starts_.push_back(starts_.back() + index_[sample]);
    index_[sample] = static_cast<int>(samples_.size());
    samples_.push_back(sample);
  }
  uses_.resize(added_.size());
  // Each start serves as the index of the next use, and ends at the start of its neighbour.
  for (const Added& added : added_) uses_[starts_[index_[added.sample]]++] = added.use;
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_[0] = 0;
}

}  // namespace weft
