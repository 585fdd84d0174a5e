#include "weft/collide/filter/cell_planes.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/broad_phase/cell_gaps.h"

namespace weft {
namespace {

using Samples = std::array<int, 3>;

MovingFeature moving_feature(const PlaneSide& side, const Samples& samples, int count) {
  MovingFeature feature;
  feature.count = count;
  feature.body = side.body;
  for (int k = 0; k < count; ++k) {
    feature.start[k] = vec_cast<double>(side.surface.start->at(samples[k]));
    feature.safe_position[k] = vec_cast<double>(side.safe_position->at(samples[k]));
    feature.end[k] = vec_cast<double>(side.surface.end->at(samples[k]));
    feature.points[k] = side.first_point + side.surface.grid->point(samples[k]);
  }
  return feature;
}

/// Numbers of a triangle's corners in its cell.
using CellCorners = std::array<int, 3>;

class Finder {
 public:
  Finder(const PlaneSearch& search, std::vector<SeparatingPlane>& out)
      : search_(search), out_(out) {}

  void find(const CandidatePair& cells) {
    if (search_.new_points != nullptr && !is_new(search_.a, cells.a) && !is_new(search_.b, cells.b))
      return;
    const CellGaps gaps(search_.a.surface, cells.a, search_.b.surface, cells.b);
    // Cells that stay apart within the slack need no test of their triangles.
    if (gaps.apart(0, (search_.b.body ? 1 : 2) * search_.options.slack)) return;
    const SurfaceGrid &a = *search_.a.surface.grid, &b = *search_.b.surface.grid;
    samples_a_ = a.corners(cells.a);
    samples_b_ = b.corners(cells.b);
    for (std::size_t k = 0; k < 4; ++k) {
      points_a_[k] = a.point(samples_a_[k]);
      points_b_[k] = b.point(samples_b_[k]);
      joints_a_[k] = a.joint(samples_a_[k]);
      joints_b_[k] = b.joint(samples_b_[k]);
    }
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        triangles(gaps, a.triangle_corners(cells.a, i), b.triangle_corners(cells.b, j));
  }

 private:
  static Samples pick(const std::array<int, 4>& samples, const CellCorners& corners) {
    return {samples[corners[0]], samples[corners[1]], samples[corners[2]]};
  }

  static bool is_new(const PlaneSide& side, int cell) {
    return side.new_cells != nullptr && side.new_cells[cell] != 0;
  }
  [[nodiscard]] bool has_new(const PlaneSide& side, const std::array<int, 4>& points,
                             const CellCorners& corners) const {
    return !side.body && std::any_of(corners.begin(), corners.end(), [&](int k) {
      return search_.new_points[side.first_point + points[k]] != 0;
    });
  }

  /// A triangle of a cell, or the edge opposite its first corner (`first` is 1).
  struct Part {
    const PlaneSide* side;
    bool second;  // of the two cells
    CellCorners corners;
    std::size_t first = 0;
  };

  void triangles(const CellGaps& gaps, CellCorners a, CellCorners b) {
    if (search_.new_points != nullptr && !has_new(search_.a, points_a_, a) &&
        !has_new(search_.b, points_b_, b))
      return;
    const Samples of_a = pick(samples_a_, a), of_b = pick(samples_b_, b);
    if (search_.a.surface.grid->folded(of_a) || search_.b.surface.grid->folded(of_b)) return;
    if ((!search_.same && is_inside(of_a)) || entangled(of_a, of_b)) return;
    const int shared = search_.same ? bring_shared_first(a, b) : 0;
    if (shared > 1) return;
    const Part part_a{&search_.a, false, a}, part_b{&search_.b, true, b};
    if (shared == 0) return find(gaps, part_a, part_b);
    // Both triangles have their shared point first: each one's opposite edge with the other as a
    // whole.
    find(gaps, {part_a.side, false, a, 1}, part_b);
    find(gaps, {part_b.side, true, b, 1}, part_a);
  }

  void find(const CellGaps& gaps, const Part& a, const Part& b) {
    if (!beside(gaps, a, b) && !apart_along_face(gaps, a, a, b) && !apart_along_face(gaps, b, a, b))
      add(feature_of(a), feature_of(b));
  }
  [[nodiscard]] MovingFeature feature_of(const Part& part) const {
    const Samples samples = pick(part.second ? samples_b_ : samples_a_, part.corners);
    if (part.first == 0) return moving_feature(*part.side, samples, 3);
    return moving_feature(*part.side, {samples[1], samples[2], 0}, 2);
  }

  /// Whether the direction between their centroids certainly separates two parts, as it nearly
  /// always does for neighbours in a layer; tested in single precision.
  [[nodiscard]] bool beside(const CellGaps& gaps, const Part& a, const Part& b) const {
    const auto start = [&](const Part& part, std::size_t k) {
      return gaps.start(part.second, part.corners[k]);
    };
    return apart_along(gaps, middle(a, start) - middle(b, start), a, b);
  }
  /// The same for the normal of a part that is a triangle, in either direction.
  [[nodiscard]] bool apart_along_face(const CellGaps& gaps, const Part& face, const Part& a,
                                      const Part& b) const {
    if (face.first != 0) return false;
    const Vec3f origin = gaps.start(face.second, face.corners[0]);
    const Vec3f normal = cross(gaps.start(face.second, face.corners[1]) - origin,
                               gaps.start(face.second, face.corners[2]) - origin);
    return apart_along(gaps, normal, a, b) || apart_along(gaps, normal, b, a);
  }
  [[nodiscard]] bool apart_along(const CellGaps& gaps, Vec3f n, const Part& a,
                                 const Part& b) const {
    const auto start = [&](const Part& part, std::size_t k) {
      return gaps.start(part.second, part.corners[k]);
    };
    const float size = std::sqrt(squared_length(n));
    if (!(gap_along(n, a, b, start) > size * gaps.margin())) return false;
    const auto end = [&](const Part& part, std::size_t k) {
      return gaps.end(part.second, part.corners[k]);
    };
    const auto wanted = static_cast<float>((search_.b.body ? 1 : 2) * search_.options.slack);
    return gap_along(n, a, b, end) > size * (wanted + gaps.margin());
  }
  template <class At>
  static Vec3f middle(const Part& of, const At& at) {
    if (of.first == 1) return 0.5F * (at(of, 1) + at(of, 2));
    return (1.0F / 3) * (at(of, 0) + at(of, 1) + at(of, 2));
  }
  /// Gap of part a beyond part b along a direction, times the direction's length.
  template <class At>
  static float gap_along(Vec3f displacement, const Part& a, const Part& b, const At& at) {
    float min = dot(displacement, at(a, a.first)), max = dot(displacement, at(b, b.first));
    for (std::size_t k = a.first + 1; k < 3; ++k) min = std::min(min, dot(displacement, at(a, k)));
    for (std::size_t k = b.first + 1; k < 3; ++k) max = std::max(max, dot(displacement, at(b, k)));
    return min - max;
  }

  /// @return how many points two triangles share, 2 for more; a single one comes first in both
  int bring_shared_first(CellCorners& a, CellCorners& b) const {
    int shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        if (joints_a_[a[i]] != joints_b_[b[j]]) continue;
        if (++shared > 1) return shared;
        std::swap(a[0], a[i]);
        std::swap(b[0], b[j]);
      }
    return shared;
  }

  /// Whether two triangles belong to layers that cross: a plane between them would keep them
  /// crossed.
  [[nodiscard]] bool entangled(const Samples& a, const Samples& b) const {
    return search_.tangle != nullptr &&
           TangleMarks::entangled(search_.tangle->of(0, *search_.a.surface.grid, a),
                                  search_.tangle->of(1, *search_.b.surface.grid, b));
  }

  [[nodiscard]] bool is_inside(const Samples& samples) const {
    return search_.inside != nullptr && std::any_of(samples.begin(), samples.end(), [&](int s) {
             return (*search_.inside)[search_.a.surface.grid->point(s)] == search_.body_number;
           });
  }

  void add(const MovingFeature& a, const MovingFeature& b) {
    SeparatingPlane plane;
    plane.body = search_.b.body ? search_.body_number - 1 : -1;
    if (separate(a, b, search_.options, plane) == Separation::plane) out_.push_back(plane);
  }

  const PlaneSearch& search_;
  std::vector<SeparatingPlane>& out_;
  // Corners of the current pair of cells:
  std::array<int, 4> samples_a_{}, samples_b_{}, points_a_{}, points_b_{}, joints_a_{}, joints_b_{};
};

}  // namespace

void CellPlanes::find(const PlaneSearch& search, std::span<const CandidatePair> cells,
                      ThreadTeam& team, std::vector<SeparatingPlane>& out) {
  found_.fill(static_cast<int>(cells.size()), team, [&](int i, std::vector<SeparatingPlane>& mine) {
    Finder(search, mine).find(cells[i]);
  });
  append(found_, out);
}

}  // namespace weft
