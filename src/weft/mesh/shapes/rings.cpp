#include "weft/mesh/shapes/rings.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "weft/core/math.h"

namespace weft {

namespace {

Section operator+(const Section& a, const Section& b) {
  return {a.height + b.height, a.half_width + b.half_width, a.front + b.front, a.back + b.back};
}
Section operator*(double s, const Section& a) {
  return {s * a.height, s * a.half_width, s * a.front, s * a.back};
}

/// Change per unit of height at section i.
Section slope_at(std::span<const Section> sections, std::size_t i) {
  const Section& before = sections[i == 0 ? 0 : i - 1];
  const Section& after = sections[std::min(i + 1, sections.size() - 1)];
  return (1 / (after.height - before.height)) * (after + -1.0 * before);
}

Section section_at(std::span<const Section> sections, double height) {
  if (height <= sections.front().height) return sections.front();
  if (height >= sections.back().height) return sections.back();
  std::size_t i = 0;
  while (sections[i + 1].height <= height) ++i;
  const double span = sections[i + 1].height - sections[i].height;
  const double t = (height - sections[i].height) / span;
  const double rest = 1 - t;
  return (rest * rest * (1 + 2 * t)) * sections[i] + (t * t * (1 + 2 * rest)) * sections[i + 1] +
         (span * t * rest * rest) * slope_at(sections, i) +
         (-span * t * t * rest) * slope_at(sections, i + 1);
}

}  // namespace

double distance_to_sections(std::span<const Section> sections, Vec3d point) {
  const Section s = section_at(sections, point.y);
  const double depth = 0.5 * (s.front - s.back);
  const double x = point.x / s.half_width, z = (point.z - 0.5 * (s.front + s.back)) / depth;
  const double level = std::sqrt(x * x + z * z);
  const double slope = std::sqrt(x * x / (s.half_width * s.half_width) + z * z / (depth * depth));
  return slope > 0 ? level * (level - 1) / slope : -std::min(s.half_width, depth);
}

namespace {

/// A ring's vertices in the mesh, evenly spread from angle 0 on.
struct Placed {
  int first = 0, count = 1;
  [[nodiscard]] int vertex(int i) const { return first + i % count; }
};

Placed add_points(TriangleMesh& mesh, const Ring& ring) {
  const Placed placed{static_cast<int>(mesh.positions.size()), ring.count};
  for (int i = 0; i < ring.count; ++i) {
    const double angle = 2 * pi * i / ring.count;
    mesh.positions.push_back(
        {ring.radius * cosine(angle), ring.height, -ring.radius * sine(angle)});
  }
  return placed;
}

/// Whether the middle of a's edge i comes before that of b's edge j, in integer arithmetic.
bool comes_first(const Placed& a, int i, const Placed& b, int j) {
  return (2 * i + 1) * b.count <= (2 * j + 1) * a.count;
}

void fill_between(TriangleMesh& mesh, const Placed& low, const Placed& high) {
  const int low_edges = low.count > 1 ? low.count : 0, high_edges = high.count > 1 ? high.count : 0;
  for (int i = 0, j = 0; i < low_edges || j < high_edges;) {
    if (j == high_edges || (i < low_edges && comes_first(low, i, high, j))) {
      mesh.triangles.push_back({low.vertex(i), low.vertex(i + 1), high.vertex(j)});
      ++i;
    } else {
      mesh.triangles.push_back({high.vertex(j), low.vertex(i), high.vertex(j + 1)});
      ++j;
    }
  }
}

/// Adds the rings between two radii and heights, the first left out, with edges of about `edge`.
void add_rings(std::vector<Ring>& rings, Ring from, Ring to, double edge) {
  const double length = std::sqrt((to.radius - from.radius) * (to.radius - from.radius) +
                                  (to.height - from.height) * (to.height - from.height));
  constexpr int min_count = 4;
  const int steps = std::max(1, static_cast<int>(std::lround(length / edge)));
  for (int k = 1; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const double radius = (1 - t) * from.radius + t * to.radius;
    const int count = static_cast<int>(std::lround(2 * pi * radius / edge));
    rings.push_back({(1 - t) * from.height + t * to.height, radius,
                     radius == 0 ? 1 : std::max(min_count, count)});
  }
}

}  // namespace

TriangleMesh ring_mesh(std::span<const Ring> rings) {
  TriangleMesh mesh;
  Placed before;
  for (const Ring& ring : rings) {
    const bool is_first = mesh.positions.empty();
    const Placed here = add_points(mesh, ring);
    if (!is_first) fill_between(mesh, before, here);
    before = here;
  }
  return mesh;
}

TriangleMesh cone_mesh() {
  constexpr double edge = 0.02, base = -0.5 * cone_height, tip = 0.5 * cone_height;
  std::vector<Ring> rings{{base, 0, 1}};
  add_rings(rings, rings.back(), {base, cone_radius}, edge);
  add_rings(rings, rings.back(), {tip, 0}, edge);
  return ring_mesh(rings);
}

TriangleMesh rod_mesh() {
  constexpr double edge = 0.008, half = 0.5 * rod_length;
  std::vector<Ring> rings{{-half, 0, 1}};
  add_rings(rings, rings.back(), {-half, rod_radius}, edge);
  add_rings(rings, rings.back(), {half, rod_radius}, edge);
  add_rings(rings, rings.back(), {half, 0}, edge);
  TriangleMesh mesh = ring_mesh(rings);
  // From y to x by a cyclic permutation of the axes, which rotates and does not mirror.
  for (Vec3d& p : mesh.positions) p = {p.y, p.z, p.x};
  return mesh;
}

}  // namespace weft
