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
  void hash_all();

  struct Slot {
    std::uint32_t tag = 0;  // upper half of the key
    int index = -1;         // in past_; -1: the slot is free
  };
  std::vector<PastContact> past_, next_;
  std::vector<Slot> slots_;  // each contact in the first free one from the lower half of its key on
};

}  // namespace weft
