#include "weft/collide/body_query.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/closest.h"
#include "weft/core/math.h"

namespace weft {
namespace {

/// Boxes are in single precision and exact, distances to them are rounded.
double squared_distance(Vec3d p, const Box3f& box) {
  const auto beyond = [](double x, float lower, float upper) {
    return std::max({lower - x, x - upper, 0.0});
  };
  const double x = beyond(p.x, box.lower.x, box.upper.x);
  const double y = beyond(p.y, box.lower.y, box.upper.y);
  const double z = beyond(p.z, box.lower.z, box.upper.z);
  return x * x + y * y + z * z;
}

double angle_between(Vec3d a, Vec3d b) {
  const double lengths = length(a) * length(b);
  return lengths > 0 ? arc_cosine(std::clamp(dot(a, b) / lengths, -1.0, 1.0)) : 0;
}

}  // namespace

BodyQuery::BodyQuery(const SurfaceGrid& grid) : grid_(&grid), boxes_(grid.cells()) {
  find_incident();
}

void BodyQuery::place(const Planes3& positions, ThreadTeam& team) {
  positions_ = &positions;
  team.run([&](Worker& worker) {
    fill_position_extents(positions, positions, boxes_, worker);
    boxes_.fit(worker);
  });
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
  // Around an inner point every neighbour stands in two triangles.
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

void BodyQuery::try_cell(Vec3d point, int cell, BodyPoint& best) const noexcept {
  for (int half = 0; half < 2; ++half) {
    const std::array<int, 3> samples = grid_->triangle(cell, half);
    const std::array<Vec3d, 3> corners{position(samples[0]), position(samples[1]),
                                       position(samples[2])};
    const std::array<double, 3> w = closest_weights(point, corners);
    const Vec3d at = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
    const double squared = squared_length(point - at);
    if (squared < best.squared_distance && !grid_->folded(samples))
      best = {squared, samples, w, at};
  }
}

void BodyQuery::search(Vec3d point, const Node& node, BodyPoint& best) const noexcept {
  if (node.level == 0) return try_cell(point, node.row * grid_->cells() + node.col, best);
  struct Candidate {
    double squared;
    Node node;
  };
  std::array<Candidate, 4> children{};
  std::size_t count = 0;
  for_children(node, boxes_.sides(), [&](const Node& child) {
    const double squared = squared_distance(point, boxes_.at(child));
    if (!(squared < best.squared_distance)) return;
    std::size_t at = count++;
    for (; at > 0 && squared < children[at - 1].squared; --at) children[at] = children[at - 1];
    children[at] = {squared, child};
  });
  for (std::size_t i = 0; i < count; ++i)
    if (children[i].squared < best.squared_distance) search(point, children[i].node, best);
}

std::optional<BodyPoint> BodyQuery::closest(Vec3d point, double reach) const noexcept {
  BodyPoint best;
  best.squared_distance = reach * reach;
  const Node root{boxes_.top(), 0, 0};
  if (squared_distance(point, boxes_.at(root)) < best.squared_distance) search(point, root, best);
  if (!(best.squared_distance < reach * reach)) return std::nullopt;
  return best;
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
