#include "tests/support/random_mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/random_points.h"
#include "tests/support/random_surfaces.h"
#include "weft/core/math.h"

namespace weft::test {
namespace {

/// From low to high, every power of two as likely; without the C library's pow, which differs.
double log_uniform(Random& random, double low, double high) {
  const int octaves = std::ilogb(high / low) + 1;
  return std::min(high, std::ldexp(low * random.uniform(1, 2), random.index(octaves)));
}

}  // namespace

RandomMeshBuilder::RandomMeshBuilder(std::uint64_t seed) : random_(seed) {
  wanted_ = log_uniform(random_, 20, 5000);
  start();
}

void RandomMeshBuilder::shape() {
  const int handles = chance(random_, 0.5) ? random_.index(6) : 0;
  for (int k = 0; k < handles; ++k) add_handle();
  const int holes = chance(random_, 0.5) ? random_.index(8) : 0;
  for (int k = 0; k < holes; ++k) add_hole();
  refine();
  if (chance(random_, 0.6)) add_noise();
  if (chance(random_, 0.4)) add_slivers();
  if (chance(random_, 0.7)) scale();
}

void RandomMeshBuilder::start() {
  // What is left of the wanted triangles comes by subdivision.
  const double triangles = log_uniform(random_, std::min(20.0, wanted_), wanted_);
  const int side = std::max(3, static_cast<int>(std::sqrt(triangles / 2)));
  switch (random_.index(6)) {
    case 0:
      say("tetrahedron");
      mesh_ = tetrahedron();
      break;
    case 1:
      say("patch");
      mesh_ = patch(std::max(1, side - random_.index(3)), side);
      break;
    case 2:
      say("torus");
      mesh_ = torus(side + 2, std::max(3, side - random_.index(3)));
      break;
    case 3:
      say("slab");
      mesh_ = slab(random_, triangles);
      break;
    default:
      say("waves");
      mesh_ = waves(random_, std::max(60.0, triangles));
  }
}

bool RandomMeshBuilder::add_handle(bool twisted) {
  if (triangle_count() < 12) return false;
  const auto touch = [&](const Triangle& a, const Triangle& b) {
    // An edge between the two rims must not be there yet.
    return std::any_of(mesh_.triangles.begin(), mesh_.triangles.end(), [&](const Triangle& t) {
      const auto has = [&](const Triangle& of) {
        return std::any_of(t.begin(), t.end(),
                           [&](int v) { return std::find(of.begin(), of.end(), v) != of.end(); });
      };
      return has(a) && has(b);
    });
  };
  for (int attempt = 0; attempt < 20; ++attempt) {
    int i = random_.index(triangle_count()), j = random_.index(triangle_count());
    if (i == j || touch(mesh_.triangles[i], mesh_.triangles[j])) continue;
    if (i > j) std::swap(i, j);
    const Triangle a = mesh_.triangles[i];
    Triangle b = mesh_.triangles[j];
    // Seen from inside the tube the two rims run opposite ways.
    if (!twisted) std::swap(b[1], b[2]);
    mesh_.triangles.erase(mesh_.triangles.begin() + j);
    mesh_.triangles.erase(mesh_.triangles.begin() + i);
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      mesh_.triangles.push_back({a[k], a[next], b[next]});
      mesh_.triangles.push_back({a[k], b[next], b[k]});
    }
    say(twisted ? "twisted handle" : "handle");
    return true;
  }
  return false;
}

/// Takes out a triangle, or all around a vertex, where nothing else is open yet.
void RandomMeshBuilder::add_hole() {
  const HalfEdges around = edges();
  std::vector<bool> at_border(mesh_.positions.size(), false);
  for (int h = 0; h < 3 * triangle_count(); ++h)
    if (around.twin[h] < 0) at_border[from_vertex(mesh_.triangles, h)] = true;
  const int start = random_.index(triangle_count());
  const int vertex = mesh_.triangles[start][0];
  const bool whole_ring = chance(random_, 0.5);
  const auto goes = [&](const Triangle& t) {
    if (!whole_ring) return &t == &mesh_.triangles[start];
    return std::find(t.begin(), t.end(), vertex) != t.end();
  };
  int count = 0;
  for (const Triangle& t : mesh_.triangles) {
    if (!goes(t)) continue;
    ++count;
    for (const int v : t)
      if (at_border[v]) return;
  }
  if (count + 4 > triangle_count()) return;
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh_.triangles)
    if (!goes(t)) kept.push_back(t);
  mesh_.triangles = std::move(kept);
  say("hole");
}

void RandomMeshBuilder::split_edge(int half_edge, double fraction) {
  const Triangle t = mesh_.triangles[half_edge / 3];
  const int a = t[half_edge % 3], b = t[(half_edge + 1) % 3];
  const int middle = static_cast<int>(mesh_.positions.size());
  mesh_.positions.push_back(mesh_.positions[a] +
                            fraction * (mesh_.positions[b] - mesh_.positions[a]));
  const int count = triangle_count();
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) {
      const int from = mesh_.triangles[i][k], to = mesh_.triangles[i][(k + 1) % 3];
      if (!((from == a && to == b) || (from == b && to == a))) continue;
      const int third = mesh_.triangles[i][(k + 2) % 3];
      mesh_.triangles[i] = {from, middle, third};
      mesh_.triangles.push_back({middle, to, third});
      break;
    }
}

void RandomMeshBuilder::split_face(int triangle, std::array<double, 3> weights) {
  const auto [a, b, c] = mesh_.triangles[triangle];
  const int middle = static_cast<int>(mesh_.positions.size());
  mesh_.positions.push_back(weights[0] * mesh_.positions[a] + weights[1] * mesh_.positions[b] +
                            weights[2] * mesh_.positions[c]);
  mesh_.triangles[triangle] = {a, b, middle};
  mesh_.triangles.push_back({b, c, middle});
  mesh_.triangles.push_back({c, a, middle});
}

/// Splits edges and faces, here and there again and again.
void RandomMeshBuilder::refine() {
  const double focus = random_.uniform();  // how much the newest triangles are preferred
  const double faces = random_.uniform();
  const int before = triangle_count();
  while (triangle_count() < wanted_) {
    const int count = triangle_count();
    const int t = chance(random_, 0.5 * focus) ? count - 1 - random_.index(std::min(count, 8))
                                               : random_.index(count);
    if (chance(random_, faces)) {
      split_face(t, {1.0 / 3, 1.0 / 3, 1.0 / 3});
    } else {
      split_edge(3 * t + random_.index(3), random_.uniform(0.2, 0.8));
    }
  }
  if (triangle_count() > before) say("subdivided");
}

double RandomMeshBuilder::mean_edge() const {
  double sum = 0;
  for (const Triangle& t : mesh_.triangles)
    sum += length(mesh_.positions[t[0]] - mesh_.positions[t[1]]);
  return sum / triangle_count();
}

void RandomMeshBuilder::add_noise() {
  const double amount = log_uniform(random_, 0.01, 1) * mean_edge();
  for (Vec3d& p : mesh_.positions) p = p + amount * random_point(random_);
  say("noise");
}

/// Splits next to ends and corners, and vertices put upon each other or upon an edge.
void RandomMeshBuilder::add_slivers() {
  const int count = 1 + random_.index(1 + triangle_count() / 10);
  for (int k = 0; k < count; ++k) {
    const int t = random_.index(triangle_count());
    const double near = log_uniform(random_, 1e-9, 1e-2);
    const auto [a, b, c] = mesh_.triangles[t];
    switch (random_.index(5)) {
      case 0:
        split_edge(3 * t + random_.index(3), near);
        break;
      case 1:
        split_face(t, {1 - 2 * near, near, near});
        break;
      case 2:
        split_face(t, {0.5, 0.5 - near, near});
        break;
      case 3:
        mesh_.positions[a] = mesh_.positions[b];
        break;
      default:
        mesh_.positions[a] = 0.5 * (mesh_.positions[b] + mesh_.positions[c]);
    }
  }
  say(std::to_string(count) + " slivers");
}

void RandomMeshBuilder::scale() {
  // Along axes of a random frame, so that nothing is aligned with the coordinates.
  const Vec3d u = normalized(random_point(random_) + Vec3d{0.01, 0.02, 0.03});
  const double along = log_uniform(random_, 1e-3, 1);
  const Vec3d axes{1, log_uniform(random_, 1e-3, 1), 1};
  const bool turned = chance(random_, 0.5);
  const double unit = chance(random_, 0.3) ? log_uniform(random_, 1e-6, 1e6) : 1.0;
  for (Vec3d& p : mesh_.positions) {
    if (turned) {
      p = p + ((along - 1) * dot(u, p)) * u;
    } else {
      p = {axes.x * p.x, axes.y * p.y, axes.z * p.z};
    }
    p = unit * p;
  }
  say("scaled");
}

void RandomMeshBuilder::shuffle() {
  std::vector<int> place(mesh_.positions.size());
  std::iota(place.begin(), place.end(), 0);
  const auto shuffled = [&](auto& list) {
    for (int k = static_cast<int>(list.size()) - 1; k > 0; --k)
      std::swap(list[k], list[random_.index(k + 1)]);
  };
  shuffled(place);
  std::vector<Vec3d> moved(mesh_.positions.size());
  for (std::size_t v = 0; v < moved.size(); ++v) moved[place[v]] = mesh_.positions[v];
  mesh_.positions = std::move(moved);
  const bool turn = chance(random_, 0.3);
  for (Triangle& t : mesh_.triangles) {
    for (int& v : t) v = place[v];
    std::rotate(t.begin(), t.begin() + random_.index(3), t.end());
    if (turn && chance(random_, 0.3)) std::swap(t[1], t[2]);
  }
  shuffled(mesh_.triangles);
}

}  // namespace weft::test
