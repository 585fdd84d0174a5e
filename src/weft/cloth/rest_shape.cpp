#include "weft/cloth/rest_shape.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/border_springs.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/seam_lengths.h"

namespace weft {
namespace {

double triangle_area(Vec3d a, Vec3d b, Vec3d c) { return 0.5 * length(cross(b - a, c - a)); }

/// The area of a cell's two triangles, cut along the shorter diagonal as images are rebuilt.
double cell_area_at(const Planes3& p, int r, int c) {
  const auto at = [&](int row, int col) { return vec_cast<double>(p.at(row, col)); };
  const Vec3d a = at(r, c), b = at(r, c + 1), d = at(r + 1, c), e = at(r + 1, c + 1);
  if (squared_length(e - a) <= squared_length(d - b))
    return triangle_area(a, b, e) + triangle_area(a, e, d);
  return triangle_area(a, b, d) + triangle_area(b, e, d);
}

double mean_spacing_of(const Planes3& p, const BorderMates& mates) {
  const int n = p.size();
  double sum = 0;
  long count = 0;
  const auto add = [&](double l) {
    sum += l;
    count += l > 0 ? 1 : 0;
  };
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const int here = r * n + c;
      if (c + 1 < n && mates.same_chart(here, here + 1))
        add(spring_length(p.at(r, c), p.at(r, c + 1)));
      if (r + 1 < n && mates.same_chart(here, here + n))
        add(spring_length(p.at(r, c), p.at(r + 1, c)));
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// The area that a stretch or shear spring stands for [m^2].
double strip_area(const RestShape& shape, SpringDirection direction, int r, int c) {
  const int cells = shape.size() - 1;
  const auto cell = [&](int row, int col) {
    const bool inside = row >= 0 && row < cells && col >= 0 && col < cells;
    return inside ? shape.cell_area(row, col) : 0.0;
  };
  switch (direction) {
    case stretch_u:
      return 0.5 * (cell(r - 1, c) + cell(r, c));
    case stretch_v:
      return 0.5 * (cell(r, c - 1) + cell(r, c));
    case shear_1:
      return cell(r, c);
    default:
      return cell(r, c - 1);
  }
}

struct SpringPlace {
  int row = 0, col = 0;
  double rest_length = 0;
};

/// The squared cosine of a stretch spring's angle to the warp, the mean of both ends'.
double warp_part(const RestShape& shape, SpringDirection direction, const SpringPlace& at) {
  const int n = shape.size(), from = at.row * n + at.col;
  const int to = direction == stretch_u ? from + 1 : from + n;
  const Vec3d edge = normalized(vec_cast<double>(shape.position.at(to)) -
                                vec_cast<double>(shape.position.at(from)));
  double part = 0;
  for (const int end : {from, to}) {
    const Vec3d warp = shape.warp_at(end);
    const double along = dot(edge, warp);
    const bool by_rows = !(squared_length(warp) > 0);
    part += 0.5 * (by_rows ? (direction == stretch_u ? 1.0 : 0.0) : along * along);
  }
  return part;
}

double stretch_of(const RestShape& shape, const WarpWeft& stretch, SpringDirection direction,
                  const SpringPlace& at) {
  const bool rows = shape.warp == nullptr || stretch.warp == stretch.weft;
  if (rows) return direction == stretch_u ? stretch.warp : stretch.weft;
  const double part = warp_part(shape, direction, at);
  return part * stretch.warp + (1 - part) * stretch.weft;
}

double stiffness_of(const RestShape& shape, const Material& material, SpringDirection direction,
                    const SpringPlace& at) {
  const double squared = at.rest_length * at.rest_length;
  switch (direction) {
    case stretch_u:
    case stretch_v:
      return stretch_of(shape, material.stretch, direction, at) *
             strip_area(shape, direction, at.row, at.col) / squared;
    case shear_1:
    case shear_2:
      return material.shear * strip_area(shape, direction, at.row, at.col) / squared;
    case bend_u:
    default:
      return material.bend_springs *
             (along_border(shape.mates, direction, at.row, at.col) ? 0.5 : 1.0);
  }
}

}  // namespace

RestShape::RestShape(const Planes3& rest, const BorderMates& border, const Planes3* warp_at_rest)
    : position(rest),
      mates(border),
      warp(warp_at_rest),
      cell_area(rest.size() - 1, rest.size() - 1),
      mean_spacing(mean_spacing_of(rest, border)) {
  for (int r = 0; r + 1 < size(); ++r)
    for (int c = 0; c + 1 < size(); ++c)
      if (mates.has_cell(r, c)) cell_area(r, c) = cell_area_at(rest, r, c);
}

SpringPlane make_springs(const RestShape& shape, const Material& material,
                         SpringDirection direction) {
  const int n = shape.size();
  const auto [down, right] = spring_offsets[direction];
  SpringPlane plane{down, right, Grid<float>(n, n, 1), Grid<float>(n, n), Grid<float>(n, n)};
  const auto min = static_cast<float>(min_relative_length * shape.mean_spacing);
  const SeamLengths seams(shape.position, shape.mates, std::max(down, std::abs(right)));
  const auto length_of = [&](int from, int to) {
    const float own = spring_length(shape.position.at(from), shape.position.at(to));
    return down == 0 || right == 0 ? seams.shortest(from, to, own) : own;
  };
  for (int r = 0; r + down < n; ++r)
    for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c) {
      const int from = r * n + c, to = (r + down) * n + c + right;
      if (!shape.mates.same_chart(from, to)) continue;
      if (shape.mates.representative(from) == shape.mates.representative(to)) continue;
      const float rest = std::max(min, length_of(from, to));
      plane.rest_length(r, c) = rest;
      plane.stiffness(r, c) =
          static_cast<float>(stiffness_of(shape, material, direction, {r, c, rest}));
    }
  return plane;
}

Grid<float> make_masses(const RestShape& shape, double density) {
  const int n = shape.size();
  Grid<double> mass(n, n);
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c) {
      const double quarter = 0.25 * density * shape.cell_area(r, c);
      for (const int corner : {0, 1, 2, 3}) mass(r + corner / 2, c + corner % 2) += quarter;
    }
  for (int index = 0; index < shape.mates.class_count(); ++index) {
    double sum = 0;
    for (const int s : shape.mates.mates(index)) sum += mass(s / n, s % n);
    for (const int s : shape.mates.mates(index)) mass(s / n, s % n) = sum;
  }
  Grid<float> result(n, n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) result(r, c) = static_cast<float>(mass(r, c));
  return result;
}

}  // namespace weft
