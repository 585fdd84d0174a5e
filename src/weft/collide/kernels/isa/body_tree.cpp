// The search for the triangles of a body that may be closest to a point.
#include <cmath>

#include "weft/collide/kernels/isa/body_leaf.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// A search on its way down the tree.
class Descent {
 public:
  Descent(const BodyTree& tree, const NearSearch& search, NearTriangles& out);
  void run();

 private:
  void set_limit(float squared);
  void push(const Waiting& one, int first);
  void visit_children(unsigned place);
  void visit_leaf(unsigned place);
  void add(int triangle, float squared);
  void drop_far();

  const BodyTree& tree_;
  const NearSearch& search_;
  NearTriangles& out_;
  float rounding_;                          // of squared distances [m^2]
  float limit_ = 0;                         // triangles beyond are not the closest, squared [m^2]
  float box_limit_ = 0;                     // boxes beyond are not looked into, squared [m^2]
  float squared_[NearTriangles::capacity];  // lower bounds of what was found [m^2]
  Waiting waiting_[16 * BodyTree::max_levels + 1];  // of children, the nearest on top
  int count_ = 0;
};

Descent::Descent(const BodyTree& tree, const NearSearch& search, NearTriangles& out)
    : tree_(tree),
      search_(search),
      out_(out),
      rounding_(of_rounding * search.rounding * search.rounding) {
  set_limit(search.reach < far_away ? search.reach * search.reach * (1 + part_of_distance)
                                    : far_away * far_away);
  out.count = 0;
}

void Descent::set_limit(float squared) {
  limit_ = squared;
  const float far = std::sqrt(squared) + 2 * search_.rounding;
  box_limit_ = far < far_away ? far * far * (1 + part_of_distance) : far_away * far_away;
}

/// Below those that were pushed since there were `first` and are nearer.
void Descent::push(const Waiting& one, int first) {
  int at = count_++;
  for (; at > first && waiting_[at - 1].squared < one.squared; --at)
    waiting_[at] = waiting_[at - 1];
  waiting_[at] = one;
}

/// Forgets what later findings have put out of the question.
void Descent::drop_far() {
  int kept = 0;
  for (int k = 0; k < out_.count; ++k) {
    if (!(squared_[k] <= limit_)) continue;
    squared_[kept] = squared_[k];
    out_.found[kept++] = out_.found[k];
  }
  out_.count = kept;
}

void Descent::add(int triangle, float squared) {
  // Once there were too many, what was left out is not known any more.
  if (out_.count > NearTriangles::capacity) return;
  if (out_.count == NearTriangles::capacity) drop_far();
  const int at = out_.count++;
  if (at == NearTriangles::capacity) return;
  out_.found[at] = triangle;
  squared_[at] = squared;
}

void Descent::visit_leaf(unsigned place) {
  const int row = row_of(place), col = col_of(place);
  PreparedLeaf leaf;
  prepare(tree_, row, col, leaf);
  LeafBounds bounds;
  bound<true>(leaf, search_.at, bounds);
  const float least = least_of(bounds.upper) + rounding_;
  if (least < limit_) set_limit(least);
  unsigned near = within(bounds.lower, limit_);
  for (; near != 0; near &= near - 1) {
    const int k = __builtin_ctz(near);
    add(triangle_of(tree_, row, col, k), bounds.lower[k]);
  }
}

void Descent::visit_children(unsigned place) {
  const int level = level_of(place), row = row_of(place), col = col_of(place);
  float squared[16];
  const float* at = search_.at;
  distances(Box{{at[0], at[1], at[2]}, {at[0], at[1], at[2]}},
            tree_.nodes[level][static_cast<long>(row) * tree_.sides[level] + col], squared);
  unsigned near = within_node(squared, box_limit_);
  const int first = count_;
  for (; near != 0; near &= near - 1) {
    const int k = __builtin_ctz(near);
    push({squared[k], place_of(level - 1, 4 * row + k / 4, 4 * col + k % 4)}, first);
  }
}

void Descent::run() {
  push({0, place_of(tree_.levels - 1, 0, 0)}, 0);
  while (count_ > 0) {
    const Waiting next = waiting_[--count_];
    if (!(next.squared <= box_limit_)) continue;
    if (level_of(next.place) < 0)
      visit_leaf(next.place);
    else
      visit_children(next.place);
  }
  if (out_.count <= NearTriangles::capacity) drop_far();
}

}  // namespace

void find_near(const BodyTree& tree, const NearSearch& search, NearTriangles& out) {
  Descent(tree, search, out).run();
}

void leaf_extents(int leaves, int last, const float* const* rows, float* lower, float* upper) {
  const float *a = rows[0], *b = rows[1], *c = rows[2];
  const auto least = [](float x, float y, float z) { return min(x, min(y, z)); };
  const auto most = [](float x, float y, float z) { return max(x, max(y, z)); };
#pragma omp simd
  for (int k = 0; k < leaves - 1; ++k) {
    const int s = 2 * k;
    lower[k] = least(least(a[s], b[s], c[s]), least(a[s + 1], b[s + 1], c[s + 1]),
                     least(a[s + 2], b[s + 2], c[s + 2]));
    upper[k] = most(most(a[s], b[s], c[s]), most(a[s + 1], b[s + 1], c[s + 1]),
                    most(a[s + 2], b[s + 2], c[s + 2]));
  }
  const int k = leaves - 1;
  lower[k] = far_away;
  upper[k] = -far_away;
  for (int s = 2 * k; s <= last; ++s) {
    lower[k] = min(lower[k], least(a[s], b[s], c[s]));
    upper[k] = max(upper[k], most(a[s], b[s], c[s]));
  }
}

}  // namespace weft::WEFT_KERNEL_SET
