#include "weft/collide/guard/cell_planes.h"

#include <algorithm>

namespace weft {
namespace {

using Samples = std::array<int, 3>;

MovingFeature feature_of(const PlaneSide& side, const Samples& samples, int count) {
  MovingFeature feature;
  feature.count = count;
  feature.body = side.body;
  for (int k = 0; k < count; ++k) {
    feature.start[k] = vec_cast<double>(side.surface.start->at(samples[k]));
    feature.refuge[k] = vec_cast<double>(side.refuge->at(samples[k]));
    feature.end[k] = vec_cast<double>(side.surface.end->at(samples[k]));
    feature.points[k] = side.first_point + side.surface.grid->point(samples[k]);
  }
  return feature;
}

class Finder {
 public:
  Finder(const PlaneSearch& search, std::vector<SeparatingPlane>& out)
      : search_(search), out_(out) {}

  void look_at(const CellPair& cells) {
    if (certain(cells)) return;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        triangles(search_.a.surface.grid->triangle(cells.a, i),
                  search_.b.surface.grid->triangle(cells.b, j));
  }

 private:
  /// Whether the normal direction of one cell keeps the two as wholes apart, whatever their points
  /// do within the slack: spares looking at their triangles.
  [[nodiscard]] bool certain(const CellPair& cells) const {
    const std::array<int, 4> a = search_.a.surface.grid->corners(cells.a);
    const std::array<int, 4> b = search_.b.surface.grid->corners(cells.b);
    // Neighbours in one layer lie beside each other, layers above each other.
    return (search_.same && certain_along(way_between(a, b), a, b)) ||
           certain_along(normal_of(search_.b, b), a, b) ||
           certain_along(normal_of(search_.a, a), a, b);
  }
  [[nodiscard]] Vec3d way_between(const std::array<int, 4>& a, const std::array<int, 4>& b) const {
    Vec3d way;
    for (std::size_t k = 0; k < 4; ++k)
      way += vec_cast<double>(search_.a.surface.start->at(a[k])) -
             vec_cast<double>(search_.b.surface.start->at(b[k]));
    return normalized(way);
  }
  static Vec3d normal_of(const PlaneSide& side, const std::array<int, 4>& s) {
    const auto at = [&](int k) { return vec_cast<double>(side.surface.start->at(s[k])); };
    return normalized(cross(at(1) - at(2), at(3) - at(0)));
  }
  [[nodiscard]] bool certain_along(Vec3d n, const std::array<int, 4>& a,
                                   const std::array<int, 4>& b) const {
    const double wanted = (search_.b.body ? 1 : 2) * search_.options.slack;
    const Bounds start_a = bounds(n, *search_.a.surface.start, a);
    const Bounds start_b = bounds(n, *search_.b.surface.start, b);
    const bool above = start_a.least > start_b.most, below = start_b.least > start_a.most;
    if (!above && !below) return false;
    const Bounds end_a = bounds(n, *search_.a.surface.end, a);
    const Bounds end_b = bounds(n, *search_.b.surface.end, b);
    return (above ? end_a.least - end_b.most : end_b.least - end_a.most) >= wanted;
  }
  struct Bounds {
    double least = HUGE_VAL, most = -HUGE_VAL;
  };
  static Bounds bounds(Vec3d n, const Planes3& at, const std::array<int, 4>& samples) {
    Bounds found;
    for (const int s : samples) {
      const double along = dot(n, vec_cast<double>(at.at(s)));
      found = {std::min(found.least, along), std::max(found.most, along)};
    }
    return found;
  }

  void triangles(const Samples& a, const Samples& b) {
    if (search_.a.surface.grid->folded(a) || search_.b.surface.grid->folded(b)) return;
    if (!search_.same) {
      if (is_inside(a)) return;
      return add(feature_of(search_.a, a, 3), feature_of(search_.b, b, 3));
    }
    Samples order_a = a, order_b = b;
    const int shared = bring_shared_first(order_a, order_b);
    if (shared == 0) return add(feature_of(search_.a, a, 3), feature_of(search_.b, b, 3));
    if (shared > 1) return;
    add(feature_of(search_.a, {order_a[1], order_a[2], 0}, 2), feature_of(search_.b, b, 3));
    add(feature_of(search_.b, {order_b[1], order_b[2], 0}, 2), feature_of(search_.a, a, 3));
  }

  /// @return how many points two triangles share; the (last) one comes first in both
  int bring_shared_first(Samples& a, Samples& b) const {
    const SurfaceGrid& grid = *search_.a.surface.grid;
    int shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        if (grid.point(a[i]) != grid.point(b[j])) continue;
        if (++shared > 1) return shared;
        std::swap(a[0], a[i]);
        std::swap(b[0], b[j]);
      }
    return shared;
  }

  [[nodiscard]] bool is_inside(const Samples& samples) const {
    return search_.inside != nullptr && std::any_of(samples.begin(), samples.end(), [&](int s) {
             return (*search_.inside)[search_.a.surface.grid->point(s)] == search_.body_number;
           });
  }

  void add(const MovingFeature& a, const MovingFeature& b) {
    SeparatingPlane plane;
    if (separate(a, b, search_.options, plane) == Separation::plane) out_.push_back(plane);
  }

  const PlaneSearch& search_;
  std::vector<SeparatingPlane>& out_;
};

}  // namespace

void CellPlanes::find(const PlaneSearch& search, std::span<const CellPair> cells, ThreadTeam& team,
                      std::vector<SeparatingPlane>& out) {
  team.run([&](Worker& worker) {
    found_.fill(
        static_cast<int>(cells.size()), worker,
        [&](int i, std::vector<SeparatingPlane>& mine) { Finder(search, mine).look_at(cells[i]); });
  });
  append(found_, out);
}

}  // namespace weft
