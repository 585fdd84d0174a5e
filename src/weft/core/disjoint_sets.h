#pragma once

#include <algorithm>
#include <vector>

namespace weft {

/// Disjoint sets of the numbers 0 .. count - 1 (union-find), with an optional parity of each member
/// relative to its set's root. The root is the smallest member.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(int count) { reset(count); }
  /// Makes each number a set of its own. Allocates only for a larger count than ever before.
  void reset(int count) {
    links_.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) links_[i] = {i, 0};
  }
  int root(int i) {
    while (links_[i].parent != i) {
      const Link above = links_[links_[i].parent];
      links_[i] = {above.parent, links_[i].parity ^ above.parity};
      i = links_[i].parent;
    }
    return i;
  }
  /// The parity of a member relative to its root: 0 or 1.
  int parity(int i) {
    const int top = root(i);
    int sum = 0;
    for (; i != top; i = links_[i].parent) sum ^= links_[i].parity;
    return sum;
  }
  /// Joins the sets of two members. @param parity  of one relative to the other
  /// @return whether that is consistent with earlier joins
  bool join(int a, int b, int parity = 0) {
    const int first = root(a), second = root(b);
    const int between = this->parity(a) ^ this->parity(b) ^ parity;
    if (first == second) return between == 0;
    links_[std::max(first, second)] = {std::min(first, second), between};
    return true;
  }

 private:
  struct Link {
    int parent, parity;  // towards the root, and relative to the parent
  };
  std::vector<Link> links_;
};

}  // namespace weft
