#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "weft/contact.h"

namespace weft {

/// What the contacts of a cloth did at the end of the last step, so that cloth at rest stays where
/// it is: one that is found again goes on with the friction that it had, as the tangential springs
/// of granular mechanics do [cundall79].
class ContactHistory {
 public:
  /// Drops what has been added since the last step was accepted.
  void start_step() { next_.clear(); }
  /// Adds what a contact does at the end of the step that is being solved: all but what `contact`
  /// and `second` (the other cloth of a shared one, else -1) tell is in `done`.
  void add(const Contact& contact, int second, const PastContact& done);
  /// What was added becomes the past.
  void accept();
  /// The same samples held by something with much the same normal; null where nothing did.
  [[nodiscard]] const PastContact* find(const Contact& contact, int second) const;

  [[nodiscard]] std::span<const PastContact> past() const { return past_; }
  void restore(std::span<const PastContact> past);

 private:
  void sort();

  struct Entry {
    std::uint64_t key;
    int index;  // in past_
  };
  std::vector<PastContact> past_, next_;
  std::vector<Entry> entries_;  // by key, then by index
};

}  // namespace weft
