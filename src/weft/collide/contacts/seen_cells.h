#pragma once

#include <array>
#include <cmath>
#include <cstdlib>

#include "weft/collide/broad_phase/cell_gaps.h"

namespace weft {

/// One of the two cells of a contact search.
struct CandidateCell {
  const SurfaceGrid* grid;
  int cell, row, col;
  bool second;  ///< whether it is the second of the two
  std::array<int, 4> samples;

  CandidateCell(const SurfaceGrid& of, int number, bool is_second)
      : grid(&of),
        cell(number),
        row(number / of.cells()),
        col(number % of.cells()),
        second(is_second),
        samples(of.corners(number)) {}
  [[nodiscard]] bool is_border() const {
    const int last = grid->cells() - 1;
    return row == 0 || col == 0 || row == last || col == last;
  }
  [[nodiscard]] bool next_to(const CandidateCell& other) const {
    return std::abs(row - other.row) <= 1 && std::abs(col - other.col) <= 1;
  }
  /// Calls visit(corner) for the samples that belong to it: its first, and at the last row and
  /// column those that no other cell begins with.
  template <class Visit>
  void for_own_corners(const Visit& visit) const {
    const int last = grid->cells() - 1;
    const std::array<bool, 4> own{true, col == last, row == last, row == last && col == last};
    for (int k = 0; k < 4; ++k)
      if (own[k] && grid->point(samples[k]) == samples[k]) visit(k);
  }
  /// The edges that belong to it, by its corners.
  [[nodiscard]] std::array<std::array<int, 2>, 3> own_edges() const {
    const bool rising = grid->triangle_corners(cell, 0)[2] == 3;
    return {{{0, 1}, {0, 2}, {rising ? 0 : 1, rising ? 3 : 2}}};
  }
};

/// A triangle in single precision, for tests that spare the exact one.
struct CandidateTriangle {
  Vec3f origin, first, second, across;
  float area;  ///< twice its area

  CandidateTriangle(const CellGaps& gaps, bool of_second, const std::array<int, 3>& corners)
      : origin(gaps.start(of_second, corners[0])),
        first(gaps.start(of_second, corners[1]) - origin),
        second(gaps.start(of_second, corners[2]) - origin),
        across(cross(first, second)),
        area(std::sqrt(squared_length(across))) {}
  /// Whether a point may lie above or below the inside of the triangle within `near`, rounding
  /// allowed for. [m]
  [[nodiscard]] bool may_hold(Vec3f point, float near) const {
    constexpr float hair = 1e-3F;
    const Vec3f from = point - origin;
    if (std::abs(dot(across, from)) > near * area) return false;
    const float min = -hair * area * area;
    const float u = dot(cross(from, second), across), v = dot(cross(first, from), across);
    return u >= min && v >= min && area * area - u - v >= min;
  }
};

/// An edge of a cell in single precision, for tests that spare the exact one.
struct CandidateEdge {
  std::array<int, 2> samples{};
  Vec3f origin, along;

  static CandidateEdge of(const CellGaps& gaps, const CandidateCell& cell,
                          const std::array<int, 2>& corners) {
    const Vec3f p = gaps.start(cell.second, corners[0]), q = gaps.start(cell.second, corners[1]);
    return {{cell.samples[corners[0]], cell.samples[corners[1]]}, p, q - p};
  }
  /// Whether the closest points of two edges may lie inside both and within `near`, rounding
  /// allowed for. [m]
  [[nodiscard]] bool may_cross(const CandidateEdge& other, float near) const {
    constexpr float hair = 1e-3F;
    const Vec3f from = origin - other.origin;
    const float a = dot(along, along), b = dot(along, other.along),
                c = dot(other.along, other.along), d = dot(along, from), e = dot(other.along, from);
    const float whole = a * c - b * b;         // the square of their cross product
    if (!(whole > hair * a * c)) return true;  // nearly parallel
    const float s = b * e - c * d, t = a * e - b * d;
    const float min = -hair * a * c, max = whole - min;
    if (s < min || s > max || t < min || t > max) return false;
    const float volume = dot(cross(along, other.along), from);
    return volume * volume <= near * near * whole;
  }
};

}  // namespace weft
