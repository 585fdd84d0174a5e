#pragma once

#include <span>
#include <vector>

namespace weft {

/// Which contacts use each sample of a cloth, so that what contacts do to samples is gathered in a
/// fixed order. Filled anew for every set of contacts; nothing allocates once warmed up. The time
/// to fill grows with the uses, and by little with the samples between the first and the last used.
class ContactUses {
 public:
  struct Use {
    int contact = 0;
    float weight = 0;
  };

  /// @param samples  how many there are
  explicit ContactUses(int samples);

  // clear, add any number of times, finish; then the rest.
  void clear();
  void add(int sample, Use use);
  void finish();

  /// Those with uses, ascending.
  [[nodiscard]] std::span<const int> samples() const { return samples_; }
  /// Of samples()[index], in the order in which they were added.
  [[nodiscard]] std::span<const Use> of(int index) const {
    return std::span(uses_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }
  /// Where a used sample is among samples().
  [[nodiscard]] int index_of(int sample) const { return index_[sample]; }

 private:
  struct Added {
    int sample = 0;
    Use use;
  };
  std::vector<Added> added_;
  std::vector<int> index_;  // [samples] while adding how often it is used; 0 where never
  std::vector<int> samples_, starts_{0};
  std::vector<Use> uses_;
  int least_ = 0, most_ = -1;  // of the samples added
};

}  // namespace weft
