#include "weft/collide/filter/cell_planes.h"

#include <algorithm>
#include <cmath>

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
using TriangleCorners = std::array<int, 3>;

/// Two cells in single precision, relative to a corner of the first, for tests that spare the exact
/// one.
class PlacedCells {
 public:
  PlacedCells(const CellCorners& a, const TileCorners& tile, int lane) {
    const Vec3f origin{a.start[0][0], a.start[1][0], a.start[2][0]};
    float farthest = 0;
    const auto place = [&](Vec3f at) {
      const Vec3f placed = at - origin;
      for (const float x : {placed.x, placed.y, placed.z})
        farthest = std::max(farthest, std::abs(x));
      return placed;
    };
    const auto corner = [&](const auto& of, int k) { return Vec3f{of[0][k], of[1][k], of[2][k]}; };
    const auto lane_corner = [&](const auto& of, int k) {
      return Vec3f{of[0][k][lane], of[1][k][lane], of[2][k][lane]};
    };
    for (int k = 0; k < 4; ++k) {
      start_[0][k] = place(corner(a.start, k));
      end_[0][k] = place(corner(a.end, k));
      start_[1][k] = place(lane_corner(tile.start, k));
      end_[1][k] = place(lane_corner(tile.end, k));
    }
    margin_ = rounding * farthest;
  }
  [[nodiscard]] Vec3f start(bool second, int corner) const {
    return start_[second ? 1 : 0][corner];
  }
  [[nodiscard]] Vec3f end(bool second, int corner) const { return end_[second ? 1 : 0][corner]; }
  /// Generous bound of the rounding error of a gap. [m]
  [[nodiscard]] float margin() const { return margin_; }

 private:
  /// Relative to the farthest coordinate.
  static constexpr float rounding = 4e-6F;
  std::array<std::array<Vec3f, 4>, 2> start_{}, end_{};
  float margin_ = 0;
};

class CellSearch {
 public:
  CellSearch(const PlaneSearch& search, std::vector<SeparatingPlane>& out)
      : search_(search), out_(out) {}

  void find(const CandidateTile& found, const CollideKernels& kernels) {
    const unsigned cells = with_new_corners(found);
    if (cells == 0) return;
    // Cells that stay apart within the slack need no test of their triangles.
    std::array<float, tile_cells> gaps;
    const Tiling &of_a = search_.a.tiles->tiling(), &of_b = search_.b.tiles->tiling();
    const CellCorners own = search_.a.tiles->cell(found.row_a, found.col_a);
    const TileCorners& tile = search_.b.tiles->tile(of_b.tile_b(found));
    kernels.tile_gaps(own, tile, 0, wanted(), gaps.data());
    for_lanes(cells, [&](int lane) {
      if (gaps[lane] <= 0)
        find({of_a.cell_at(found.row_a, found.col_a), of_b.cell_b(found, lane)},
             PlacedCells(own, tile, lane));
    });
  }

 private:
  /// Gap of the ends that no displacement within the slack uses up. [m]
  [[nodiscard]] float wanted() const {
    return static_cast<float>((search_.b.body ? 1 : 2) * search_.options.slack);
  }

  /// The cells of a tile that have to be looked at with a cell.
  [[nodiscard]] unsigned with_new_corners(const CandidateTile& found) const {
    const Tiling &of_a = search_.a.tiles->tiling(), &of_b = search_.b.tiles->tiling();
    if (search_.new_points == nullptr || is_new(search_.a, of_a.cell_at(found.row_a, found.col_a)))
      return found.cells;
    unsigned cells = 0;
    for_lanes(found.cells, [&](int lane) {
      if (is_new(search_.b, of_b.cell_b(found, lane))) cells |= 1U << lane;
    });
    return cells;
  }

  void find(const CandidatePair& cells, const PlacedCells& placed) {
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
      for (int j = 0; j < 2 && !crosses_body(cells.a, i); ++j)
        if (!is_buried(cells.b, j))
          triangles(placed, a.triangle_corners(cells.a, i), b.triangle_corners(cells.b, j));
  }

  static Samples pick(const std::array<int, 4>& samples, const TriangleCorners& corners) {
    return {samples[corners[0]], samples[corners[1]], samples[corners[2]]};
  }

  static bool is_new(const PlaneSide& side, int cell) {
    return side.new_cells != nullptr && side.new_cells[cell] != 0;
  }
  [[nodiscard]] bool has_new(const PlaneSide& side, const std::array<int, 4>& points,
                             const TriangleCorners& corners) const {
    return !side.body && std::any_of(corners.begin(), corners.end(), [&](int k) {
      return search_.new_points[side.first_point + points[k]] != 0;
    });
  }

  /// A triangle of a cell, or the edge opposite its first corner (`first` is 1).
  struct Part {
    const PlaneSide* side;
    bool second;  // of the two cells
    TriangleCorners corners;
    std::size_t first = 0;
  };

  void triangles(const PlacedCells& placed, TriangleCorners a, TriangleCorners b) {
    if (search_.new_points != nullptr && !has_new(search_.a, points_a_, a) &&
        !has_new(search_.b, points_b_, b))
      return;
    const Samples of_a = pick(samples_a_, a), of_b = pick(samples_b_, b);
    if (search_.a.surface.grid->folded(of_a) || search_.b.surface.grid->folded(of_b)) return;
    if ((!search_.same && is_inside(of_a)) || entangled(of_a, of_b)) return;
    const int shared = search_.same ? bring_shared_first(a, b) : 0;
    if (shared > 1) return;
    const Part part_a{&search_.a, false, a}, part_b{&search_.b, true, b};
    if (shared == 0) return find(placed, part_a, part_b);
    // Both triangles have their shared point first: each one's opposite edge with the other as a
    // whole.
    find(placed, {part_a.side, false, a, 1}, part_b);
    find(placed, {part_b.side, true, b, 1}, part_a);
  }

  void find(const PlacedCells& placed, const Part& a, const Part& b) {
    if (!beyond_edge(placed, a, b) && !beside(placed, a, b) && !apart_along_face(placed, a, a, b) &&
        !apart_along_face(placed, b, a, b))
      add(feature_of(a), feature_of(b));
  }
  [[nodiscard]] MovingFeature feature_of(const Part& part) const {
    const Samples samples = pick(part.second ? samples_b_ : samples_a_, part.corners);
    if (part.first == 0) return moving_feature(*part.side, samples, 3);
    return moving_feature(*part.side, {samples[1], samples[2], 0}, 2);
  }

  /// Whether the direction between their centroids certainly separates two parts, as it nearly
  /// always does for neighbours in a layer; tested in single precision.
  [[nodiscard]] bool beside(const PlacedCells& placed, const Part& a, const Part& b) const {
    const auto start = [&](const Part& part, std::size_t k) {
      return placed.start(part.second, part.corners[k]);
    };
    return apart_along(placed, middle(a, start) - middle(b, start), a, b);
  }
  /// The same for the direction from a shared point to the edge opposite it: cloth goes on beyond
  /// the edge, unless it is folded there.
  [[nodiscard]] bool beyond_edge(const PlacedCells& placed, const Part& a, const Part& b) const {
    if (a.first == 0) return false;
    const auto corner = [&](int k) { return placed.start(a.second, a.corners[k]); };
    const Vec3f along = corner(2) - corner(1), to_edge = corner(1) - corner(0);
    return apart_along(placed, to_edge - dot(to_edge, along) / squared_length(along) * along, a, b);
  }
  /// The same for the normal of a part that is a triangle, in either direction.
  [[nodiscard]] bool apart_along_face(const PlacedCells& placed, const Part& face, const Part& a,
                                      const Part& b) const {
    if (face.first != 0) return false;
    const Vec3f origin = placed.start(face.second, face.corners[0]);
    const Vec3f normal = cross(placed.start(face.second, face.corners[1]) - origin,
                               placed.start(face.second, face.corners[2]) - origin);
    return apart_along(placed, normal, a, b) || apart_along(placed, normal, b, a);
  }
  [[nodiscard]] bool apart_along(const PlacedCells& placed, Vec3f n, const Part& a,
                                 const Part& b) const {
    const auto start = [&](const Part& part, std::size_t k) {
      return placed.start(part.second, part.corners[k]);
    };
    const float size = std::sqrt(squared_length(n));
    if (!(gap_along(n, a, b, start) > size * placed.margin())) return false;
    const auto end = [&](const Part& part, std::size_t k) {
      return placed.end(part.second, part.corners[k]);
    };
    return gap_along(n, a, b, end) > size * (wanted() + placed.margin());
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
  int bring_shared_first(TriangleCorners& a, TriangleCorners& b) const {
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

  [[nodiscard]] bool crosses_body(int cell, int half) const {
    return search_.crossings != nullptr && search_.crossings->crosses(cell, half);
  }

  [[nodiscard]] bool is_buried(int cell, int half) const {
    return !search_.buried.empty() &&
           search_.buried[2 * static_cast<std::size_t>(cell) + half] != 0;
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

void CellPlanes::find(const PlaneSearch& search, std::span<const CandidateTile> cells,
                      ThreadTeam& team, std::vector<SeparatingPlane>& out) {
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  found_.fill(static_cast<int>(cells.size()), team, [&](int i, std::vector<SeparatingPlane>& mine) {
    CellSearch(search, mine).find(cells[i], kernels);
  });
  append(found_, out);
}

}  // namespace weft
