#include "weft/collide/intersections.h"

#include <algorithm>

namespace weft {
namespace {

Corners corners_of(const GridTriangles& grid, const Triangle& triangle) {
  const auto position = [&](int sample) { return vec_cast<double>(grid.positions->at(sample)); };
  return {position(triangle[0]), position(triangle[1]), position(triangle[2])};
}

std::vector<Corners> corners_of(const GridTriangles& grid) {
  std::vector<Corners> corners;
  corners.reserve(grid.triangles->size());
  for (const Triangle& triangle : *grid.triangles) corners.push_back(corners_of(grid, triangle));
  return corners;
}

std::vector<Vec3f> samples_of(const Planes3& positions) {
  std::vector<Vec3f> samples;
  const int count = positions.size() * positions.size();
  samples.reserve(count);
  for (int s = 0; s < count; ++s) samples.push_back(positions.at(s));
  return samples;
}

}  // namespace

IntersectionCheck::Surface::Surface(const GridTriangles& grid)
    : grid_(grid),
      seen_(samples_of(*grid.positions)),
      crossing_(corners_of(grid), Neighbours(*grid.triangles)) {}

void IntersectionCheck::Surface::follow() {
  const int n = grid_.positions->size();
  bool moved = false;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const Vec3f now = grid_.positions->at(r, c);
      moved |= !(now == seen_[r * n + c]);
      seen_[r * n + c] = now;
    }
  if (!moved) return;
  const std::span<Corners> corners = crossing_.triangles();
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (int k = 0; k < 3; ++k) corners[t][k] = vec_cast<double>(seen_[(*grid_.triangles)[t][k]]);
  crossing_.moved();
}

bool IntersectionCheck::Surface::meet_at_open_seam(int s, int t) const {
  for (const int a : (*grid_.triangles)[s])
    for (const int b : (*grid_.triangles)[t])
      if (grid_.sewn->representative(a) == grid_.sewn->representative(b) && !(seen_[a] == seen_[b]))
        return true;
  return false;
}

std::int64_t IntersectionCheck::Surface::count_self() const {
  if (grid_.sewn == nullptr) return crossing_.count_self_crossings();
  return crossing_.count_self_crossings([&](int s, int t) { return meet_at_open_seam(s, t); });
}

bool IntersectionCheck::Surface::is_buried(int triangle) const {
  if (grid_.buried == nullptr || grid_.buried->empty()) return false;
  const Triangle& corners = (*grid_.triangles)[triangle];
  return std::any_of(corners.begin(), corners.end(),
                     [&](int corner) { return (*grid_.buried)[corner] != 0; });
}

std::int64_t IntersectionCheck::Surface::count_below(double height) {
  const std::span<const Corners> corners = crossing_.triangles();
  return std::count_if(corners.begin(), corners.end(), [height](const Corners& t) {
    return std::min({t[0].y, t[1].y, t[2].y}) < height;
  });
}

IntersectionCheck::IntersectionCheck(std::span<const GridTriangles> cloths,
                                     std::span<const GridTriangles> bodies,
                                     std::optional<double> ground)
    : cloths_(cloths.begin(), cloths.end()),
      bodies_(bodies.begin(), bodies.end()),
      ground_(ground) {}

IntersectionCounts IntersectionCheck::count() {
  for (std::vector<Surface>* surfaces : {&cloths_, &bodies_})
    for (Surface& surface : *surfaces) surface.follow();
  IntersectionCounts counts;
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    const CrossingSurface& cloth = cloths_[i].crossing();
    counts.self += cloths_[i].count_self();
    for (std::size_t other = 0; other < i; ++other)
      counts.cloths += cloth.count_crossings(cloths_[other].crossing());
    for (const Surface& body : bodies_)
      counts.bodies +=
          cloth.count_crossings(body.crossing(), [&](int t) { return body.is_buried(t); });
    if (ground_) counts.ground += cloths_[i].count_below(*ground_);
  }
  return counts;
}

double IntersectionCheck::part_lying_on(std::size_t cloth, std::size_t other) {
  for (const std::size_t i : {cloth, other}) cloths_[i].follow();
  const CrossingSurface& own = cloths_[cloth].crossing();
  return own.count_lying_on(cloths_[other].crossing()) /
         std::max(1.0, static_cast<double>(cloths_[cloth].triangle_count()));
}

}  // namespace weft
