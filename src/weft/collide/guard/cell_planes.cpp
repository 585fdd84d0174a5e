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

/// Corners of a cell, by number.
using CellCorners = std::array<int, 3>;

class Finder {
 public:
  Finder(const PlaneSearch& search, std::vector<SeparatingPlane>& out)
      : search_(search), out_(out) {}

  void look_at(const CellPair& cells) {
    const CellGaps gaps(search_.a.surface, cells.a, search_.b.surface, cells.b);
    // Whatever their points do within the slack: spares looking at their triangles.
    if (gaps.apart(0, (search_.b.body ? 1 : 2) * search_.options.slack)) return;
    const SurfaceGrid &a = *search_.a.surface.grid, &b = *search_.b.surface.grid;
    samples_a_ = a.corners(cells.a);
    samples_b_ = b.corners(cells.b);
    for (std::size_t k = 0; k < 4; ++k) {
      points_a_[k] = a.point(samples_a_[k]);
      points_b_[k] = b.point(samples_b_[k]);
    }
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        triangles(gaps, a.triangle_corners(cells.a, i), b.triangle_corners(cells.b, j));
  }

 private:
  static Samples pick(const std::array<int, 4>& samples, const CellCorners& corners) {
    return {samples[corners[0]], samples[corners[1]], samples[corners[2]]};
  }

  void triangles(const CellGaps& gaps, CellCorners a, CellCorners b) {
    const Samples of_a = pick(samples_a_, a), of_b = pick(samples_b_, b);
    if (search_.a.surface.grid->folded(of_a) || search_.b.surface.grid->folded(of_b)) return;
    if (!search_.same) {
      if (is_inside(of_a)) return;
      return add(feature_of(search_.a, of_a, 3), feature_of(search_.b, of_b, 3));
    }
    const int shared = bring_shared_first(a, b);
    if (shared == 0) return add(feature_of(search_.a, of_a, 3), feature_of(search_.b, of_b, 3));
    if (shared > 1) return;
    edge_and_triangle(gaps, a, b, false);
    edge_and_triangle(gaps, b, a, true);
  }

  /// Two triangles whose first corner is one point: the far edge of one with the other as a whole.
  /// @param second  the edge is of the second cell
  void edge_and_triangle(const CellGaps& gaps, const CellCorners& edge, const CellCorners& triangle,
                         bool second) {
    if (beside(gaps, edge, triangle, second)) return;
    const PlaneSide &own = second ? search_.b : search_.a, &other = second ? search_.a : search_.b;
    const Samples of_edge = pick(second ? samples_b_ : samples_a_, edge);
    const Samples of_triangle = pick(second ? samples_a_ : samples_b_, triangle);
    add(feature_of(own, {of_edge[1], of_edge[2], 0}, 2), feature_of(other, of_triangle, 3));
  }

  /// Whether the way between their middles certainly keeps the two apart, as neighbours in a layer
  /// nearly always lie; told in single precision.
  [[nodiscard]] bool beside(const CellGaps& gaps, const CellCorners& edge,
                            const CellCorners& triangle, bool second) const {
    const auto start = [&](bool of_edge, int k) {
      return gaps.start(of_edge == second,
                        (of_edge ? edge : triangle)[static_cast<std::size_t>(k)]);
    };
    const Vec3f way = 3.0F * (start(true, 1) + start(true, 2)) -
                      2.0F * (start(false, 0) + start(false, 1) + start(false, 2));
    const float size = std::sqrt(squared_length(way));
    if (!(gap_along(way, start) > size * gaps.margin())) return false;
    const auto end = [&](bool of_edge, int k) {
      return gaps.end(of_edge == second, (of_edge ? edge : triangle)[static_cast<std::size_t>(k)]);
    };
    const float wanted = static_cast<float>(2 * search_.options.slack);
    return gap_along(way, end) > size * (wanted + gaps.margin());
  }
  /// How far an edge's two ends lie beyond a triangle along a direction, times its length.
  template <class At>
  static float gap_along(Vec3f way, const At& at) {
    const auto along = [&](bool of_edge, int k) { return dot(way, at(of_edge, k)); };
    return std::min(along(true, 1), along(true, 2)) -
           std::max({along(false, 0), along(false, 1), along(false, 2)});
  }

  /// @return how many points two triangles share; the (last) one comes first in both
  int bring_shared_first(CellCorners& a, CellCorners& b) const {
    int shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        if (points_a_[a[i]] != points_b_[b[j]]) continue;
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
  // Of the corners of the two cells that are looked at:
  std::array<int, 4> samples_a_{}, samples_b_{}, points_a_{}, points_b_{};
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
