#include "weft/collide/intersections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace weft {
namespace {

using Corners = std::array<Vec3d, 3>;

/// Six times the signed volume of a tetrahedron.
double volume(Vec3d a, Vec3d b, Vec3d c, Vec3d d) { return dot(cross(b - a, c - a), d - a); }

bool opposite(double a, double b) { return (a > 0 && b < 0) || (a < 0 && b > 0); }

/// The segment p-q passes through the inside of the triangle.
bool segment_crosses(Vec3d p, Vec3d q, const Corners& t) {
  if (!opposite(volume(t[0], t[1], t[2], p), volume(t[0], t[1], t[2], q))) return false;
  const double first = volume(p, q, t[0], t[1]);
  const double second = volume(p, q, t[1], t[2]);
  const double third = volume(p, q, t[2], t[0]);
  return (first > 0 && second > 0 && third > 0) || (first < 0 && second < 0 && third < 0);
}

bool edges_cross(const Corners& a, const Corners& b) {
  for (int k = 0; k < 3; ++k)
    if (segment_crosses(a[k], a[(k + 1) % 3], b)) return true;
  return false;
}

Corners corners_of(const GridTriangles& surface, int triangle) {
  Corners corners;
  for (int k = 0; k < 3; ++k)
    corners[k] = vec_cast<double>(surface.positions->at((*surface.triangles)[triangle][k]));
  return corners;
}

Box3d box_of(const Corners& corners) {
  Box3d box;
  for (const Vec3d& p : corners) box.add(p);
  return box;
}

bool overlap(const Box3d& a, const Box3d& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

/// Triangles by the cells of a uniform lattice that their boxes touch, over the box of the surface.
class Lattice {
 public:
  explicit Lattice(const GridTriangles& surface) {
    const int count = static_cast<int>(surface.triangles->size());
    boxes_.reserve(count);
    for (int t = 0; t < count; ++t) {
      boxes_.push_back(box_of(corners_of(surface, t)));
      whole_.add(boxes_.back().lower);
      whole_.add(boxes_.back().upper);
    }
    // About as many cells on the surface as triangles.
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(count) / 4)), 1, 128);
    std::vector<std::pair<int, int>> pairs;
    starts_.assign(static_cast<std::size_t>(side_) * side_ * side_ + 1, 0);
    for (int t = 0; t < count; ++t)
      for_cells(boxes_[t], [&](int cell) {
        ++starts_[cell + 1];
        pairs.emplace_back(cell, t);
      });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    entries_.resize(pairs.size());
    std::vector<int> next(starts_.begin(), starts_.end() - 1);
    for (const auto& [cell, t] : pairs) entries_[next[cell]++] = t;
  }

  /// Triangles whose boxes meet the box, ascending.
  void find(const Box3d& box, std::vector<int>& found) const {
    found.clear();
    if (boxes_.empty() || !overlap(box, whole_)) return;
    for_cells(box, [&](int cell) {
      for (int i = starts_[cell]; i < starts_[cell + 1]; ++i)
        if (overlap(box, boxes_[entries_[i]])) found.push_back(entries_[i]);
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

 private:
  [[nodiscard]] int slot(double value, double lower, double upper) const {
    const double extent = std::max(upper - lower, 1e-300);
    return std::clamp(static_cast<int>(std::floor((value - lower) / extent * side_)), 0, side_ - 1);
  }
  template <class Visit>
  void for_cells(const Box3d& box, const Visit& visit) const {
    const auto range = [&](double Vec3d::*axis) {
      return std::pair{slot(std::clamp(box.lower.*axis, whole_.lower.*axis, whole_.upper.*axis),
                            whole_.lower.*axis, whole_.upper.*axis),
                       slot(std::clamp(box.upper.*axis, whole_.lower.*axis, whole_.upper.*axis),
                            whole_.lower.*axis, whole_.upper.*axis)};
    };
    const auto [x0, x1] = range(&Vec3d::x);
    const auto [y0, y1] = range(&Vec3d::y);
    const auto [z0, z1] = range(&Vec3d::z);
    for (int x = x0; x <= x1; ++x)
      for (int y = y0; y <= y1; ++y)
        for (int z = z0; z <= z1; ++z) visit((x * side_ + y) * side_ + z);
  }

  std::vector<Box3d> boxes_;
  Box3d whole_;
  int side_ = 1;
  std::vector<int> starts_, entries_;
};

}  // namespace

bool triangles_cross(const std::array<Vec3d, 3>& a, const std::array<Vec3d, 3>& b) {
  return edges_cross(a, b) || edges_cross(b, a);
}

int count_intersections(const GridTriangles& a, const GridTriangles& b) {
  const Lattice lattice(b);
  std::vector<int> near;
  int total = 0;
  for (int t = 0; t < static_cast<int>(a.triangles->size()); ++t) {
    const Corners corners = corners_of(a, t);
    lattice.find(box_of(corners), near);
    for (const int other : near) total += triangles_cross(corners, corners_of(b, other)) ? 1 : 0;
  }
  return total;
}

}  // namespace weft
