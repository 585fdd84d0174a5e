// The same for the points of a tile. The leaves that are near any of them are found and prepared
// once; then each point looks at those that are near it.
#include <cmath>

#include "weft/collide/kernels/isa/body_leaf.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// The leaves near a tile.
struct Leaves {
  static constexpr int capacity = 64;
  alignas(64) float lower[3][capacity];
  alignas(64) float upper[3][capacity];
  unsigned place[capacity];
  bool ready[capacity];  // whether it is prepared
  PreparedLeaf prepared[capacity];
  int count = 0;
  bool full = false;
};

/// Adds the leaves below a node that are near.
void collect(const BodyTree& tree, const Box& box, float limit, unsigned place, Leaves& out) {
  const int level = level_of(place), row = row_of(place), col = col_of(place);
  const BodyNode& node = tree.nodes[level][static_cast<long>(row) * tree.sides[level] + col];
  float squared[16];
  distances(box, node, squared);
  unsigned near = within_node(squared, limit);
  for (; near != 0 && !out.full; near &= near - 1) {
    const int k = __builtin_ctz(near);
    const unsigned child = place_of(level - 1, 4 * row + k / 4, 4 * col + k % 4);
    if (level > 0) {
      collect(tree, box, limit, child, out);
      continue;
    }
    out.full = out.count == Leaves::capacity;
    if (out.full) return;
    const int at = out.count++;
    for (int axis = 0; axis < 3; ++axis) {
      out.lower[axis][at] = node.lower[axis][k];
      out.upper[axis][at] = node.upper[axis][k];
    }
    out.place[at] = child;
    out.ready[at] = false;
  }
}

/// Fills up to a whole number of vectors with what is far from everything.
void pad(Leaves& leaves) {
  for (int k = leaves.count; k % 16 != 0; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      leaves.lower[axis][k] = far_away;
      leaves.upper[axis][k] = -far_away;
    }
}

/// Squared distances of a point to sixteen leaves' boxes.
inline void distances(const Leaves& leaves, int first, const float* at, float* squared) {
  const float *lx = leaves.lower[0] + first, *hx = leaves.upper[0] + first;
  const float *ly = leaves.lower[1] + first, *hy = leaves.upper[1] + first;
  const float *lz = leaves.lower[2] + first, *hz = leaves.upper[2] + first;
  const float px = at[0], py = at[1], pz = at[2];
#pragma omp simd
  for (int k = 0; k < 16; ++k) {
    const float below_x = lx[k] - px, below_y = ly[k] - py, below_z = lz[k] - pz;
    const float above_x = px - hx[k], above_y = py - hy[k], above_z = pz - hz[k];
    const float x = max(max(below_x, above_x), 0), y = max(max(below_y, above_y), 0),
                z = max(max(below_z, above_z), 0);
    squared[k] = x * x + y * y + z * z;
  }
}

/// One point and what is near it.
class PointSearch {
 public:
  PointSearch(const BodyTree& tree, Leaves& leaves, const NearTile& tile, int point);
  void run(TileTriangles& out);

 private:
  void set_limit(float squared);
  const PreparedLeaf& prepared(int leaf);
  void test_leaf(int leaf);
  void test_all_leaves();
  void add(int leaf, const float* lower, TileTriangles& out);

  const BodyTree& tree_;
  Leaves& leaves_;
  const NearTile& tile_;
  int point_;
  float at_[3];
  float rounding_;                               // of squared distances [m^2]
  float limit_, box_limit_;                      // see body_tree.cpp
  alignas(64) float squared_[Leaves::capacity];  // of the leaves' boxes [m^2]
  alignas(64) float others_[lanes];              // of triangles that were passed by [m^2]
};

PointSearch::PointSearch(const BodyTree& tree, Leaves& leaves, const NearTile& tile, int point)
    : tree_(tree),
      leaves_(leaves),
      tile_(tile),
      point_(point),
      at_{tile.at[0][point], tile.at[1][point], tile.at[2][point]},
      rounding_(of_rounding * tile.rounding * tile.rounding) {
  for (float& other : others_) other = far_away * far_away;
  set_limit(tile.reach[point] * tile.reach[point] * (1 + part_of_distance) + rounding_);
}

void PointSearch::set_limit(float squared) {
  limit_ = squared;
  const float far = std::sqrt(squared) + tile_.beyond + 2 * tile_.rounding;
  box_limit_ = far * far * (1 + part_of_distance);
}

const PreparedLeaf& PointSearch::prepared(int leaf) {
  const unsigned place = leaves_.place[leaf];
  if (!leaves_.ready[leaf]) prepare(tree_, row_of(place), col_of(place), leaves_.prepared[leaf]);
  leaves_.ready[leaf] = true;
  return leaves_.prepared[leaf];
}

void PointSearch::test_leaf(int leaf) {
  LeafBounds bounds;
  bound<true>(prepared(leaf), at_, bounds);
  const float least = least_of(bounds.upper) + rounding_;
  if (least < limit_) set_limit(least);
}

/// Lowers the limit, the nearest leaf first, since it is likely to put most of the others out of
/// the question.
void PointSearch::test_all_leaves() {
  float least = far_away * far_away;
  for (int l = 0; l < leaves_.count; ++l) least = min(least, squared_[l]);
  for (int begin = 0; begin < leaves_.count; begin += 16)
    if (const unsigned nearest = within_node(squared_ + begin, min(least, box_limit_));
        nearest != 0)
      test_leaf(begin + __builtin_ctz(nearest));
  for (int begin = 0; begin < leaves_.count; begin += 16)
    for (unsigned near = within_node(squared_ + begin, limit_); near != 0; near &= near - 1)
      if (const int l = begin + __builtin_ctz(near); squared_[l] > least && squared_[l] <= limit_)
        test_leaf(l);
}

void PointSearch::add(int leaf, const float* lower, TileTriangles& out) {
  const unsigned place = leaves_.place[leaf];
  for (unsigned near = within(lower, limit_); near != 0; near &= near - 1) {
    if (out.count < TileTriangles::capacity)
      out.found[out.count] = {
          point_, triangle_of(tree_, row_of(place), col_of(place), __builtin_ctz(near))};
    ++out.count;
  }
}

void PointSearch::run(TileTriangles& out) {
  for (int first = 0; first < leaves_.count; first += 16)
    distances(leaves_, first, at_, squared_ + first);
  if (!tile_.exact[point_]) test_all_leaves();
  for (int begin = 0; begin < leaves_.count; begin += 16)
    for (unsigned near = within_node(squared_ + begin, box_limit_); near != 0; near &= near - 1) {
      const int l = begin + __builtin_ctz(near);
      LeafBounds bounds;
      bound<false>(prepared(l), at_, bounds);
      pass_by(bounds.lower, limit_, others_);
      add(l, bounds.lower, out);
    }
  // What was not looked at is beyond the limit of boxes.
  const float others = min(least_of(others_), (1 - part_of_distance) * box_limit_);
  out.others[point_] = std::sqrt(max(others - rounding_, 0));
}

}  // namespace

void find_near_tile(const BodyTree& tree, const NearTile& tile, TileTriangles& out) {
  Box box{{far_away, far_away, far_away}, {-far_away, -far_away, -far_away}};
  float reach = 0;
  for (int k = 0; k < tile.count; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = min(box.lower[axis], tile.at[axis][k]);
      box.upper[axis] = max(box.upper[axis], tile.at[axis][k]);
    }
    reach = max(reach, tile.reach[k]);
  }
  const float far = reach + tile.beyond + 3 * tile.rounding;
  Leaves leaves;
  out.count = 0;
  if (far < far_away)
    collect(tree, box, far * far * (1 + 2 * part_of_distance), place_of(tree.levels - 1, 0, 0),
            leaves);
  if (leaves.full || !(far < far_away)) {
    out.count = TileTriangles::capacity + 1;
    return;
  }
  pad(leaves);
  for (int k = 0; k < tile.count; ++k) PointSearch(tree, leaves, tile, k).run(out);
}

}  // namespace weft::WEFT_KERNEL_SET
