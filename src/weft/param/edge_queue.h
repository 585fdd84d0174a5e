#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// Edge lengths of a mesh, raised by one small amount where it takes that for every triangle to be
/// a true one: each two sides longer than the third by at least 1e-5 of the mean edge (intrinsic
/// mollification, [sharp20]). Zero-area triangles and coincident points then have finite angles and
/// weights. A mesh without slivers keeps its lengths to the last bit.
/// @return [F][3] length of the side from corner k to the next [m], all > 0
std::vector<std::array<double, 3>> floored_lengths(std::span<const Vec3d> positions,
                                                   std::span<const Triangle> triangles);

/// Tangents of the half angles at the corners of a triangle given by its sides.
/// @param sides  length of the side from corner k to the next
/// @return at corner k, in (0, infinity)
std::array<double, 3> half_angle_tangents(const std::array<double, 3>& sides);

/// Edges in the order of their length, to an eighth of an octave of its square; first in first out
/// among those. Takes and gives in constant time, which a heap of a million does not.
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
  /// True when nothing is left; otherwise `pop` has something to give.
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
  /// The bits of a positive double grow with it; these are sign, exponent and three of the rest.
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
