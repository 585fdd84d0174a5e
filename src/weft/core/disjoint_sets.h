#pragma once

#include <algorithm>
#include <vector>

namespace weft {

/// Disjoint sets of the numbers 0 .. count - 1 that grow together (union-find), with a parity of
/// each member against its set's root, for those who need one. The root is the least member.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(int count) { reset(count); }
  /// Each alone. Allocates only where more are wanted than ever before.
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
  /// Of a member against its root: 0 or 1.
  int parity(int i) {
    const int top = root(i);
    int sum = 0;
    for (; i != top; i = links_[i].parent) sum ^= links_[i].parity;
    return sum;
  }
  /// Joins the sets of two members. @param parity  of one against the other
  /// @return whether that agrees with what was joined before
  bool join(int a, int b, int parity = 0) {
    const int first = root(a), second = root(b);
    const int between = this->parity(a) ^ this->parity(b) ^ parity;
    if (first == second) return between == 0;
    links_[std::max(first, second)] = {std::min(first, second), between};
    return true;
  }

 private:
  struct Link {
    int parent, parity;  // towards the root, and against the parent
  };
  std::vector<Link> links_;
};

}  // namespace weft
