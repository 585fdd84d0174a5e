#include "weft/param/interior_solver.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>

namespace weft {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2>;
using Entries = std::vector<Eigen::Triplet<double>>;

}  // namespace

struct InteriorSolver::System {
  std::vector<Triangle> triangles;
  std::vector<int> interior;    ///< [D] row of an interior vertex, -1 on the border
  std::vector<int> vertex;      ///< the vertex of a row
  Matrix matrix;                ///< lower triangle, columns of interior vertices
  std::vector<int> slot;        ///< [3F] index of a half-edge's weight in the matrix' values, or -1
  std::vector<int> diagonal;    ///< [rows] index of each row's diagonal in the matrix' values
  std::vector<double> weights;  ///< of the last symmetric factorization
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> cholesky;

  [[nodiscard]] int rows() const { return static_cast<int>(vertex.size()); }
  [[nodiscard]] Columns pull_of_border(std::span<const double> half_edge_weights,
                                       std::span<const Vec2d> uv) const;
  void place(const Columns& solution, std::span<Vec2d> uv) const;
  void prepare_symmetric();
};

Columns InteriorSolver::System::pull_of_border(std::span<const double> half_edge_weights,
                                               std::span<const Vec2d> uv) const {
  Columns rhs = Columns::Zero(rows(), 2);
  for (int h = 0; h < static_cast<int>(half_edge_weights.size()); ++h) {
    const int row = interior[from_vertex(triangles, h)];
    const int to = to_vertex(triangles, h);
    if (row < 0 || interior[to] >= 0) continue;
    rhs(row, 0) += half_edge_weights[h] * uv[to].x;
    rhs(row, 1) += half_edge_weights[h] * uv[to].y;
  }
  return rhs;
}

void InteriorSolver::System::place(const Columns& solution, std::span<Vec2d> uv) const {
  for (int r = 0; r < rows(); ++r) uv[vertex[r]] = {solution(r, 0), solution(r, 1)};
}

void InteriorSolver::System::prepare_symmetric() {
  Entries entries;
  for (int r = 0; r < rows(); ++r) entries.emplace_back(r, r, 1.0);
  const int count = 3 * static_cast<int>(triangles.size());
  for (int h = 0; h < count; ++h) {
    const int row = interior[from_vertex(triangles, h)];
    const int col = interior[to_vertex(triangles, h)];
    if (col >= 0 && row > col) entries.emplace_back(row, col, 1.0);
  }
  matrix.resize(rows(), rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const auto slot_of = [&](int row, int col) {
    return static_cast<int>(&matrix.coeffRef(row, col) - matrix.valuePtr());
  };
  slot.assign(count, -1);
  for (int h = 0; h < count; ++h) {
    const int row = interior[from_vertex(triangles, h)];
    const int col = interior[to_vertex(triangles, h)];
    if (col >= 0 && row > col) slot[h] = slot_of(row, col);
  }
  diagonal.resize(rows());
  for (int r = 0; r < rows(); ++r) diagonal[r] = slot_of(r, r);
  if (rows() > 0) cholesky.analyzePattern(matrix);
}

InteriorSolver::InteriorSolver(const DiskMesh& disk, const HalfEdges& edges)
    : system_(std::make_unique<System>()) {
  System& s = *system_;
  s.triangles = disk.triangles;
  s.interior.assign(disk.positions.size(), 0);
  for (const int v : disk.border) s.interior[v] = -1;
  for (int v = 0; v < static_cast<int>(disk.positions.size()); ++v) {
    if (edges.outgoing[v] < 0) s.interior[v] = -1;
    if (s.interior[v] < 0) continue;
    s.interior[v] = s.rows();
    s.vertex.push_back(v);
  }
}

InteriorSolver::InteriorSolver(InteriorSolver&&) noexcept = default;
InteriorSolver& InteriorSolver::operator=(InteriorSolver&&) noexcept = default;
InteriorSolver::~InteriorSolver() = default;

bool InteriorSolver::factorize_symmetric(std::span<const double> weights) {
  System& s = *system_;
  s.weights.assign(weights.begin(), weights.end());
  if (s.rows() == 0) return true;
  if (s.diagonal.empty()) s.prepare_symmetric();
  double* const values = s.matrix.valuePtr();
  std::fill(values, values + s.matrix.nonZeros(), 0.0);
  for (int h = 0; h < static_cast<int>(weights.size()); ++h) {
    const int row = s.interior[from_vertex(s.triangles, h)];
    if (row < 0) continue;
    values[s.diagonal[row]] += weights[h];
    if (s.slot[h] >= 0) values[s.slot[h]] = -weights[h];
  }
  for (int i = 0; i < s.matrix.nonZeros(); ++i)
    if (!std::isfinite(values[i])) return false;
  s.cholesky.factorize(s.matrix);
  return s.cholesky.info() == Eigen::Success && (s.cholesky.vectorD().array() > 0).all();
}

void InteriorSolver::solve_symmetric(std::span<Vec2d> uv) const {
  const System& s = *system_;
  if (s.rows() == 0) return;
  s.place(s.cholesky.solve(s.pull_of_border(s.weights, uv)), uv);
}

bool InteriorSolver::solve_general(std::span<const double> weights, std::span<Vec2d> uv) const {
  const System& s = *system_;
  if (s.rows() == 0) return true;
  Entries entries;
  for (int h = 0; h < static_cast<int>(weights.size()); ++h) {
    const int row = s.interior[from_vertex(s.triangles, h)];
    const int col = s.interior[to_vertex(s.triangles, h)];
    if (row < 0) continue;
    entries.emplace_back(row, row, weights[h]);
    if (col >= 0) entries.emplace_back(row, col, -weights[h]);
  }
  Matrix matrix(s.rows(), s.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());

  // Column ordering: with a symmetric ordering the factors of SparseLU have ten times the fill.
  Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>> lu;
  lu.setPivotThreshold(0.0);
  lu.compute(matrix);
  if (lu.info() != Eigen::Success) return false;
  const Columns rhs = s.pull_of_border(weights, uv);
  Columns solution = lu.solve(rhs);
  for (int pass = 0; pass < 2; ++pass) {
    const Columns residual = rhs - matrix * solution;
    solution += lu.solve(residual);
  }
  if (!solution.allFinite()) return false;
  s.place(solution, uv);
  return true;
}

}  // namespace weft
