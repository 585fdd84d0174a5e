#include "weft/cloth/baselines/filter_matrix.h"

#include <Eigen/Sparse>
#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// M - h^2 H: symmetric and positive definite.
Sparse system_of(const FilterGrid& grid) {
  const auto count = static_cast<int>(grid.mass.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(std::size_t{25} * grid.mass.size());  // itself, four for each of six springs
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, grid.mass[i]);
  const int n = grid.size;
  const double squared_step = grid.time_step * grid.time_step;
  for (int d = 0; d < spring_directions; ++d) {
    const auto [down, right] = spring_offsets[d];
    for (int r = 0; r + down < n; ++r)
      for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c) {
        const int i = grid.particle_of[r * n + c], j = grid.particle_of[(r + down) * n + c + right];
        const double k = squared_step * grid.stiffness[d](r, c);
        if (i == j || k == 0) continue;
        if (i >= 0) entries.emplace_back(i, i, k);
        if (j >= 0) entries.emplace_back(j, j, k);
        if (i < 0 || j < 0) continue;
        entries.emplace_back(i, j, -k);
        entries.emplace_back(j, i, -k);
      }
  }
  Sparse a(count, count);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

/// Computes rows of the inverse, several at a time, so that an entry of the factor is read once for
/// all.
class InverseRows {
 public:
  static constexpr int together = 16;

  explicit InverseRows(const Sparse& a) : factor_(a), pivot_(factor_.vectorD()) {}

  /// @param first  of the rows, in the factor's order
  /// @param x  [count x together] scratch; its row place(j) receives column j of the inverse's
  /// rows row_at(first), row_at(first + 1), ...
  void solve(int first, int rows, double* x) const {
    std::fill(x, x + std::ptrdiff_t{count()} * together, 0.0);
    for (int i = 0; i < rows; ++i) x[std::ptrdiff_t{first + i} * together + i] = 1;
    for (int k = first; k < count(); ++k) eliminate(k, x);
    for (int k = count() - 1; k >= 0; --k) substitute(k, x);
  }
  [[nodiscard]] int count() const { return static_cast<int>(pivot_.size()); }
  /// Position of an unknown in the factor's order.
  [[nodiscard]] int place(int unknown) const { return factor_.permutationP().indices()[unknown]; }
  [[nodiscard]] int row_at(int place) const { return factor_.permutationPinv().indices()[place]; }

 private:
  /// Entries of column k of the factor below its diagonal, which is 1.
  template <class Use>
  void for_each_below(int k, const Use& use) const {
    const auto& lower = factor_.matrixL().nestedExpression();
    const int *start = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
    for (int at = start[k]; at < start[k + 1]; ++at)
      if (row[at] > k) use(row[at], lower.valuePtr()[at]);
  }
  void eliminate(int k, double* x) const {
    const double* from = x + std::ptrdiff_t{k} * together;
    for_each_below(k, [&](int row, double value) {
      double* to = x + std::ptrdiff_t{row} * together;
#pragma omp simd
      for (int i = 0; i < together; ++i) to[i] -= value * from[i];
    });
  }
  void substitute(int k, double* x) const {
    double* to = x + std::ptrdiff_t{k} * together;
    const double inverse = 1 / pivot_[k];
#pragma omp simd
    for (int i = 0; i < together; ++i) to[i] *= inverse;
    for_each_below(k, [&](int row, double value) {
      const double* from = x + std::ptrdiff_t{row} * together;
#pragma omp simd
      for (int i = 0; i < together; ++i) to[i] -= value * from[i];
    });
  }

  Eigen::SimplicialLDLT<Sparse> factor_;
  Eigen::VectorXd pivot_;
};

}  // namespace

Grid<float> filter_matrix(const FilterGrid& grid, ThreadTeam& team) {
  const InverseRows inverse(system_of(grid));
  const int count = inverse.count();
  constexpr int together = InverseRows::together;
  Grid<float> w(count, count);
  std::vector<std::vector<double>> scratch(team.size());
  for (std::vector<double>& x : scratch) x.resize(std::size_t{together} * count);
  team.run([&](Worker& worker) {
    double* x = scratch[worker.rank()].data();
    const Range blocks = worker.share((count + together - 1) / together);
    for (int first = blocks.first * together; first < std::min(count, blocks.last * together);
         first += together) {
      const int rows = std::min(together, count - first);
      inverse.solve(first, rows, x);
      for (int i = 0; i < rows; ++i) {
        float* row = w.row(inverse.row_at(first + i));
        for (int j = 0; j < count; ++j)
          row[j] =
              static_cast<float>(grid.mass[j] * x[std::ptrdiff_t{inverse.place(j)} * together + i]);
      }
    }
  });
  return w;
}

}  // namespace weft
