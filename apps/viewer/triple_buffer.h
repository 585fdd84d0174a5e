#pragma once

#include <array>
#include <atomic>

namespace weft::viewer {

/// Hands values from one thread that writes to one that reads, neither ever waiting for the other:
/// the reader gets the newest whole value, those in between are lost. Three values stay where they
/// are, so that what they hold is allocated once.
template <class T>
class TripleBuffer {
 public:
  /// Of the writer: what to fill before `publish`; holds what was published some time ago.
  [[nodiscard]] T& back() { return values_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & place; }

  /// Of the reader: the newest value that `update` has found.
  [[nodiscard]] const T& front() const { return values_[front_]; }
  /// @return whether front() is another value now
  bool update() {
    if ((middle_.load(std::memory_order_relaxed) & fresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & place;
    return true;
  }

 private:
  static constexpr unsigned place = 3, fresh = 4;
  std::array<T, 3> values_{};
  unsigned back_ = 0, front_ = 2;
  std::atomic<unsigned> middle_{1};
};

}  // namespace weft::viewer
