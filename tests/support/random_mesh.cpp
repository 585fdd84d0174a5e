#include "tests/support/random_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/random_mesh_builder.h"
#include "tests/support/random_points.h"
#include "tests/support/random_surfaces.h"
#include "weft/core/math.h"

namespace weft::test {
namespace {

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
  RandomMeshBuilder builder(seed + 1'000'000);
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
  RandomMeshBuilder builder(seed);
  builder.shape();
  builder.shuffle();
  return {std::move(builder.mesh()), builder.made_of()};
}

BrokenMesh random_broken_mesh(std::uint64_t seed) {
  RandomMeshBuilder builder(seed);
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
