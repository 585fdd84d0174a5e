#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "weft/contact.h"

namespace weft {

/// Contact history of a cloth: forces and friction at the end of the last step. A contact that
/// persists starts with the friction that it had, like the tangential springs of granular mechanics
/// [cundall79], so that cloth at rest does not creep.
class ContactHistory {
 public:
  /// Drops what has been added since the last step was accepted.
  void start_step() { next_.clear(); }
  /// Adds a contact as it is at the end of the step being solved.
  /// @param second  the other cloth of a shared contact, else -1
  /// @param done  its friction, force and acceleration; the rest is filled from the other arguments
  void add(const Contact& contact, int second, const PastContact& done);
  /// The added contacts become the history of the last step.
  void accept();
  /// The contact of the last step with the same samples and a similar normal; null if there is
  /// none.
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
