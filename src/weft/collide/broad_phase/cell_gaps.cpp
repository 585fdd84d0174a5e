#include "weft/collide/broad_phase/cell_gaps.h"

#include <cmath>

namespace weft {
namespace {

using Four = std::array<float, 4>;

/// Generous bound of the rounding error of a gap, relative to the farthest coordinate.
constexpr float rounding = 4e-6F;

inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }

float sum_of(const Four& of) { return (of[0] + of[1]) + (of[2] + of[3]); }
float farthest_of(const Four& a, const Four& b, const Four& c) {
  Four size{};
#pragma omp simd
  for (std::size_t k = 0; k < 4; ++k)
    size[k] = max(max(std::abs(a[k]), std::abs(b[k])), std::abs(c[k]));
  return max(max(size[0], size[1]), max(size[2], size[3]));
}

struct Bounds {
  float lower, upper;
};
Bounds bounds(Vec3f n, const Four& x, const Four& y, const Four& z) {
  Four along{};
#pragma omp simd
  for (std::size_t k = 0; k < 4; ++k) along[k] = n.x * x[k] + n.y * y[k] + n.z * z[k];
  return {min(min(along[0], along[1]), min(along[2], along[3])),
          max(max(along[0], along[1]), max(along[2], along[3]))};
}

Bounds displacement_bounds(const Four& start, const Four& end) {
  Four displacement{};
#pragma omp simd
  for (std::size_t k = 0; k < 4; ++k) displacement[k] = end[k] - start[k];
  return {min(min(displacement[0], displacement[1]), min(displacement[2], displacement[3])),
          max(max(displacement[0], displacement[1]), max(displacement[2], displacement[3]))};
}

}  // namespace

CellGaps::Corners CellGaps::corners(const Planes3& at, int first, Vec3f origin) {
  const int n = at.size(), row = first / n, col = first % n;
  const auto four = [&](const Grid<float>& plane, float from) {
    const float *upper = plane.row(row) + col, *lower = plane.row(row + 1) + col;
    return Four{upper[0] - from, upper[1] - from, lower[0] - from, lower[1] - from};
  };
  return {four(at.x, origin.x), four(at.y, origin.y), four(at.z, origin.z)};
}

CellGaps::CellGaps(const MovingSurface& a, int cell_a, const MovingSurface& b, int cell_b) {
  const int first_a = a.grid->first_sample(cell_a), first_b = b.grid->first_sample(cell_b);
  const Vec3f origin = a.start->at(first_a);
  start_a_ = corners(*a.start, first_a, origin);
  end_a_ = corners(*a.end, first_a, origin);
  start_b_ = corners(*b.start, first_b, origin);
  end_b_ = b.end == b.start ? start_b_ : corners(*b.end, first_b, origin);
  float farthest = 0;
  for (const Corners* of : {&start_a_, &end_a_, &start_b_, &end_b_})
    farthest = max(farthest, farthest_of(of->x, of->y, of->z));
  margin_ = rounding * farthest;
}

Vec3f CellGaps::normal_of(const Corners& of) {
  return cross(Vec3f{of.x[1] - of.x[2], of.y[1] - of.y[2], of.z[1] - of.z[2]},
               Vec3f{of.x[3] - of.x[0], of.y[3] - of.y[0], of.z[3] - of.z[0]});
}

Vec3f CellGaps::displacement() const {
  return {sum_of(start_a_.x) - sum_of(start_b_.x), sum_of(start_a_.y) - sum_of(start_b_.y),
          sum_of(start_a_.z) - sum_of(start_b_.z)};
}

bool CellGaps::apart_along(Vec3f n, float at_start, float at_end) const {
  const float size = std::sqrt(squared_length(n));
  const auto along = [n](const Corners& of) { return bounds(n, of.x, of.y, of.z); };
  const Bounds a = along(start_a_), b = along(start_b_);
  const bool above = a.lower - b.upper > size * at_start;
  if (!above && !(b.lower - a.upper > size * at_start)) return false;
  const Bounds c = along(end_a_), d = along(end_b_);
  return (above ? c.lower - d.upper : d.lower - c.upper) > size * at_end;
}

float CellGaps::gap_along(Vec3f n) const {
  const auto along = [n](const Corners& of) { return bounds(n, of.x, of.y, of.z); };
  const Bounds a = along(start_a_), b = along(start_b_), c = along(end_a_), d = along(end_b_);
  const float above = min(a.lower - b.upper, c.lower - d.upper);
  const float below = min(b.lower - a.upper, d.lower - c.upper);
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
  const auto along = [](const Four& start_a, const Four& end_a, const Four& start_b,
                        const Four& end_b) {
    const Bounds a = displacement_bounds(start_a, end_a), b = displacement_bounds(start_b, end_b);
    return max(a.upper - b.lower, b.upper - a.lower);
  };
  const Vec3f max{along(start_a_.x, end_a_.x, start_b_.x, end_b_.x),
                  along(start_a_.y, end_a_.y, start_b_.y, end_b_.y),
                  along(start_a_.z, end_a_.z, start_b_.z, end_b_.z)};
  return double{std::sqrt(squared_length(max))} + margin_;
}

bool CellGaps::apart(double at_start, double at_end) const {
  const float start = static_cast<float>(at_start) + margin_;
  const float end = static_cast<float>(at_end) + margin_;
  // The first direction separates neighbours in one layer, the normals separate layers.
  return apart_along(displacement(), start, end) || apart_along(normal_of(start_b_), start, end) ||
         apart_along(normal_of(start_a_), start, end);
}

}  // namespace weft
