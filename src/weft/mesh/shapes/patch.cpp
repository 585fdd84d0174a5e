#include "weft/mesh/shapes/patch.h"

#include <algorithm>
#include <array>
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

  /// Clips a triangle and adds the remaining triangle or quad as a fan.
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

namespace {

/// The vertices of a patch, row by row.
class PatchVertices {
 public:
  explicit PatchVertices(const Patch& patch)
      : rows_(patch.wraps_v ? patch.rows : patch.rows + 1),
        cols_(patch.wraps_u ? patch.cols : patch.cols + 1) {}
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] int at(int row, int col) const { return row % rows_ * cols_ + col % cols_; }

 private:
  int rows_, cols_;
};

void add_quad(TriangleMesh& mesh, const std::array<int, 4>& q) {
  const auto squared = [&](int i, int j) {
    return squared_length(mesh.positions[i] - mesh.positions[j]);
  };
  if (squared(q[0], q[2]) <= squared(q[1], q[3])) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  } else {
    mesh.triangles.push_back({q[0], q[1], q[3]});
    mesh.triangles.push_back({q[1], q[2], q[3]});
  }
}

}  // namespace

TriangleMesh patch_mesh(const Patch& patch, const std::function<Vec3d(double u, double v)>& point) {
  const PatchVertices vertex(patch);
  TriangleMesh mesh;
  for (int r = 0; r < vertex.rows(); ++r)
    for (int c = 0; c < vertex.cols(); ++c)
      mesh.positions.push_back(
          point(static_cast<double>(c) / patch.cols, static_cast<double>(r) / patch.rows));
  for (int r = 0; r < patch.rows; ++r)
    for (int c = 0; c < patch.cols; ++c)
      add_quad(mesh, {vertex.at(r, c), vertex.at(r, c + 1), vertex.at(r + 1, c + 1),
                      vertex.at(r + 1, c)});
  return mesh;
}

}  // namespace weft
