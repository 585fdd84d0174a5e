#include "weft/mesh/shapes/patch.h"

#include <array>

namespace weft {
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
