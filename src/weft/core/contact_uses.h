#pragma once

#include <span>
#include <vector>

namespace weft {

/// The contacts that use each sample of a cloth, for gathering their contributions in a fixed
/// order. Refilled for every set of contacts, without allocation once warmed up. Filling is linear
/// in the number of uses, plus a cheap scan from the first to the last used sample.
class ContactUses {
 public:
  struct Use {
    int contact = 0;
    float weight = 0;
  };

  /// @param samples  of the cloth
  explicit ContactUses(int samples);

  // clear, add any number of times, finish; then the rest.
  void clear();
  void add(int sample, Use use);
  void finish();

  /// The samples with uses, ascending.
  [[nodiscard]] std::span<const int> samples() const { return samples_; }
  /// The uses of samples()[index], in the order in which they were added.
  [[nodiscard]] std::span<const Use> of(int index) const {
    return std::span(uses_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }
  /// The index of a used sample in samples().
  [[nodiscard]] int index_of(int sample) const { return index_[sample]; }

 private:
  struct Added {
    int sample = 0;
    Use use;
  };
  std::vector<Added> added_;
  std::vector<int> index_;  // [samples] while adding: number of uses; then: index in samples_
  std::vector<int> samples_, starts_{0};
  std::vector<Use> uses_;
  int min_ = 0, max_ = -1;  // of the samples added
};

}  // namespace weft
