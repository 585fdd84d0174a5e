#include "weft/mesh/shapes/clip.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace weft {
namespace {

class Clipper {
 public:
  Clipper(const TriangleMesh& mesh, const Field& cut)
      : mesh_(mesh), kept_(mesh.positions.size(), -1) {
    for (const Vec3d p : mesh.positions) values_.push_back(cut(p));
  }

  TriangleMesh run() {
    for (const Triangle& t : mesh_.triangles) add_clipped(t);
    return std::move(result_);
  }

 private:
  int add_vertex(Vec3d p) {
    result_.positions.push_back(p);
    return static_cast<int>(result_.positions.size()) - 1;
  }

  int keep(int v) {
    if (kept_[v] < 0) kept_[v] = add_vertex(mesh_.positions[v]);
    return kept_[v];
  }

  int cut_edge(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [entry, is_new] = cuts_.try_emplace({low, high}, -1);
    if (is_new) {
      const double t = values_[low] / (values_[low] - values_[high]);
      entry->second = add_vertex((1 - t) * mesh_.positions[low] + t * mesh_.positions[high]);
    }
    return entry->second;
  }

  /// Walks round the triangle, and makes a fan of what remains: a triangle or a quad.
  void add_clipped(const Triangle& t) {
    std::vector<int> outline;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (values_[a] < 0) outline.push_back(keep(a));
      if ((values_[a] < 0) != (values_[b] < 0)) outline.push_back(cut_edge(a, b));
    }
    for (std::size_t i = 2; i < outline.size(); ++i)
      result_.triangles.push_back({outline[0], outline[i - 1], outline[i]});
  }

  const TriangleMesh& mesh_;
  std::vector<double> values_;
  std::vector<int> kept_;
  std::map<std::pair<int, int>, int> cuts_;
  TriangleMesh result_;
};

}  // namespace

TriangleMesh clip(const TriangleMesh& mesh, const Field& cut) { return Clipper(mesh, cut).run(); }

}  // namespace weft
