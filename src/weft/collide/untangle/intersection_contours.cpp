#include "weft/collide/untangle/intersection_contours.h"

#include <algorithm>

#include "weft/core/orientation.h"

namespace weft {
namespace {

/// Side of a plane that a point is on; a point in the plane counts as above it, so that all edges
/// of a corner agree.
int side_of_plane(const std::array<Vec3d, 3>& plane, Vec3d point) {
  return orientation(plane[0], plane[1], plane[2], point) < 0 ? -1 : 1;
}

/// A sample and its position.
struct Corner {
  int sample;
  Vec3d at;
};

/// Orientation of one line around another, 1 or -1. Lines that meet count as turning left when both
/// are read from their lower samples, so that of two triangles that share an edge one is hit.
int turn(const Corner& p, const Corner& q, Corner a, Corner b) {
  int sign = 1;
  if (a.sample > b.sample) {
    std::swap(a, b);
    sign = -1;
  }
  return orientation(p.at, q.at, a.at, b.at) < 0 ? -sign : sign;
}

bool passes_through(const std::array<Corner, 2>& edge, const std::array<Corner, 3>& triangle) {
  const std::array<Vec3d, 3> plane{triangle[0].at, triangle[1].at, triangle[2].at};
  if (side_of_plane(plane, edge[0].at) == side_of_plane(plane, edge[1].at)) return false;
  const int first = turn(edge[0], edge[1], triangle[0], triangle[1]);
  return first == turn(edge[0], edge[1], triangle[1], triangle[2]) &&
         first == turn(edge[0], edge[1], triangle[2], triangle[0]);
}

bool boxes_meet(const std::array<Vec3d, 3>& a, const std::array<Vec3d, 3>& b) {
  const auto apart = [&](double Vec3d::*axis) {
    const auto [min_a, max_a] = std::minmax({a[0].*axis, a[1].*axis, a[2].*axis});
    const auto [min_b, max_b] = std::minmax({b[0].*axis, b[1].*axis, b[2].*axis});
    return max_a < min_b || max_b < min_a;
  };
  return !apart(&Vec3d::x) && !apart(&Vec3d::y) && !apart(&Vec3d::z);
}

std::array<int, 3> points_of(const SurfaceGrid& grid, int cell, int half) {
  std::array<int, 3> triangle = grid.triangle(cell, half);
  for (int& sample : triangle) sample = grid.point(sample);
  return triangle;
}

/// Whether a sample is a corner of a triangle, or is being sewn to one.
bool meets(const SurfaceGrid& grid, const std::array<int, 3>& triangle, int sample) {
  return std::any_of(triangle.begin(), triangle.end(),
                     [&](int corner) { return grid.joint(corner) == grid.joint(sample); });
}

}  // namespace

Vec3d StandingPair::normal(int side, const std::array<int, 3>& triangle) const {
  const Vec3d corner = at(side, triangle[0]);
  return normalized(weft::cross(at(side, triangle[1]) - corner, at(side, triangle[2]) - corner));
}

void IntersectionContours::cross(const StandingPair& pair, const SegmentEnd& edges_of,
                                 Segment& out) {
  const int side = edges_of.crossing.side, other = pair.same ? 0 : 1 - side;
  const std::array<int, 3>& triangle = edges_of.crossing.triangle;
  std::array<Corner, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) corners[k] = {triangle[k], pair.at(other, triangle[k])};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [p, q] = std::minmax(edges_of.own[k], edges_of.own[(k + 1) % 3]);
    if (pair.same && (meets(*pair.grids[0], triangle, p) || meets(*pair.grids[0], triangle, q)))
      continue;
    if (!passes_through({{{p, pair.at(side, p)}, {q, pair.at(side, q)}}}, corners)) continue;
    SegmentEnd end = edges_of;
    end.crossing.edge = {p, q};
    out.add(end);
  }
}

void IntersectionContours::find_segments(const StandingPair& pair, const CandidatePair& cells,
                                         std::vector<Segment>& out) {
  const int second_side = pair.same ? 0 : 1;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const std::array<int, 3> a = points_of(*pair.grids[0], cells.a, i);
      const std::array<int, 3> b = points_of(*pair.grids[1], cells.b, j);
      if (pair.grids[0]->folded(a) || pair.grids[1]->folded(b)) continue;
      std::array<Vec3d, 3> at_a{}, at_b{};
      for (std::size_t k = 0; k < 3; ++k) {
        at_a[k] = pair.at(0, a[k]);
        at_b[k] = pair.at(second_side, b[k]);
      }
      if (!boxes_meet(at_a, at_b)) continue;
      Segment segment;
      cross(pair, {{0, {}, b}, a, true}, segment);
      cross(pair, {{second_side, {}, a}, b, false}, segment);
      if (segment.count > 0) out.push_back(segment);
    }
}

int IntersectionContours::node_of(const Crossing& crossing) const {
  const auto found = std::lower_bound(
      nodes_.begin(), nodes_.end(), crossing,
      [](const ContourNode& node, const Crossing& wanted) { return node.crossing < wanted; });
  return static_cast<int>(found - nodes_.begin());
}

void IntersectionContours::collect_nodes(const StandingPair& pair) {
  nodes_.clear();
  for (const Segment& segment : segments_)
    for (int k = 0; k < segment.count; ++k) {
      ContourNode node;
      node.crossing = segment.ends[k].crossing;
      node.own = segment.ends[k].own;
      nodes_.push_back(node);
    }
  std::sort(nodes_.begin(), nodes_.end(), [](const ContourNode& a, const ContourNode& b) {
    return a.crossing != b.crossing ? a.crossing < b.crossing : a.own < b.own;
  });
  const auto same = [](const ContourNode& a, const ContourNode& b) {
    return a.crossing == b.crossing;
  };
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end(), same), nodes_.end());
  for (ContourNode& node : nodes_) {
    const Crossing& c = node.crossing;
    const int other = node.triangle_side(pair.same);
    const Vec3d p = pair.at(c.side, c.edge[0]), q = pair.at(c.side, c.edge[1]);
    const Vec3d normal = pair.normal(other, c.triangle), on = pair.at(other, c.triangle[0]);
    const double from = dot(normal, p - on), to = dot(normal, q - on);
    const double share = from != to ? std::clamp(from / (from - to), 0.0, 1.0) : 0.5;
    node.point = p + share * (q - p);
  }
}

void IntersectionContours::join() {
  sets_.reset(static_cast<int>(nodes_.size()));
  for (const Segment& segment : segments_) {
    std::array<int, 2> ends{-1, -1};
    for (int k = 0; k < segment.count; ++k) {
      ends[k] = node_of(segment.ends[k].crossing);
      ++nodes_[ends[k]].segments;
    }
    if (segment.count < 2) continue;
    const Vec3d displacement = normalized(nodes_[ends[1]].point - nodes_[ends[0]].point);
    nodes_[ends[0]].onwards += displacement;
    nodes_[ends[1]].onwards -= displacement;
    const int swap = segment.ends[0].of_first != segment.ends[1].of_first ? 1 : 0;
    sets_.join(ends[0], ends[1], swap);
  }
}

void IntersectionContours::name_contours() {
  names_.assign(nodes_.size(), -1);
  contours_ = 0;
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
    const int of = sets_.root(i);
    if (names_[of] < 0) names_[of] = contours_++;
    nodes_[i].contour = names_[of];
    nodes_[i].layer = sets_.parity(i);
  }
}

void IntersectionContours::find(const StandingPair& pair, std::span<const CandidateTile> cells,
                                ThreadTeam& team) {
  const Tiling of_a(pair.grids[0]->cells()), of_b(pair.grids[1]->cells());
  team.run([&](Worker& worker) {
    found_.fill(static_cast<int>(cells.size()), worker, [&](int i, std::vector<Segment>& mine) {
      for_pairs(cells[i], of_a, of_b,
                [&](const CandidatePair& one) { find_segments(pair, one, mine); });
    });
  });
  segments_.clear();
  append(found_, segments_);
  collect_nodes(pair);
  join();
  name_contours();
}

void Regions::find(const SurfaceGrid& grid, std::span<const CutEdge> cut) {
  const int n = grid.size(), count = n * n;
  sets_.reset(count);
  touched_.assign(static_cast<std::size_t>(count), 0);
  roots_.resize(static_cast<std::size_t>(count));
  sizes_.assign(static_cast<std::size_t>(count), 0);
  for (const CutEdge& edge : cut) touched_[edge[0]] = touched_[edge[1]] = 1;
  const auto join = [&](int from, int to) {
    const auto [p, q] = std::minmax({grid.point(from), grid.point(to)});
    if (touched_[p] != 0 && touched_[q] != 0) {
      const auto [first, last] = std::equal_range(cut.begin(), cut.end(), CutEdge{p, q});
      if ((last - first) % 2 != 0) return;
    }
    sets_.join(p, q);
  };
  for (int cell = 0; cell < grid.cells() * grid.cells(); ++cell)
    for (int half = 0; half < 2; ++half) {
      const std::array<int, 3> triangle = grid.triangle(cell, half);
      for (std::size_t k = 0; k < 3; ++k) join(triangle[k], triangle[(k + 1) % 3]);
    }
  for (int s = 0; s < count; ++s) {
    if (grid.point(s) != s) continue;
    roots_[s] = sets_.root(s);
    ++sizes_[roots_[s]];
  }
}

}  // namespace weft
