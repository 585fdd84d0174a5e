#include "weft/param/newton_system.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "weft/param/triangle_energy.h"

namespace weft {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Cholesky = Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>>;

/// A vector of unknowns: all u, all v.
struct Pair {
  Vector u, v;

  [[nodiscard]] double dot(const Pair& other) const { return u.dot(other.u) + v.dot(other.v); }
  void add(double scale, const Pair& other) {
    u += scale * other.u;
    v += scale * other.v;
  }
};

}  // namespace

struct NewtonSystem::Blocks {
  const DiskGeometry& geometry;
  std::vector<int> row;  ///< [D] of an interior vertex, -1 on the border
  Matrix uu, vv;         ///< lower triangles
  Matrix vu;             ///< whole; the block uv is its transpose
  std::vector<std::array<int, 9>>
      lower_slot;  ///< [F] where entry 3 i + j of a triangle goes, or -1
  std::vector<std::array<int, 9>> whole_slot;
  Pair gradient;
  Cholesky cholesky_u, cholesky_v;

  explicit Blocks(const DiskGeometry& shape) : geometry(shape) {}
  void number_rows();
  void prepare_pattern();
  void assemble(std::span<const Vec2d> uv);
  void add_triangle(std::size_t t, const TriangleEnergy& energy);
  [[nodiscard]] Pair multiply(const Pair& x) const;
  [[nodiscard]] Pair conjugate_gradients() const;
};

void NewtonSystem::Blocks::number_rows() {
  row.assign(geometry.disk.positions.size(), 0);
  for (const int v : geometry.disk.border) row[v] = -1;
  int count = 0;
  for (std::size_t v = 0; v < row.size(); ++v)
    row[v] = row[v] < 0 || geometry.edges.outgoing[v] < 0 ? -1 : count++;
  gradient = {Vector::Zero(count), Vector::Zero(count)};
}

void NewtonSystem::Blocks::prepare_pattern() {
  std::vector<Eigen::Triplet<double>> lower;
  std::vector<Eigen::Triplet<double>> whole;
  const auto& triangles = geometry.disk.triangles;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 9; ++i) {
      const int r = row[t[i / 3]];
      const int c = row[t[i % 3]];
      if (r < 0 || c < 0) continue;
      whole.emplace_back(r, c, 1.0);
      if (r >= c) lower.emplace_back(r, c, 1.0);
    }
  const auto count = gradient.u.size();
  vu.resize(count, count);
  vu.setFromTriplets(whole.begin(), whole.end());
  uu.resize(count, count);
  uu.setFromTriplets(lower.begin(), lower.end());
  lower_slot.resize(triangles.size());
  whole_slot.resize(triangles.size());
  const auto slot_of = [](Matrix& matrix, int r, int c) {
    return static_cast<int>(&matrix.coeffRef(r, c) - matrix.valuePtr());
  };
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 9; ++i) {
      const int r = row[triangles[t][i / 3]];
      const int c = row[triangles[t][i % 3]];
      const bool inside = r >= 0 && c >= 0;
      whole_slot[t][i] = inside ? slot_of(vu, r, c) : -1;
      lower_slot[t][i] = inside && r >= c ? slot_of(uu, r, c) : -1;
    }
  vv = uu;
  cholesky_u.analyzePattern(uu);
  cholesky_v.analyzePattern(vv);
}

void NewtonSystem::Blocks::add_triangle(std::size_t t, const TriangleEnergy& energy) {
  const auto hessian = [&](int a, int b) {
    double sum = 0;
    for (const auto& square : energy.squares) sum += square[a] * square[b];
    return sum;
  };
  for (int i = 0; i < 9; ++i) {
    const int a = 2 * (i / 3);
    const int b = 2 * (i % 3);
    if (lower_slot[t][i] >= 0) {
      uu.valuePtr()[lower_slot[t][i]] += hessian(a, b);
      vv.valuePtr()[lower_slot[t][i]] += hessian(a + 1, b + 1);
    }
    if (whole_slot[t][i] >= 0) vu.valuePtr()[whole_slot[t][i]] += hessian(a + 1, b);
  }
  for (int k = 0; k < 3; ++k) {
    const int r = row[geometry.disk.triangles[t][k]];
    if (r < 0) continue;
    gradient.u[r] += energy.gradient[2 * k];
    gradient.v[r] += energy.gradient[2 * k + 1];
  }
}

void NewtonSystem::Blocks::assemble(std::span<const Vec2d> uv) {
  for (Matrix* matrix : {&uu, &vv, &vu})
    std::fill(matrix->valuePtr(), matrix->valuePtr() + matrix->nonZeros(), 0.0);
  gradient.u.setZero();
  gradient.v.setZero();
  for (std::size_t t = 0; t < geometry.surface.size(); ++t) {
    const auto& [a, b, c] = geometry.disk.triangles[t];
    add_triangle(t, triangle_energy(geometry.surface[t], uv[a], uv[b], uv[c]));
  }
}

Pair NewtonSystem::Blocks::multiply(const Pair& x) const {
  Pair y;
  y.u = uu.selfadjointView<Eigen::Lower>() * x.u;
  y.u += vu.transpose() * x.v;
  y.v = vv.selfadjointView<Eigen::Lower>() * x.v;
  y.v += vu * x.u;
  return y;
}

/// Minus the inverse of the Hessian times the gradient, to a tenth in the preconditioner's norm.
/// Every iterate is a direction of descent, so ending early is safe.
Pair NewtonSystem::Blocks::conjugate_gradients() const {
  constexpr int most_iterations = 40;
  constexpr double tolerance = 0.1;
  const auto precondition = [&](const Pair& r) {
    return Pair{cholesky_u.solve(r.u), cholesky_v.solve(r.v)};
  };
  Pair x{Vector::Zero(gradient.u.size()), Vector::Zero(gradient.v.size())};
  Pair residual{-gradient.u, -gradient.v};
  Pair z = precondition(residual);
  Pair direction = z;
  double square = residual.dot(z);
  const double wanted = tolerance * tolerance * square;
  for (int iteration = 0; iteration < most_iterations && square > wanted; ++iteration) {
    const Pair image = multiply(direction);
    const double step = square / direction.dot(image);
    x.add(step, direction);
    residual.add(-step, image);
    z = precondition(residual);
    const double next = residual.dot(z);
    z.add(next / square, direction);
    std::swap(z, direction);
    square = next;
  }
  return x;
}

NewtonSystem::NewtonSystem(const DiskGeometry& geometry)
    : blocks_(std::make_unique<Blocks>(geometry)) {
  blocks_->number_rows();
  if (blocks_->gradient.u.size() > 0) blocks_->prepare_pattern();
}

NewtonSystem::~NewtonSystem() = default;

NewtonSystem::Step NewtonSystem::solve(std::span<const Vec2d> uv) {
  Blocks& b = *blocks_;
  if (b.gradient.u.size() == 0) return {};
  b.assemble(uv);
  b.cholesky_u.factorize(b.uu);
  b.cholesky_v.factorize(b.vv);
  if (b.cholesky_u.info() != Eigen::Success || b.cholesky_v.info() != Eigen::Success) return {};
  const Pair move = b.conjugate_gradients();
  Step step{{}, b.gradient.dot(move)};
  if (!(step.slope < 0) || !move.u.allFinite() || !move.v.allFinite()) return {};
  step.move.resize(uv.size());
  for (std::size_t v = 0; v < uv.size(); ++v)
    if (b.row[v] >= 0) step.move[v] = {move.u[b.row[v]], move.v[b.row[v]]};
  return step;
}

}  // namespace weft
