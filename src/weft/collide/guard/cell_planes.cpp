#include "weft/collide/guard/cell_planes.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/pairs/cell_gaps.h"

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
  /// Whether the two as wholes keep apart, whatever their points do within the slack: spares
  /// looking at their triangles.
  [[nodiscard]] bool certain(const CellPair& cells) const {
    const double wanted = (search_.b.body ? 1 : 2) * search_.options.slack;
    return CellGaps(search_.a.surface, cells.a, search_.b.surface, cells.b).apart(0, wanted);
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
    edge_and_triangle(search_.a, order_a, search_.b, order_b);
    edge_and_triangle(search_.b, order_b, search_.a, order_a);
  }

  /// Two triangles whose first corner is one point: the far edge of one with the other as a whole.
  void edge_and_triangle(const PlaneSide& edge, const Samples& of_edge, const PlaneSide& triangle,
                         const Samples& of_triangle) {
    if (beside(of_edge, of_triangle)) return;
    add(feature_of(edge, {of_edge[1], of_edge[2], 0}, 2), feature_of(triangle, of_triangle, 3));
  }

  /// Whether the way between their middles certainly keeps the two apart, as neighbours in a layer
  /// nearly always lie; told in single precision, seen from the common corner.
  [[nodiscard]] bool beside(const Samples& of_edge, const Samples& of_triangle) const {
    const Vec3f origin = search_.a.surface.start->at(of_triangle[0]);
    const auto seen = [&](const Planes3& at) {
      return SeenPair{{at.at(of_edge[1]) - origin, at.at(of_edge[2]) - origin},
                      {at.at(of_triangle[0]) - origin, at.at(of_triangle[1]) - origin,
                       at.at(of_triangle[2]) - origin}};
    };
    const SeenPair start = seen(*search_.a.surface.start);
    const Vec3f way =
        3.0F * (start.edge[0] + start.edge[1]) - 2.0F * (start.triangle[1] + start.triangle[2]);
    const float size = std::sqrt(squared_length(way));
    if (!(start.gap(way) > size * start.rounding())) return false;
    const SeenPair end = seen(*search_.a.surface.end);
    const float wanted = static_cast<float>(2 * search_.options.slack);
    return end.gap(way) > size * (wanted + end.rounding());
  }
  /// An edge and a triangle as they are seen from somewhere near. [m]
  struct SeenPair {
    std::array<Vec3f, 2> edge;
    std::array<Vec3f, 3> triangle;

    /// How far the edge lies beyond the triangle along a direction, times its length.
    [[nodiscard]] float gap(Vec3f way) const {
      const auto along = [&](Vec3f p) { return dot(way, p); };
      return std::min(along(edge[0]), along(edge[1])) -
             std::max({along(triangle[0]), along(triangle[1]), along(triangle[2])});
    }
    /// What rounding may add to a gap, generously.
    [[nodiscard]] float rounding() const {
      float farthest = 0;
      for (const Vec3f& p : edge) farthest = std::max(farthest, squared_length(p));
      for (const Vec3f& p : triangle) farthest = std::max(farthest, squared_length(p));
      return 4e-6F * std::sqrt(farthest);
    }
  };

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
