#include "weft/collide/contacts/body_query.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/contacts/closest.h"
#include "weft/core/math.h"

namespace weft {
namespace {

double squared_distance(Vec3d p, const Box3f& box) {
  const auto outside = [](double x, float lower, float upper) {
    const double below = lower - x, above = x - upper;
    const double max = below > above ? below : above;
    return max > 0 ? max : 0.0;
  };
  const double x = outside(p.x, box.lower.x, box.upper.x);
  const double y = outside(p.y, box.lower.y, box.upper.y);
  const double z = outside(p.z, box.lower.z, box.upper.z);
  return x * x + y * y + z * z;
}

/// Squared distances to four boxes at once, in single precision.
template <class Boxes>
std::array<float, 4> squared_distances(const std::array<float, 3>& p, const Boxes& boxes) {
  std::array<float, 4> sum{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float x = p[axis];
#pragma omp simd
    for (std::size_t k = 0; k < 4; ++k) {
      const float below = boxes.lower[axis][k] - x, above = x - boxes.upper[axis][k];
      const float max = below > above ? below : above;
      const float outside = max > 0 ? max : 0.0F;
      sum[k] += outside * outside;
    }
  }
  return sum;
}

double angle_between(Vec3d a, Vec3d b) {
  const double lengths = length(a) * length(b);
  return lengths > 0 ? arc_cosine(std::clamp(dot(a, b) / lengths, -1.0, 1.0)) : 0;
}

/// Boxes of cells that lie in no chart are near to nothing.
void hide_missing(const SurfaceGrid& grid, ExtentLevels& boxes, const Worker& worker) {
  const Range mine = worker.share(grid.cells());
  for (int r = mine.first; r < mine.last; ++r)
    for (int c = 0; c < grid.cells(); ++c)
      for (std::size_t k = 0; k < 6 && grid.missing(r * grid.cells() + c); ++k)
        boxes.finest()[k](r, c) = k < 3 ? HUGE_VALF : -HUGE_VALF;
}

}  // namespace

BodyQuery::BodyQuery(const SurfaceGrid& grid) : grid_(&grid), boxes_(grid.cells()) {
  for (const int side : boxes_.sides())
    children_.emplace_back(static_cast<std::size_t>(side) * side);
  find_incident();
}

void BodyQuery::place(const Planes3& positions, ThreadTeam& team) {
  positions_ = &positions;
  team.run([&](Worker& worker) {
    fill_position_extents(positions, positions, boxes_, worker);
    if (grid_->has_missing()) {
      hide_missing(*grid_, boxes_, worker);
      worker.barrier();
    }
    boxes_.fit(worker);
    for (int level = 1; level <= boxes_.top(); ++level) {
      const Range mine = worker.share(boxes_.sides()[level]);
      for (int r = mine.first; r < mine.last; ++r) pack_row(level, r);
    }
  });
}

void BodyQuery::pack_row(int level, int row) {
  const int side = boxes_.sides()[level], below = boxes_.sides()[level - 1];
  for (int c = 0; c < side; ++c) {
    ChildBoxes& packed = children_[level][static_cast<std::size_t>(row) * side + c];
    for (std::size_t k = 0; k < 4; ++k) {
      const Node child{level - 1, 2 * row + static_cast<int>(k / 2),
                       2 * c + static_cast<int>(k % 2)};
      constexpr float far = HUGE_VALF;
      const Box3f box = child.row < below && child.col < below
                            ? boxes_.at(child)
                            : Box3f{{far, far, far}, {far, far, far}};
      const std::array lower{box.lower.x, box.lower.y, box.lower.z};
      const std::array upper{box.upper.x, box.upper.y, box.upper.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        packed.lower[axis][k] = lower[axis];
        packed.upper[axis][k] = upper[axis];
      }
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

/// One search for a closest point.
struct BodyQuery::Search {
  Vec3d point;
  std::array<float, 3> rounded{};
  float absolute_error = 0;  // of a distance to a box [m]
  BodyPoint best;
  float limit = 0;  // boxes beyond this squared distance, in single precision, hold nothing closer

  Search(Vec3d at, double squared_reach)
      : point(at),
        rounded{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)},
        absolute_error(
            static_cast<float>(rounding * (std::abs(at.x) + std::abs(at.y) + std::abs(at.z)))) {
    best.squared_distance = squared_reach;
    set_limit();
  }
  /// Sets the limit slightly above the best distance, so that all of several equally close
  /// triangles are tested.
  void set_limit() {
    const double max = (std::sqrt(best.squared_distance) + absolute_error) * (1 + rounding);
    limit = static_cast<float>(std::min(max * max * (1 + rounding), double{max_finite}));
  }

 private:
  /// Several times the rounding of single precision.
  static constexpr double rounding = 1e-6;
  /// Less than the infinite distance of missing children.
  static constexpr float max_finite = 1e38F;
};

void BodyQuery::try_triangle(int row, int col, int half, Search& search) const noexcept {
  const std::array<int, 3> samples = grid_->triangle(row, col, half);
  const std::array<Vec3d, 3> corners{position(samples[0]), position(samples[1]),
                                     position(samples[2])};
  const std::array<double, 3> w = closest_weights(search.point, corners);
  const Vec3d at = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
  const double squared = squared_length(search.point - at);
  const int triangle = 2 * (row * grid_->cells() + col) + half;
  const BodyPoint& best = search.best;
  const bool closer = squared < best.squared_distance ||
                      (squared == best.squared_distance && triangle < best.triangle);
  if (!closer || grid_->folded(samples)) return;
  search.best = {squared, triangle, samples, w, at};
  search.set_limit();
}

void BodyQuery::search(const Node& node, Search& search) const noexcept {
  if (node.level == 0) {
    const int cell = node.row * grid_->cells() + node.col;
    for (const int half : {0, 1})
      if (2 * cell + half != search.best.triangle) try_triangle(node.row, node.col, half, search);
    return;
  }
  const int side = boxes_.sides()[node.level];
  const std::array<float, 4> squared = squared_distances(
      search.rounded, children_[node.level][static_cast<std::size_t>(node.row) * side + node.col]);
  const auto visit = [&](int k) {
    if (squared[k] <= search.limit)
      this->search({node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2}, search);
  };
  const int nearest =
      static_cast<int>(std::min_element(squared.begin(), squared.end()) - squared.begin());
  visit(nearest);
  for (int k = 0; k < 4; ++k)
    if (k != nearest) visit(k);
}

std::optional<BodyPoint> BodyQuery::closest(Vec3d point, double reach, int hint) const noexcept {
  const Node root{boxes_.top(), 0, 0};
  if (!(squared_distance(point, boxes_.at(root)) < reach * reach)) return std::nullopt;
  Search search(point, reach * reach);
  const int cells = grid_->cells();
  if (hint >= 0) try_triangle(hint / 2 / cells, hint / 2 % cells, hint % 2, search);
  this->search(root, search);
  if (search.best.triangle < 0) return std::nullopt;
  return search.best;
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
