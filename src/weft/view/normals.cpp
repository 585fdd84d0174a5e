#include "weft/view/normals.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace weft {
namespace {

void add(Planes3& planes, int row, int col, Vec3f v) {
  planes.x(row, col) += v.x;
  planes.y(row, col) += v.y;
  planes.z(row, col) += v.z;
}

/// Adds twice the vector area of every quad, the cross product of its diagonals, to its four
/// corners.
void add_quads(const Planes3& positions, const Chart& chart, Planes3& sums) {
  for (int r = chart.row; r + 1 < chart.row + chart.rows; ++r)
    for (int c = chart.col; c + 1 < chart.col + chart.cols; ++c) {
      const Vec3f area = cross(positions.at(r + 1, c + 1) - positions.at(r, c),
                               positions.at(r + 1, c) - positions.at(r, c + 1));
      add(sums, r, c, area);
      add(sums, r, c + 1, area);
      add(sums, r + 1, c, area);
      add(sums, r + 1, c + 1, area);
    }
}

void join(Planes3& sums, std::span<const int> samples) {
  Vec3f sum;
  for (const int s : samples) sum += sums.at(s);
  for (const int s : samples) sums.set(s, sum);
}

/// Twice the vector area of every triangle.
std::vector<Vec3d> vector_areas(const TriangleMesh& mesh) {
  std::vector<Vec3d> areas;
  areas.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = mesh.positions[t[0]];
    areas.push_back(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
  }
  return areas;
}

/// The triangles at each vertex; one that has a vertex twice is listed twice, once for each corner.
std::vector<std::vector<int>> triangles_around(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> around(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) around[v].push_back(static_cast<int>(t));
  return around;
}

/// The normal of a vertex in one of its triangles: area-weighted over all triangles at the vertex
/// whose normals differ from it by less than the crease angle.
Vec3f smooth_normal(const std::vector<int>& around, const std::vector<Vec3d>& areas, Vec3d own) {
  constexpr double cosine_of_crease = 0.643;
  Vec3d sum;
  for (const int t : around)
    if (dot(areas[t], own) >= cosine_of_crease * length(areas[t]) * length(own)) sum += areas[t];
  return vec_cast<float>(normalized(sum));
}

}  // namespace

Planes3 grid_normals(const Planes3& positions, const BorderMates* mates) {
  const int n = positions.size();
  Planes3 normals(n);
  const bool joins = mates != nullptr && mates->size() == n;
  if (!joins) add_quads(positions, {"", 0, 0, n, n}, normals);
  if (joins)
    for (const Chart& chart : mates->charts()) add_quads(positions, chart, normals);
  if (joins)
    for (int i = 0; i < mates->class_count(); ++i) join(normals, mates->mates(i));
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) normals.set(r, c, normalized(normals.at(r, c)));
  return normals;
}

ShadedMesh shade_mesh(const TriangleMesh& mesh) {
  ShadedMesh shaded;
  for (const Vec3d p : mesh.positions) shaded.positions.push_back(vec_cast<float>(p));
  shaded.normals.resize(mesh.positions.size());
  shaded.source.resize(mesh.positions.size());
  std::iota(shaded.source.begin(), shaded.source.end(), 0);
  shaded.triangles = mesh.triangles;
  const std::vector<Vec3d> areas = vector_areas(mesh);
  const std::vector<std::vector<int>> around = triangles_around(mesh);
  for (std::size_t v = 0; v < around.size(); ++v) {
    std::vector<int> copies;  // of this vertex, each with a normal of its own
    for (const int t : around[v]) {
      const Vec3f normal = smooth_normal(around[v], areas, areas[t]);
      const auto same = std::find_if(copies.begin(), copies.end(), [&](int copy) {
        return squared_length(shaded.normals[copy] - normal) < 1e-6F;
      });
      int vertex = static_cast<int>(v);
      if (same != copies.end()) {
        vertex = *same;
      } else {
        if (!copies.empty()) {
          vertex = static_cast<int>(shaded.positions.size());
          shaded.positions.push_back(shaded.positions[v]);
          shaded.normals.emplace_back();
          shaded.source.push_back(static_cast<int>(v));
        }
        shaded.normals[vertex] = normal;
        copies.push_back(vertex);
      }
      Triangle& corners = shaded.triangles[t];
      *std::find(corners.begin(), corners.end(), static_cast<int>(v)) = vertex;
    }
  }
  return shaded;
}

}  // namespace weft
