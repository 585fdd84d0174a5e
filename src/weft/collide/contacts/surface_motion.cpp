#include "weft/collide/contacts/surface_motion.h"

#include <algorithm>
#include <array>

namespace weft {
namespace {

/// Coordinates of an area vector, and its length.
constexpr int parts = 4;

std::array<float*, parts> rows_of(SurfaceMotion::Normals& of, int row) {
  return {of.unit.x.row(row), of.unit.y.row(row), of.unit.z.row(row), of.slant.row(row)};
}

}  // namespace

SurfaceMotion::SurfaceMotion(const SurfaceGrid& grid)
    : grid_(&grid),
      rising_(grid.cells(), grid.cells() + 2),
      there_(grid.cells(), grid.cells()),
      none_(static_cast<std::size_t>(grid.cells()) + 2, 0.0F) {
  for (int r = 0; r < grid.cells(); ++r)
    for (int c = 0; c < grid.cells(); ++c) {
      const int cell = r * grid.cells() + c;
      rising_(r, c + 1) = grid.rises(cell) ? 1.0F : 0.0F;
      there_(r, c) = grid.missing(cell) ? 0.0F : 1.0F;
    }
  for (Normals& one : ends_) one = {Planes3(grid.size()), Grid<float>(grid.size(), grid.size())};
  // Classes by their representatives, which are their least samples.
  const int samples = grid.size() * grid.size();
  std::vector<int> others;
  for (int s = 0; s < samples; ++s)
    if (grid.point(s) != s) others.push_back(s);
  std::stable_sort(others.begin(), others.end(),
                   [&](int a, int b) { return grid.point(a) < grid.point(b); });
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (i == 0 || grid.point(others[i]) != grid.point(others[i - 1])) {
      starts_.push_back(static_cast<int>(mates_.size()));
      mates_.push_back(grid.point(others[i]));
    }
    mates_.push_back(others[i]);
  }
  starts_.push_back(static_cast<int>(mates_.size()));
}

void SurfaceMotion::measure(const Planes3& start, const Planes3& end, ThreadTeam& team) {
  from_ = &start;
  to_ = &end;
  if (!knows_start_) measure(start, ends_[start_], team);
  knows_start_ = true;
  measure(end, ends_[1 - start_], team);
}

void SurfaceMotion::measure(const Planes3& at, Normals& out, ThreadTeam& team) {
  const MotionKernels& kernels = motion_kernels_for(team.instructions());
  const int n = grid_->size();
  const std::size_t areas = 2 * parts * none_.size();  // of both triangles of a row's cells
  scratch_.resize(static_cast<std::size_t>(team.size()));
  for (Scratch& one : scratch_) one.resize(2 * areas, 0.0F);
  team.run([&](Worker& worker) {
    const Range mine = worker.share(n);
    std::array<float*, 2> rows{scratch_[static_cast<std::size_t>(worker.rank())].data()};
    rows[1] = rows[0] + areas;
    for (int r = mine.first; r < mine.last; ++r) {
      if (r == mine.first && r > 0) find_areas(kernels, at, r - 1, rows[0]);
      if (r + 1 < n) find_areas(kernels, at, r, rows[1]);
      sum_row(kernels, r, r > 0 ? rows[0] : nullptr, r + 1 < n ? rows[1] : nullptr, out);
      std::swap(rows[0], rows[1]);
    }
    worker.barrier();
    if (worker.rank() == 0) sum_mates(out);
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r) kernels.find_normals(n, rows_of(out, r).data());
  });
}

/// @param out  areas of the first triangles, then of the second ones, each [4 x (cells + 2)]
void SurfaceMotion::find_areas(const MotionKernels& kernels, const Planes3& at, int row,
                               float* out) const {
  const std::size_t wide = none_.size();
  const auto areas = [&](std::size_t k) { return out + k * wide + 1; };
  kernels.cell_areas(
      grid_->cells(),
      {{at.x.row(row), at.y.row(row), at.z.row(row)},
       {at.x.row(row + 1), at.y.row(row + 1), at.z.row(row + 1)},
       rising_.row(row) + 1,
       there_.row(row)},
      {{areas(0), areas(1), areas(2), areas(3)}, {areas(4), areas(5), areas(6), areas(7)}});
}

/// @param before, behind  areas of the rows of cells around a row of samples; null: there is none
void SurfaceMotion::sum_row(const MotionKernels& kernels, int row, const float* before,
                            const float* behind, Normals& out) const {
  const std::size_t wide = none_.size();
  AreasAround around{};
  const std::array areas{before, behind};
  for (int side = 0; side < 2; ++side) {
    const float* of = areas[static_cast<std::size_t>(side)];
    around.rising[side] = of != nullptr ? rising_.row(row - 1 + side) : none_.data();
    for (int k = 0; k < parts; ++k) {
      around.first[side][k] = of != nullptr ? of + k * wide : none_.data();
      around.second[side][k] = of != nullptr ? of + (k + parts) * wide : none_.data();
    }
  }
  kernels.sum_areas(grid_->size(), around, rows_of(out, row).data());
}

/// Gives all mates of a class the sum over it.
void SurfaceMotion::sum_mates(Normals& out) const {
  const int n = grid_->size();
  for (Grid<float>* plane : {&out.unit.x, &out.unit.y, &out.unit.z, &out.slant})
    for (std::size_t k = 0; k + 1 < starts_.size(); ++k) {
      float sum = 0;
      for (int i = starts_[k]; i < starts_[k + 1]; ++i)
        sum += (*plane)(mates_[i] / n, mates_[i] % n);
      for (int i = starts_[k]; i < starts_[k + 1]; ++i)
        (*plane)(mates_[i] / n, mates_[i] % n) = sum;
    }
}

double SurfaceMotion::approach(int row, int col) const {
  const Vec3f normal = 0.5F * (at_start().unit.at(row, col) + at_end().unit.at(row, col));
  return std::fabs(dot(normal, to_->at(row, col) - from_->at(row, col)));
}

double SurfaceMotion::turn(int row, int col) const {
  return length(at_end().unit.at(row, col) - at_start().unit.at(row, col));
}

}  // namespace weft
