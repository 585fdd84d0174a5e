#include "weft/param/local_newton.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "weft/core/orientation.h"
#include "weft/param/triangle_energy.h"
#include "weft/param/vertex_kernel.h"

namespace weft {
namespace {

double energy_at(const LocalMap& map, int vertex, Vec2d place) {
  double sum = 0;
  map.mesh.around(vertex, [&](int h) {
    std::array<Vec2d, 3> p{};
    for (int k = 0; k < 3; ++k) p[k] = map.uv[map.mesh.triangles()[h / 3][k]];
    p[h % 3] = place;
    const SurfaceTriangle& surface = map.surface[h / 3];
    sum += surface.area * triangle_stretch(surface, p[0], p[1], p[2]).mean_square;
  });
  return sum;
}

bool is_valid_at(const LocalMap& map, int vertex, Vec2d place) {
  bool valid = true;
  map.mesh.around(vertex, [&](int h) {
    const Vec2d a = map.uv[map.mesh.to(h)];
    const Vec2d b = map.uv[map.mesh.from(HalfEdges::previous(h))];
    valid = valid && orientation(place, a, b) > 0;
  });
  return valid;
}

/// The stretch energy of the triangles around a vertex and how it answers to moving the vertex.
struct Star {
  double energy = 0;
  Vec2d gradient{};
  double xx = 0, xy = 0, yy = 0;  ///< the positive part of the Hessian
};

Star star_at(const LocalMap& map, int vertex) {
  Star star;
  map.mesh.around(vertex, [&](int h) {
    const auto& [a, b, c] = map.mesh.triangles()[h / 3];
    const TriangleEnergy part =
        triangle_energy(map.surface[h / 3], map.uv[a], map.uv[b], map.uv[c]);
    const int x = 2 * (h % 3);
    star.energy += part.value;
    star.gradient = star.gradient + Vec2d{part.gradient[x], part.gradient[x + 1]};
    for (const auto& square : part.squares) {
      star.xx += square[x] * square[x];
      star.xy += square[x] * square[x + 1];
      star.yy += square[x + 1] * square[x + 1];
    }
  });
  return star;
}

/// How far a vertex can go along a step before the first triangle around it closes.
double free_way(const LocalMap& map, int vertex, Vec2d step) {
  double way = std::numeric_limits<double>::infinity();
  const Vec2d place = map.uv[vertex];
  map.mesh.around(vertex, [&](int h) {
    const Vec2d a = map.uv[map.mesh.to(h)];
    const Vec2d b = map.uv[map.mesh.from(HalfEdges::previous(h))];
    const double closing = cross(b - a, step);
    if (closing < 0) way = std::min(way, cross(a - place, b - place) / -closing);
  });
  return way;
}

}  // namespace

bool improve_vertex(const LocalMap& map, int vertex) {
  const Star star = star_at(map, vertex);
  const double determinant = star.xx * star.yy - star.xy * star.xy;
  if (!std::isfinite(star.energy) || !(determinant > 0)) return false;
  const Vec2d step = -1 / determinant *
                     Vec2d{star.yy * star.gradient.x - star.xy * star.gradient.y,
                           star.xx * star.gradient.y - star.xy * star.gradient.x};
  const double slope = dot(step, star.gradient);
  // A step that gains next to nothing costs as much as one that does.
  constexpr double least_gain = 1e-7;
  if (!(slope < -least_gain * star.energy)) return false;
  double way = std::min(1.0, 0.9 * free_way(map, vertex, step));
  for (int halving = 0; halving < 8; ++halving, way *= 0.5) {
    const Vec2d place = map.uv[vertex] + way * step;
    if (!(energy_at(map, vertex, place) < star.energy + 1e-4 * way * slope)) continue;
    if (!is_valid_at(map, vertex, place)) continue;
    map.uv[vertex] = place;
    return true;
  }
  return false;
}

bool centre_vertex(const LocalMap& map, int vertex) {
  std::vector<Vec2d> ring;
  map.mesh.around(vertex, [&](int h) { ring.push_back(map.uv[map.mesh.to(h)]); });
  const std::optional<Vec2d> place = kernel_point(ring);
  if (!place || !(energy_at(map, vertex, *place) < energy_at(map, vertex, map.uv[vertex])))
    return false;
  map.uv[vertex] = *place;
  return true;
}

void sweep(const LocalMap& map) {
  for (int v = 0; v < map.mesh.vertex_count(); ++v)
    if (map.mesh.is_inner(v)) improve_vertex(map, v);
}

}  // namespace weft
