#include "tests/support/random_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/random_points.h"
#include "tests/support/random_surfaces.h"
#include "weft/core/math.h"
#include "weft/core/random.h"
#include "weft/mesh/topology.h"

namespace weft::test {
namespace {

/// From low to high, every power of two as likely; without the C library's pow, which differs.
double log_uniform(Random& random, double low, double high) {
  const int octaves = std::ilogb(high / low) + 1;
  return std::min(high, std::ldexp(low * random.uniform(1, 2), random.index(octaves)));
}

/// A mesh under construction: manifold, connected, and it stays so.
class Builder {
 public:
  explicit Builder(std::uint64_t seed) : random_(seed) {
    wanted_ = log_uniform(random_, 20, 5000);
    start();
  }

  void shape() {
    const int handles = chance(random_, 0.5) ? random_.index(6) : 0;
    for (int k = 0; k < handles; ++k) add_handle();
    const int holes = chance(random_, 0.5) ? random_.index(8) : 0;
    for (int k = 0; k < holes; ++k) add_hole();
    refine();
    if (chance(random_, 0.6)) add_noise();
    if (chance(random_, 0.4)) add_slivers();
    if (chance(random_, 0.7)) scale();
  }

  /// Replaces what two triangles cover by a tube between them; `twisted` against the orientation.
  /// @return whether two triangles far enough apart were found
  bool add_handle(bool twisted = false);
  /// Puts vertices and triangles in random order, maybe some triangles the other way round.
  void shuffle();
  Random& random() { return random_; }
  TriangleMesh& mesh() { return mesh_; }
  [[nodiscard]] const std::string& made_of() const { return made_of_; }

 private:
  void say(std::string_view what) { made_of_.append(made_of_.empty() ? "" : ", ").append(what); }
  [[nodiscard]] int triangle_count() const { return static_cast<int>(mesh_.triangles.size()); }
  void start();
  void add_hole();
  void refine();
  void split_edge(int half_edge, double fraction);
  void split_face(int triangle, std::array<double, 3> weights);
  void add_noise();
  void add_slivers();
  void scale();
  [[nodiscard]] HalfEdges edges() const {
    return half_edges(static_cast<int>(mesh_.positions.size()), mesh_.triangles);
  }
  [[nodiscard]] double mean_edge() const;

  Random random_;
  double wanted_ = 0;
  TriangleMesh mesh_;
  std::string made_of_;
};

void Builder::start() {
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

bool Builder::add_handle(bool twisted) {
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
void Builder::add_hole() {
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

void Builder::split_edge(int half_edge, double fraction) {
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

void Builder::split_face(int triangle, std::array<double, 3> weights) {
  const auto [a, b, c] = mesh_.triangles[triangle];
  const int middle = static_cast<int>(mesh_.positions.size());
  mesh_.positions.push_back(weights[0] * mesh_.positions[a] + weights[1] * mesh_.positions[b] +
                            weights[2] * mesh_.positions[c]);
  mesh_.triangles[triangle] = {a, b, middle};
  mesh_.triangles.push_back({b, c, middle});
  mesh_.triangles.push_back({c, a, middle});
}

/// Splits edges and faces, here and there again and again.
void Builder::refine() {
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

double Builder::mean_edge() const {
  double sum = 0;
  for (const Triangle& t : mesh_.triangles)
    sum += length(mesh_.positions[t[0]] - mesh_.positions[t[1]]);
  return sum / triangle_count();
}

void Builder::add_noise() {
  const double amount = log_uniform(random_, 0.01, 1) * mean_edge();
  for (Vec3d& p : mesh_.positions) p = p + amount * random_point(random_);
  say("noise");
}

/// Splits next to ends and corners, and vertices put upon each other or upon an edge.
void Builder::add_slivers() {
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

void Builder::scale() {
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

void Builder::shuffle() {
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

/// Adds a mesh beside another.
void add_beside(TriangleMesh& mesh, const TriangleMesh& other) {
  Box3d box, other_box;
  for (const Vec3d p : mesh.positions) box.add(p);
  for (const Vec3d p : other.positions) other_box.add(p);
  const auto first = static_cast<int>(mesh.positions.size());
  const double shift = box.upper.x - other_box.lower.x + 0.1 * box.diagonal();
  for (const Vec3d p : other.positions) mesh.positions.push_back(p + Vec3d{shift, 0, 0});
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
}

/// A band of quads, or with `is_closed` a bottle, that is joined to itself the other way round.
TriangleMesh one_sided(int around, int across, bool is_closed) {
  const int rows = is_closed ? across : across + 1;
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < rows; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / across;
      const double side = is_closed ? 0.4 * sine(v) : 0.6 * (static_cast<double>(j) / across - 0.5);
      const double up = is_closed ? 0.2 * sine(2 * v) : 0;
      const double radius = 1 + side * cosine(u / 2) - up * sine(u / 2);
      mesh.positions.push_back(
          {radius * cosine(u), side * sine(u / 2) + up * cosine(u / 2), radius * sine(u)});
    }
  const auto at = [&](int i, int j) {
    if (i == around) return is_closed ? (across - j) % across : across - j;
    return i * rows + j % rows;
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  return mesh;
}

void add_fins(TriangleMesh& mesh, Random& random) {
  const Triangle some = mesh.triangles[random.index(static_cast<int>(mesh.triangles.size()))];
  const Vec3d from = mesh.positions[some[0]];
  const double size = length(mesh.positions[some[1]] - from);
  const int fins = 1 + random.index(3);
  for (int k = 0; k < fins; ++k) {
    mesh.positions.push_back(from + size * random_point(random));
    mesh.triangles.push_back({some[0], some[1], static_cast<int>(mesh.positions.size()) - 1});
  }
}

/// Gives some triangles vertices of their own, at the same places.
void split_vertices(TriangleMesh& mesh, Random& random) {
  const double part = chance(random, 0.3) ? 1 : random.uniform(0, 0.5);
  for (Triangle& t : mesh.triangles)
    if (chance(random, part))
      for (int& v : t) {
        mesh.positions.push_back(mesh.positions[v]);
        v = static_cast<int>(mesh.positions.size()) - 1;
      }
}

void repeat_triangles(TriangleMesh& mesh, Random& random) {
  const auto count = static_cast<int>(mesh.triangles.size());
  const int repeated = 1 + random.index(1 + count / 4);
  for (int k = 0; k < repeated; ++k) {
    Triangle t = mesh.triangles[random.index(count)];
    std::rotate(t.begin(), t.begin() + random.index(3), t.end());
    if (chance(random, 0.3)) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
}

bool has_coincident_vertices(const TriangleMesh& mesh) {
  std::vector<Vec3d> sorted = mesh.positions;
  const auto key = [](Vec3d p) { return std::array{p.x, p.y, p.z}; };
  std::sort(sorted.begin(), sorted.end(), [&](Vec3d a, Vec3d b) { return key(a) < key(b); });
  return std::adjacent_find(sorted.begin(), sorted.end(),
                            [&](Vec3d a, Vec3d b) { return key(a) == key(b); }) != sorted.end();
}

}  // namespace

RandomComplex random_complex(std::uint64_t seed) {
  Builder builder(seed + 1'000'000);
  Random& random = builder.random();
  TriangleMesh& mesh = builder.mesh();
  std::string made_of;
  builder.shape();
  const auto say = [&](const std::string& what) { made_of += ", " + what; };
  if (chance(random, 0.3) && builder.add_handle(true)) say("twisted");
  const int pieces = random.index(3);
  for (int k = 0; k < pieces; ++k) {
    const int around = 5 + random.index(40), across = 3 + random.index(8), kind = random.index(3);
    if (kind == 0) {
      add_beside(mesh, random_mesh(seed + 2'000'000 + std::uint64_t(k)).mesh);
    } else {
      add_beside(mesh, one_sided(around, across, kind == 2));
    }
    say(std::array{"a piece", "a Moebius band", "a Klein bottle"}[kind]);
  }
  const int edges = chance(random, 0.6) ? 1 + random.index(4) : 0;
  for (int k = 0; k < edges; ++k) add_fins(mesh, random);
  if (edges > 0) say("fins on " + std::to_string(edges) + " edges");
  builder.shuffle();
  RandomComplex made{.mesh = mesh, .whole = mesh, .made_of = builder.made_of() + made_of};
  if (edges == 0 && !has_coincident_vertices(mesh) && chance(random, 0.7)) {
    split_vertices(made.mesh, random);
    made.made_of += ", split vertices";
  } else if (chance(random, 0.5)) {
    repeat_triangles(made.mesh, random);
    made.made_of += ", repeated triangles";
  }
  return made;
}

RandomMesh random_mesh(std::uint64_t seed) {
  Builder builder(seed);
  builder.shape();
  builder.shuffle();
  return {std::move(builder.mesh()), builder.made_of()};
}

BrokenMesh random_broken_mesh(std::uint64_t seed) {
  Builder builder(seed);
  TriangleMesh& mesh = builder.mesh();
  Random& random = builder.random();
  const auto vertices = [&] { return static_cast<int>(mesh.positions.size()); };
  const auto add = [&](Vec3d p) {
    mesh.positions.push_back(p);
    return vertices() - 1;
  };
  std::string error;
  int kind = random.index(6);
  builder.shape();
  if (kind == 0 && !builder.add_handle(true)) kind = 1;
  builder.shuffle();
  const Triangle some = mesh.triangles[random.index(static_cast<int>(mesh.triangles.size()))];
  switch (kind) {
    case 0:
      error = "not orientable";
      break;
    case 1:
      // Three fins on one edge, so that no border is left to hide on.
      for (int k = 0; k < 3; ++k)
        mesh.triangles.push_back({some[0], some[1], add(random_point(random))});
      error = "non-manifold edge";
      break;
    case 2: {
      const int first = vertices();
      const TriangleMesh other = tetrahedron();
      for (const Vec3d p : other.positions) add(p);
      for (const Triangle& t : other.triangles)
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      error = "2 components";
      break;
    }
    case 3:
      mesh.positions[some[0]].y = chance(random, 0.5) ? std::numeric_limits<double>::quiet_NaN()
                                                      : std::numeric_limits<double>::infinity();
      error = "finite coordinates";
      break;
    case 4:
      mesh.triangles.push_back({some[0], some[1], chance(random, 0.5) ? -1 : vertices()});
      error = "an existing vertex is wanted";
      break;
    default:
      for (Vec3d& p : mesh.positions) p.x = p.y = p.z = 1;
      error = "no triangle has an area";
  }
  return {std::move(mesh), builder.made_of() + ", then spoiled", error};
}

}  // namespace weft::test
