#include "weft/collide/broad_phase/cell_gaps.h"

#include <cmath>

#include "weft/core/four.h"

namespace weft {
namespace {

using UnalignedTwo = float __attribute__((vector_size(8), aligned(4), may_alias));

/// Generous bound of the rounding error of a gap, relative to the farthest coordinate.
constexpr float rounding = 4e-6F;

inline float max(float a, float b) { return a > b ? a : b; }
inline float min(float a, float b) { return a < b ? a : b; }
inline Four min(Four a, Four b) { return a < b ? a : b; }
inline Four max(Four a, Four b) { return a > b ? a : b; }

inline float sum_of(Four of) { return (of[0] + of[1]) + (of[2] + of[3]); }
inline Four size_of(Four a) { return max(a, -a); }

}  // namespace

CellGaps::Corners CellGaps::corners(const Planes3& at, int row, int col, Vec3f origin) {
  const auto four = [&](const Grid<float>& plane, float from) {
    const auto upper = *reinterpret_cast<const UnalignedTwo*>(plane.row(row) + col),
               lower = *reinterpret_cast<const UnalignedTwo*>(plane.row(row + 1) + col);
    return __builtin_shufflevector(upper, lower, 0, 1, 2, 3) - from;
  };
  return {four(at.x, origin.x), four(at.y, origin.y), four(at.z, origin.z)};
}

CellGaps::CellGaps(const MovingSurface& a, int cell_a, const MovingSurface& b, int cell_b) {
  const int row_a = cell_a / a.grid->cells(), col_a = cell_a % a.grid->cells(),
            row_b = cell_b / b.grid->cells(), col_b = cell_b % b.grid->cells();
  const Vec3f origin = a.start->at(row_a, col_a);
  start_a_ = corners(*a.start, row_a, col_a, origin);
  end_a_ = corners(*a.end, row_a, col_a, origin);
  start_b_ = corners(*b.start, row_b, col_b, origin);
  end_b_ = b.end == b.start ? start_b_ : corners(*b.end, row_b, col_b, origin);
  Four farthest{};
  for (const Corners* of : {&start_a_, &end_a_, &start_b_, &end_b_})
    farthest = max(farthest, max(max(size_of(of->x), size_of(of->y)), size_of(of->z)));
  margin_ = rounding * max(max(farthest[0], farthest[1]), max(farthest[2], farthest[3]));
}

Vec3f CellGaps::normal_of(const Corners& of) {
  return cross(Vec3f{of.x[1] - of.x[2], of.y[1] - of.y[2], of.z[1] - of.z[2]},
               Vec3f{of.x[3] - of.x[0], of.y[3] - of.y[0], of.z[3] - of.z[0]});
}

Vec3f CellGaps::displacement() const {
  return {sum_of(start_a_.x) - sum_of(start_b_.x), sum_of(start_a_.y) - sum_of(start_b_.y),
          sum_of(start_a_.z) - sum_of(start_b_.z)};
}

/// Extents of four rows of four. @param rows  become columns
CellGaps::Extents CellGaps::extents_of(Four* rows) {
  transpose(rows);
  return {min(min(rows[0], rows[1]), min(rows[2], rows[3])),
          max(max(rows[0], rows[1]), max(rows[2], rows[3]))};
}

CellGaps::Extents CellGaps::along(Vec3f n) const {
  const auto heights = [n](const Corners& of) { return n.x * of.x + n.y * of.y + n.z * of.z; };
  Four rows[4] = {heights(start_a_), heights(start_b_), heights(end_a_), heights(end_b_)};
  return extents_of(rows);
}

bool CellGaps::apart_along(Vec3f n, float at_start, float at_end) const {
  const float size = std::sqrt(squared_length(n));
  const auto [lower, upper] = along(n);
  const bool above = lower[start_of_a] - upper[start_of_b] > size * at_start;
  if (!above && !(lower[start_of_b] - upper[start_of_a] > size * at_start)) return false;
  return (above ? lower[end_of_a] - upper[end_of_b] : lower[end_of_b] - upper[end_of_a]) >
         size * at_end;
}

float CellGaps::gap_along(Vec3f n) const {
  const auto [lower, upper] = along(n);
  const float above = min(lower[start_of_a] - upper[start_of_b], lower[end_of_a] - upper[end_of_b]);
  const float below = min(lower[start_of_b] - upper[start_of_a], lower[end_of_b] - upper[end_of_a]);
  const float size = std::sqrt(squared_length(n));
  return size > 0 ? max(above, below) / size : 0;
}

float CellGaps::certain_gap() const {
  const float layers = max(gap_along(normal_of(start_a_)), gap_along(normal_of(start_b_)));
  return max(gap_along(displacement()), layers) - margin_;
}

bool CellGaps::parallel(float cosine) const {
  const Vec3f a = normal_of(start_a_), b = normal_of(start_b_);
  return std::abs(dot(a, b)) > cosine * std::sqrt(squared_length(a) * squared_length(b));
}

double CellGaps::max_approach() const {
  const auto extents = [](const Corners& start, const Corners& end) {
    Four rows[4] = {end.x - start.x, end.y - start.y, end.z - start.z, Four{}};
    return extents_of(rows);
  };
  const Extents a = extents(start_a_, end_a_), b = extents(start_b_, end_b_);
  const Four most = max(a.upper - b.lower, b.upper - a.lower);
  return double{std::sqrt(squared_length(Vec3f{most[0], most[1], most[2]}))} + margin_;
}

bool CellGaps::apart(double at_start, double at_end) const {
  const float start = static_cast<float>(at_start) + margin_;
  const float end = static_cast<float>(at_end) + margin_;
  // The first direction separates neighbours in one layer, the normals separate layers.
  return apart_along(displacement(), start, end) || apart_along(normal_of(start_b_), start, end) ||
         apart_along(normal_of(start_a_), start, end);
}

}  // namespace weft
