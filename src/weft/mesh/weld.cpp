#include "weft/mesh/weld.h"

#include <array>
#include <unordered_map>

#include "weft/core/hash.h"
#include "weft/mesh/topology.h"
#include "weft/repair.h"

namespace weft {
namespace {

struct PositionHash {
  std::size_t operator()(Vec3d p) const {
    Hash hash;
    // Adding zero makes one of the two zeros, which are equal.
    const std::array<double, 3> values{p.x + 0.0, p.y + 0.0, p.z + 0.0};
    hash.add(std::span<const double>(values));
    return hash.value();
  }
};

struct EdgeKinds {
  std::size_t border = 0, branching = 0;  ///< of one triangle, of more than two
};

EdgeKinds count_edges(const EdgeUses& edges) {
  EdgeKinds kinds;
  for (int e = 0; e < edges.edge_count(); ++e) {
    kinds.border += edges.of(e).size() == 1 ? 1 : 0;
    kinds.branching += edges.of(e).size() > 2 ? 1 : 0;
  }
  return kinds;
}

/// Whether each number is its own index.
bool is_in_order(std::span<const int> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] != static_cast<int>(i)) return false;
  return true;
}

}  // namespace

std::vector<int> first_at_position(std::span<const Vec3d> positions) {
  std::unordered_map<Vec3d, int, PositionHash> first;
  first.reserve(positions.size());
  std::vector<int> result;
  result.reserve(positions.size());
  for (const Vec3d p : positions)
    result.push_back(first.try_emplace(p, static_cast<int>(result.size())).first->second);
  return result;
}

void weld(std::span<Triangle> triangles, std::span<const int> first) {
  for (Triangle& t : triangles)
    for (int& v : t) v = first[v];
}

Welding find_welding(const TriangleMesh& mesh, const EdgeUses& edges) {
  const EdgeKinds before = count_edges(edges);
  if (before.border == 0) return {};
  std::vector<int> first = first_at_position(mesh.positions);
  if (is_in_order(first)) return {};
  std::vector<Triangle> triangles = mesh.triangles;
  weld(triangles, first);
  std::erase_if(triangles, repeats_a_vertex);
  const EdgeKinds after =
      count_edges(edge_uses(static_cast<int>(mesh.positions.size()), triangles));
  if (after.border >= before.border || after.branching > before.branching) return {};
  return {std::move(first), before.border - after.border};
}

TriangleMesh weld_exact(const TriangleMesh& mesh) {
  const std::vector<int> first = first_at_position(mesh.positions);
  TriangleMesh welded{{}, mesh.triangles, mesh.corner_uv};
  std::vector<int> number(first.size());
  for (std::size_t v = 0; v < first.size(); ++v) {
    const bool is_first = first[v] == static_cast<int>(v);
    number[v] = is_first ? static_cast<int>(welded.positions.size()) : number[first[v]];
    if (is_first) welded.positions.push_back(mesh.positions[v]);
  }
  weld(welded.triangles, number);
  return welded;
}

}  // namespace weft
