#include "weft/param/newton_system.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "weft/param/triangle_energy.h"

namespace weft {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Cholesky = Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>>;

/// A vector over the unknowns, by block: u, v.
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
  /// [2 D] index of the unknown of each vertex' u and v, -1 where fixed; those of block u come
  /// first, then block v. A freedom's unknown is in the block of its vertex' axis; its mate's
  /// coordinate has the same.
  std::vector<int> unknown;
  std::vector<double> sign;    ///< [2 D] derivative of the coordinate by its unknown
  std::vector<bool> freedoms;  ///< [F] whether a corner is on the border
  int rows_u = 0, rows_v = 0;
  Matrix uu, vv;  ///< lower triangles
  Matrix vu;      ///< all entries; the block uv is its transpose
  /// [F] index in `values` of each entry (a, b), a <= b, of the local Hessian, row by row; -1: none
  std::vector<std::array<int, 21>> slot;
  std::vector<double> values;  ///< of uu, vv and vu, one after the other
  Pair gradient;
  Cholesky cholesky_u, cholesky_v;

  explicit Blocks(const DiskGeometry& shape) : geometry(shape) {}
  void number_unknowns(std::span<const BorderFreedom> border_freedoms);
  void prepare_pattern();
  void prepare_slots();
  void assemble(std::span<const Vec2d> uv);
  void reduce(std::size_t t, TriangleEnergy& energy) const;
  void add_triangle(std::size_t t, const TriangleEnergy& energy);
  [[nodiscard]] std::array<int, 6> unknowns_of(std::size_t t) const;
  [[nodiscard]] Pair multiply(const Pair& x) const;
  [[nodiscard]] Pair conjugate_gradients() const;
};

void NewtonSystem::Blocks::number_unknowns(std::span<const BorderFreedom> border_freedoms) {
  const std::size_t vertices = geometry.disk.positions.size();
  std::vector<bool> border(vertices, false);
  for (const int v : geometry.disk.border) border[v] = true;
  unknown.assign(2 * vertices, -1);
  sign.assign(2 * vertices, 1.0);
  const auto number = [&](int axis) {
    int row = axis == 0 ? 0 : rows_u;
    for (std::size_t v = 0; v < vertices; ++v)
      if (!border[v] && geometry.edges.outgoing[v] >= 0) unknown[2 * v + axis] = row++;
    for (const BorderFreedom& freedom : border_freedoms) {
      if (freedom.axis != axis) continue;
      unknown[2 * freedom.vertex + axis] = row;
      if (freedom.mate >= 0) {
        unknown[2 * freedom.mate + freedom.mate_axis] = row;
        sign[2 * freedom.mate + freedom.mate_axis] = freedom.sign;
      }
      ++row;
    }
    return row;
  };
  rows_u = number(0);
  rows_v = number(1) - rows_u;
  gradient = {Vector::Zero(rows_u), Vector::Zero(rows_v)};
  freedoms.assign(geometry.surface.size(), false);
  for (std::size_t t = 0; t < freedoms.size(); ++t)
    for (const int v : geometry.disk.triangles[t])
      if (border[v]) freedoms[t] = true;
}

/// The unknowns of a triangle's u, v at corner 0, 1, 2; -1 where fixed or equal to an earlier one.
std::array<int, 6> NewtonSystem::Blocks::unknowns_of(std::size_t t) const {
  std::array<int, 6> found{};
  for (int i = 0; i < 6; ++i) {
    const int own = unknown[2 * geometry.disk.triangles[t][i / 2] + i % 2];
    found[i] = std::find(found.begin(), found.begin() + i, own) == found.begin() + i ? own : -1;
  }
  return found;
}

void NewtonSystem::Blocks::prepare_pattern() {
  std::vector<Eigen::Triplet<double>> u, v, mixed;
  for (std::size_t t = 0; t < geometry.surface.size(); ++t) {
    const std::array<int, 6> row = unknowns_of(t);
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) {
        if (row[a] < 0 || row[b] < 0) continue;
        const bool a_in_u = row[a] < rows_u;
        const bool b_in_u = row[b] < rows_u;
        if (a_in_u && b_in_u && row[a] >= row[b]) u.emplace_back(row[a], row[b], 1.0);
        if (!a_in_u && !b_in_u && row[a] >= row[b])
          v.emplace_back(row[a] - rows_u, row[b] - rows_u, 1.0);
        if (!a_in_u && b_in_u) mixed.emplace_back(row[a] - rows_u, row[b], 1.0);
      }
  }
  uu.resize(rows_u, rows_u);
  uu.setFromTriplets(u.begin(), u.end());
  vv.resize(rows_v, rows_v);
  vv.setFromTriplets(v.begin(), v.end());
  vu.resize(rows_v, rows_u);
  vu.setFromTriplets(mixed.begin(), mixed.end());
  cholesky_u.analyzePattern(uu);
  cholesky_v.analyzePattern(vv);
}

void NewtonSystem::Blocks::prepare_slots() {
  const auto slot_of = [&](int a, int b) {
    const int high = std::max(a, b);
    const int low = std::min(a, b);
    const auto count_u = uu.nonZeros();
    if (high < rows_u) return static_cast<int>(&uu.coeffRef(high, low) - uu.valuePtr());
    if (low >= rows_u)
      return static_cast<int>(&vv.coeffRef(high - rows_u, low - rows_u) - vv.valuePtr() + count_u);
    return static_cast<int>(&vu.coeffRef(high - rows_u, low) - vu.valuePtr() + count_u +
                            vv.nonZeros());
  };
  slot.resize(geometry.surface.size());
  for (std::size_t t = 0; t < slot.size(); ++t) {
    const std::array<int, 6> row = unknowns_of(t);
    int entry = 0;
    for (int a = 0; a < 6; ++a)
      for (int b = a; b < 6; ++b, ++entry)
        slot[t][entry] = row[a] >= 0 && row[b] >= 0 ? slot_of(row[a], row[b]) : -1;
  }
  values.resize(uu.nonZeros() + vv.nonZeros() + vu.nonZeros());
}

/// Converts a border triangle's derivatives from coordinates to unknowns: that of a coordinate that
/// runs against its unknown changes sign, and that of one which shares an earlier coordinate's
/// unknown is added there.
void NewtonSystem::Blocks::reduce(std::size_t t, TriangleEnergy& energy) const {
  const Triangle& corners = geometry.disk.triangles[t];
  const auto coordinate = [&](int i) { return 2 * corners[i / 2] + i % 2; };
  for (int i = 0; i < 6; ++i) {
    const int own = unknown[coordinate(i)];
    if (own < 0) continue;
    int first = 0;
    while (unknown[coordinate(first)] != own) ++first;
    const auto fold = [&](std::array<double, 6>& row) {
      row[i] *= sign[coordinate(i)];
      if (first < i) row[first] += row[i];
    };
    fold(energy.gradient);
    for (auto& square : energy.squares) fold(square);
  }
}

void NewtonSystem::Blocks::add_triangle(std::size_t t, const TriangleEnergy& energy) {
  const auto& s = energy.squares;
  int entry = 0;
  for (int a = 0; a < 6; ++a)
    for (int b = a; b < 6; ++b, ++entry)
      if (slot[t][entry] >= 0)
        values[slot[t][entry]] += s[0][a] * s[0][b] + s[1][a] * s[1][b] + s[2][a] * s[2][b] +
                                  s[3][a] * s[3][b] + s[4][a] * s[4][b] + s[5][a] * s[5][b] +
                                  s[6][a] * s[6][b] + s[7][a] * s[7][b];
  const std::array<int, 6> row = unknowns_of(t);
  for (int i = 0; i < 6; ++i) {
    if (row[i] < 0) continue;
    if (row[i] < rows_u) {
      gradient.u[row[i]] += energy.gradient[i];
    } else {
      gradient.v[row[i] - rows_u] += energy.gradient[i];
    }
  }
}

void NewtonSystem::Blocks::assemble(std::span<const Vec2d> uv) {
  std::fill(values.begin(), values.end(), 0.0);
  gradient.u.setZero();
  gradient.v.setZero();
  const double mean_square = geometry.mean_square_stretch(uv);
  for (std::size_t t = 0; t < geometry.surface.size(); ++t) {
    const auto& [a, b, c] = geometry.disk.triangles[t];
    TriangleEnergy energy = triangle_energy(geometry.surface[t], uv[a], uv[b], uv[c]);
    weigh_by_curvature(energy, geometry.surface[t].area,
                       geometry.curvature_weight[t] / mean_square);
    add_inverse_stretch(energy, geometry.surface[t],
                        mean_square * mean_square * geometry.inverse[t], {uv[a], uv[b], uv[c]});
    if (freedoms[t]) reduce(t, energy);
    add_triangle(t, energy);
  }
  const double* from = values.data();
  for (Matrix* matrix : {&uu, &vv, &vu}) {
    std::copy_n(from, matrix->nonZeros(), matrix->valuePtr());
    from += matrix->nonZeros();
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

/// Newton step, minus the inverse of the Hessian times the gradient, to a relative residual of a
/// tenth in the preconditioner's norm. Every iterate is a descent direction, so ending early is
/// safe.
Pair NewtonSystem::Blocks::conjugate_gradients() const {
  constexpr int max_iterations = 40;
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
  for (int iteration = 0; iteration < max_iterations && square > wanted; ++iteration) {
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

NewtonSystem::NewtonSystem(const DiskGeometry& geometry, std::span<const BorderFreedom> freedoms)
    : blocks_(std::make_unique<Blocks>(geometry)) {
  blocks_->number_unknowns(freedoms);
  if (blocks_->rows_u + blocks_->rows_v == 0) return;
  blocks_->prepare_pattern();
  blocks_->prepare_slots();
}

NewtonSystem::~NewtonSystem() = default;

NewtonSystem::Step NewtonSystem::solve(std::span<const Vec2d> uv) {
  Blocks& b = *blocks_;
  if (b.rows_u + b.rows_v == 0) return {};
  b.assemble(uv);
  b.cholesky_u.factorize(b.uu);
  b.cholesky_v.factorize(b.vv);
  if (b.cholesky_u.info() != Eigen::Success || b.cholesky_v.info() != Eigen::Success) return {};
  const Pair move = b.conjugate_gradients();
  Step step{{}, b.gradient.dot(move)};
  if (!(step.slope < 0) || !move.u.allFinite() || !move.v.allFinite()) return {};
  const auto value = [&](std::size_t coordinate) {
    const int row = b.unknown[coordinate];
    if (row < 0) return 0.0;
    return b.sign[coordinate] * (row < b.rows_u ? move.u[row] : move.v[row - b.rows_u]);
  };
  step.move.resize(uv.size());
  for (std::size_t v = 0; v < uv.size(); ++v) step.move[v] = {value(2 * v), value(2 * v + 1)};
  return step;
}

}  // namespace weft
