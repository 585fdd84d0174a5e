#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace weft {

/// Bucket queue of edges, shortest first: buckets are an eighth of an octave of the squared length
/// wide, first in first out inside. `push` and `pop` take constant time, unlike those of a heap.
class LengthQueue {
 public:
  using Edge = std::array<int, 2>;

  LengthQueue() : buckets_(bucket_count) {}

  void push(double squared_length, Edge edge) {
    const auto bucket =
        static_cast<std::size_t>(std::bit_cast<std::uint64_t>(squared_length) >> dropped_bits);
    buckets_[bucket].edges.push_back(edge);
    lowest_ = std::min(lowest_, bucket);
  }
  /// Whether no edge is left. Advances to the next filled bucket, so it must be called before every
  /// `pop`.
  [[nodiscard]] bool empty() {
    while (lowest_ < bucket_count && buckets_[lowest_].is_spent()) buckets_[lowest_++] = {};
    return lowest_ == bucket_count;
  }
  /// @pre not empty
  Edge pop() {
    Bucket& bucket = buckets_[lowest_];
    return bucket.edges[bucket.taken++];
  }

 private:
  /// The bits of a positive double, read as an integer, grow with it. A bucket index keeps sign,
  /// exponent and three bits of the significand.
  static constexpr int dropped_bits = 49;
  static constexpr std::size_t bucket_count = std::size_t{1} << (63 - dropped_bits);
  struct Bucket {
    std::vector<Edge> edges;
    std::size_t taken = 0;
    [[nodiscard]] bool is_spent() const { return taken == edges.size(); }
  };
  std::vector<Bucket> buckets_;
  std::size_t lowest_ = bucket_count;
};

}  // namespace weft
