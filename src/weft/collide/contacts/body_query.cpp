#include "weft/collide/contacts/body_query.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/contacts/closest.h"
#include "weft/core/math.h"

namespace weft {
namespace {

double angle_between(Vec3d a, Vec3d b) {
  const double lengths = length(a) * length(b);
  return lengths > 0 ? arc_cosine(std::clamp(dot(a, b) / lengths, -1.0, 1.0)) : 0;
}

BodyNode nothing() {
  BodyNode node{};
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(node.lower[axis], 16, far_away);
    std::fill_n(node.upper[axis], 16, -far_away);
  }
  return node;
}

/// Several times the rounding of single precision.
constexpr double rounding = 1e-6;
/// That of a point's coordinates. [m]
float off_by(Vec3f at) {
  return static_cast<float>(rounding) * (std::abs(at.x) + std::abs(at.y) + std::abs(at.z));
}

}  // namespace

BodyQuery::BodyQuery(const SurfaceGrid& grid) : grid_(&grid) {
  tree_.size = grid.size();
  tree_.leaf_side = (grid.cells() + 1) / 2;
  for (int side = (tree_.leaf_side + 3) / 4;; side = (side + 3) / 4) {
    nodes_.emplace_back(static_cast<std::size_t>(side) * side, nothing());
    tree_.sides[tree_.levels++] = side;
    if (side == 1) break;
  }
  for (int level = 0; level < tree_.levels; ++level) tree_.nodes[level] = nodes_[level].data();
  find_leaves();
  find_incident();
}

/// Finds which triangles the leaves have, each in one leaf.
void BodyQuery::find_leaves() {
  const int side = tree_.leaf_side, cells = grid_->cells();
  leaves_.resize(static_cast<std::size_t>(side) * side);
  tree_.leaves = leaves_.data();
  for (int cell = 0; cell < cells * cells; ++cell) {
    const int row = cell / cells, col = cell % cells;
    BodyLeaf& leaf = leaves_[static_cast<std::size_t>(row / 2) * side + col / 2];
    const int k = 2 * (row - tree_.first_cell(row / 2)) + col - tree_.first_cell(col / 2);
    if (grid_->rises(cell)) leaf.rising |= 1U << k;
    for (const int half : {0, 1})
      if (!grid_->folded(grid_->triangle(cell, half))) leaf.there |= 1U << (k + 4 * half);
  }
}

void BodyQuery::follow(const Planes3& positions) {
  positions_ = &positions;
  tree_.x = positions.x.row(0);
  tree_.y = positions.y.row(0);
  tree_.z = positions.z.row(0);
  tree_.stride = positions.x.stride();
}

void BodyQuery::place(const Planes3& positions, ThreadTeam& team) {
  kernels_ = &body_kernels_for(team.instructions());
  follow(positions);
  const auto side = static_cast<std::size_t>(tree_.leaf_side);
  extents_.resize(2 * side * side);
  team.run([&](Worker& worker) {
    const Range mine = worker.share(tree_.leaf_side);
    for (int r = mine.first; r < mine.last; ++r)
      fit_leaf_row(r, std::span(extents_).subspan(2 * side * r, 2 * side));
    worker.barrier();
    if (worker.rank() != 0) return;
    for (int level = 1; level < tree_.levels; ++level) fit_level(level);
  });
}

void BodyQuery::fit_leaf_row(int row, std::span<float> extents) {
  const int side = tree_.leaf_side, last = tree_.size - 1;
  float *lower = extents.data(), *upper = lower + side;
  const std::array planes{&positions_->x, &positions_->y, &positions_->z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<const float*, 3> rows{};
    for (int k = 0; k < 3; ++k) rows[k] = planes[axis]->row(std::min(2 * row + k, last));
    kernels_->leaf_extents(side, last, rows.data(), lower, upper);
    for (int c = 0; c < side; ++c) {
      if (leaves_[static_cast<std::size_t>(row) * side + c].there == 0) {
        lower[c] = far_away;
        upper[c] = -far_away;
      }
      BodyNode& node = nodes_[0][static_cast<std::size_t>(row / 4) * tree_.sides[0] + c / 4];
      node.lower[axis][4 * (row % 4) + c % 4] = lower[c];
      node.upper[axis][4 * (row % 4) + c % 4] = upper[c];
    }
  }
}

void BodyQuery::fit_level(int level) {
  const int side = tree_.sides[level], below = tree_.sides[level - 1];
  for (int row = 0; row < below; ++row)
    for (int col = 0; col < below; ++col) {
      const BodyNode& child = nodes_[level - 1][static_cast<std::size_t>(row) * below + col];
      BodyNode& node = nodes_[level][static_cast<std::size_t>(row / 4) * side + col / 4];
      const int k = 4 * (row % 4) + col % 4;
      for (int axis = 0; axis < 3; ++axis) {
        node.lower[axis][k] = *std::min_element(child.lower[axis], child.lower[axis] + 16);
        node.upper[axis][k] = *std::max_element(child.upper[axis], child.upper[axis] + 16);
      }
    }
}

void BodyQuery::find_incident() {
  const int n = grid_->size(), cells = grid_->cells();
  starts_.assign(static_cast<std::size_t>(n) * n + 1, 0);
  const auto for_corners = [&](const auto& visit) {
    for (int t = 0; t < 2 * cells * cells; ++t) {
      const std::array<int, 3> triangle = grid_->triangle(t / 2, t % 2);
      if (grid_->folded(triangle)) continue;
      for (const int sample : triangle) visit(grid_->point(sample), t);
    }
  };
  for_corners([&](int point, int) { ++starts_[point + 1]; });
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  incident_.resize(static_cast<std::size_t>(starts_.back()));
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  for_corners([&](int point, int t) { incident_[next[point]++] = t; });
  // Around an inner point every neighbour is in two triangles.
  closed_ = true;
  std::vector<int> around;
  for (int p = 0; p < n * n && closed_; ++p) {
    around.clear();
    for (int i = starts_[p]; i < starts_[p + 1]; ++i)
      for (const int s : grid_->triangle(incident_[i] / 2, incident_[i] % 2))
        if (grid_->point(s) != p) around.push_back(grid_->point(s));
    std::sort(around.begin(), around.end());
    for (std::size_t i = 0; i < around.size() && closed_; i += 2)
      closed_ = i + 1 < around.size() && around[i] == around[i + 1];
  }
}

BodyPoint BodyQuery::point_of(Vec3d point, int triangle) const noexcept {
  const std::array<int, 3> samples = grid_->triangle(triangle / 2, triangle % 2);
  const int first = grid_->first_sample(triangle / 2), row = first / grid_->size();
  // Corners lie in this row and the next one.
  const auto corner = [&](int sample) {
    const int below = sample >= (row + 1) * grid_->size() ? 1 : 0;
    return vec_cast<double>(positions_->at(row + below, sample - (row + below) * grid_->size()));
  };
  const std::array<Vec3d, 3> corners{corner(samples[0]), corner(samples[1]), corner(samples[2])};
  const std::array<double, 3> w = closest_weights(point, corners);
  const Vec3d at = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
  return {squared_length(point - at), triangle, samples, w, at};
}

namespace {

/// Takes a point for the closest one if it is, and else for one of the others.
void add(const BodyPoint& found, NearestPoint& closest) {
  BodyPoint& best = closest.point;
  const bool closer =
      found.squared_distance < best.squared_distance ||
      (found.squared_distance == best.squared_distance && found.triangle < best.triangle);
  if (!closer || best.triangle >= 0)
    closest.others = std::min(closest.others, std::sqrt((closer ? best : found).squared_distance));
  if (closer) best = found;
}

/// How far to look for what may be closer. @param off  rounding of the point [m]
float reach_of(const NearestPoint& closest, float off) {
  const double reach = (std::sqrt(closest.point.squared_distance) + off) * (1 + rounding);
  return static_cast<float>(std::min(reach, double{far_away}));
}

}  // namespace

/// The closest point as far as a hint tells it, if any is given.
void BodyQuery::begin(Vec3d point, double reach, int hint, NearestPoint& closest) const noexcept {
  closest.point.squared_distance = reach * reach;
  closest.point.triangle = -1;
  closest.others = HUGE_VAL;
  if (hint >= 0 && !grid_->folded(grid_->triangle(hint / 2, hint % 2)))
    add(point_of(point, hint), closest);
}

void BodyQuery::search_one(Vec3d point, NearestPoint& closest) const noexcept {
  const Vec3f at = vec_cast<float>(point);
  const float off = off_by(at);
  NearTriangles near;
  kernels_->find_near(tree_, {{at.x, at.y, at.z}, reach_of(closest, off), off}, near);
  if (near.count > NearTriangles::capacity) return add_all(point, closest);
  for (int k = 0; k < near.count; ++k)
    if (near.found[k] != closest.point.triangle) add(point_of(point, near.found[k]), closest);
  closest.others = 0;  // of those the search tells nothing
}

std::optional<BodyPoint> BodyQuery::closest(Vec3d point, double reach, int hint) const noexcept {
  NearestPoint closest;
  begin(point, reach, hint, closest);
  search_one(point, closest);
  if (closest.point.triangle < 0) return std::nullopt;
  return closest.point;
}

/// The points first .. last - 1 of a tile. Where too much is near them their halves are asked for.
void BodyQuery::refine(const NearestTile& tile, Range points,
                       NearestPoints& closest) const noexcept {
  NearTile search;
  search.count = points.last - points.first;
  search.rounding = 0;
  search.beyond = static_cast<float>(tile.beyond);
  for (int k = points.first; k < points.last; ++k)
    search.rounding = std::max(search.rounding, off_by(tile.at[k]));
  for (int i = 0; i < search.count; ++i) {
    const int k = points.first + i;
    search.at[0][i] = tile.at[k].x;
    search.at[1][i] = tile.at[k].y;
    search.at[2][i] = tile.at[k].z;
    search.reach[i] = reach_of(closest[k], search.rounding);
    search.exact[i] = closest[k].point.triangle >= 0;
  }
  TileTriangles near;
  kernels_->find_near_tile(tree_, search, near);
  if (near.count > TileTriangles::capacity) {
    const int middle = (points.first + points.last) / 2;
    if (search.count == 1)
      return search_one(vec_cast<double>(tile.at[points.first]), closest[points.first]);
    refine(tile, {points.first, middle}, closest);
    refine(tile, {middle, points.last}, closest);
    return;
  }
  for (int i = 0; i < search.count; ++i) {
    double& others = closest[points.first + i].others;
    others = std::min(others, double{near.others[i]});
  }
  for (int i = 0; i < near.count; ++i) {
    const int k = points.first + near.found[i].point, triangle = near.found[i].triangle;
    if (triangle != closest[k].point.triangle)
      add(point_of(vec_cast<double>(tile.at[k]), triangle), closest[k]);
  }
}

void BodyQuery::closest(const NearestTile& tile, NearestPoints& found) const noexcept {
  for (int k = 0; k < tile.count; ++k)
    begin(vec_cast<double>(tile.at[k]), tile.reach[k], tile.hint[k], found[k]);
  if (tile.count > 0) refine(tile, {0, tile.count}, found);
}

/// For points that are as far from very many triangles, as the middle of a ball.
void BodyQuery::add_all(Vec3d point, NearestPoint& closest) const noexcept {
  for (int t = 0; t < 2 * grid_->cells() * grid_->cells(); ++t)
    if (!grid_->folded(grid_->triangle(t / 2, t % 2))) add(point_of(point, t), closest);
}

Vec3d BodyQuery::face_normal(const std::array<int, 3>& samples) const noexcept {
  const Vec3d a = position(samples[0]);
  return normalized(cross(position(samples[1]) - a, position(samples[2]) - a));
}

Vec3d BodyQuery::normal_at(const BodyPoint& point) const noexcept {
  // Weights this small are the rounding of a point on an edge or at a corner.
  constexpr double on_edge = 1e-9;
  std::array<int, 3> touched{};
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (point.weights[i] > on_edge) touched[count++] = grid_->point(point.samples[i]);
  if (count == 3) return face_normal(point.samples);
  Vec3d sum;
  for (int i = starts_[touched[0]]; i < starts_[touched[0] + 1]; ++i) {
    const std::array<int, 3> samples = grid_->triangle(incident_[i] / 2, incident_[i] % 2);
    std::size_t corner = 0;
    bool other = count == 1;
    for (std::size_t k = 0; k < 3; ++k) {
      if (grid_->point(samples[k]) == touched[0]) corner = k;
      other = other || grid_->point(samples[k]) == touched[1];
    }
    if (!other) continue;
    const Vec3d at = position(samples[corner]);
    const double weight = count == 2 ? 1
                                     : angle_between(position(samples[(corner + 1) % 3]) - at,
                                                     position(samples[(corner + 2) % 3]) - at);
    sum += weight * face_normal(samples);
  }
  return normalized(sum);
}

bool BodyQuery::behind(Vec3d point, const BodyPoint& closest) const noexcept {
  return dot(point - closest.position, normal_at(closest)) < 0;
}

}  // namespace weft
