#include "weft/cloth/bending_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "weft/cloth/bending_border.h"

namespace weft {
namespace {

/// The affine conditions and the second moments that weights have to meet.
constexpr int conditions = 5;
using Column = std::array<double, conditions>;

/// The target operator L = a d^2/du^2 + b d^2/dv^2 of the weights, u along the rows: a and b are
/// the square roots of the two stiffnesses over the larger one.
struct Operator {
  double stiffness = 0;  ///< the larger of warp's and weft's [N m]
  double along_rows = 1, along_columns = 1;

  explicit Operator(WarpWeft bending)
      : stiffness(std::max(bending.warp, bending.weft)),
        along_rows(std::sqrt(bending.warp / stiffness)),
        along_columns(std::sqrt(bending.weft / stiffness)) {}
};

/// Moments that the weights around a particle have to match, in its tangent plane.
using Moments = Column;

/// Regularisation of the conditions in the least-squares fit: the second moments are soft where
/// they cannot be matched, the affine conditions practically hard.
constexpr double softness = 1e-3, affine_softness = 1e-11;
/// Penalty factors of weights whose target is zero: on diagonals, and off the border at free
/// borders.
constexpr double diagonal_cost = 4, across_border_cost = 100;
/// Error of the target weights below which the stencil uses the straight neighbours alone.
constexpr double straight_enough = 1e-4;
/// Weights are bounded by those of a regular grid with this fraction of the mean spacing.
constexpr double min_spacing = 0.05;

/// Target weight of a neighbour for the second difference along its line, 2 / (l (l + l')), with l
/// and l' the distances of this and the opposite neighbour in mean edges.
double wish_between(const Surroundings& around, const Neighbour& at) {
  const double own = length(at.edge) / around.spacing;
  double other = own;
  for (const Neighbour& o : around.ring) {
    const bool across =
        around.free ? o.border && &o != &at : o.sample == at.sample && o.place == (at.place ^ 1);
    if (across) other = length(o.edge) / around.spacing;
  }
  return at.share * 2 / (own * (own + other));
}

/// The direction along the border, or zero at its corners.
Vec3d border_direction(const Surroundings& around) {
  std::vector<const Neighbour*> ends;
  for (const Neighbour& at : around.ring)
    if (at.border) ends.push_back(&at);
  if (ends.size() != 2) return {};
  const Vec3d a = normalized(ends[0]->edge), b = normalized(ends[1]->edge);
  return -dot(a, b) < corner_cosine ? Vec3d{} : normalized(b - a);
}

/// The axes of a tangent plane; none where the neighbours span no plane.
struct Frame {
  Vec3d along, across;

  [[nodiscard]] bool good() const { return squared_length(across) > 0.5; }
};

/// Lays the ring out in the tangent plane.
Frame flatten(Surroundings& around) {
  const Vec3d normal = normalized(around.area_vector);
  Vec3d along = around.free ? border_direction(around)
                            : (around.ring.empty() ? Vec3d{} : around.ring.front().edge);
  along = normalized(along - dot(along, normal) * normal);
  const Vec3d across = cross(normal, along);
  for (Neighbour& at : around.ring) {
    at.x = dot(at.edge, along) / around.spacing;
    at.y = dot(at.edge, across) / around.spacing;
  }
  return {along, across};
}

/// The angle of the warp to a tangent plane's first axis: cosine and sine of its double, averaged
/// over the particle's samples.
struct WarpAngle {
  double along = 0, both = 0;
};

WarpAngle warp_angle(const Frame& frame, const Surroundings& around) {
  WarpAngle angle;
  for (const Vec3d row : around.rows) {
    const Vec2d at{dot(row, frame.along), dot(row, frame.across)};
    const double squared = dot(at, at);
    if (!(squared > 0)) continue;
    angle.along +=
        (at.x * at.x - at.y * at.y) / (squared * static_cast<double>(around.rows.size()));
    angle.both += 2 * at.x * at.y / (squared * static_cast<double>(around.rows.size()));
  }
  return angle;
}

/// The moments of L: twice its tensor. A free border has a moment only along itself.
Moments moments_of(const Operator& wanted, WarpAngle warp, const Surroundings& around) {
  const double sum = wanted.along_rows + wanted.along_columns;
  const double difference = wanted.along_rows - wanted.along_columns;
  if (around.free) return {0, 0, sum + difference * warp.along, 0, 0};
  return {0, 0, sum + difference * warp.along, difference * warp.both,
          sum - difference * warp.along};
}

/// L along the line to a neighbour.
double part_along(const Operator& wanted, WarpAngle warp, const Neighbour& at) {
  const double squared = at.x * at.x + at.y * at.y;
  if (!(squared > 0)) return 0;
  const double along = (at.x * at.x - at.y * at.y) / squared, both = 2 * at.x * at.y / squared;
  return 0.5 *
         (wanted.along_rows + wanted.along_columns +
          (wanted.along_rows - wanted.along_columns) * (warp.along * along + warp.both * both));
}

/// Sets the target weights: the five-point stencil, along free borders the second difference.
void set_wishes(const Operator& wanted_operator, WarpAngle warp, Surroundings& around) {
  for (Neighbour& at : around.ring) {
    const bool wanted = straight(at) && (!around.free || at.border);
    const double relative = squared_length(at.edge) / (around.spacing * around.spacing);
    const double part = around.cut     ? part_along(wanted_operator, warp, at)
                        : at.place < 2 ? wanted_operator.along_rows
                                       : wanted_operator.along_columns;
    at.wish = wanted ? part * wish_between(around, at) : 0;
    at.cost = relative * relative / at.share *
              (wanted ? 1 : (around.free ? across_border_cost : diagonal_cost));
  }
}

Column column_of(const Neighbour& at) {
  return {at.x, at.y, at.x * at.x, at.x * at.y, at.y * at.y};
}

/// Solves a symmetric positive definite system by elimination.
Column solve(std::array<Column, conditions> a, Column b) {
  for (int k = 0; k < conditions; ++k)
    for (int i = k + 1; i < conditions; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j < conditions; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  for (int k = conditions - 1; k >= 0; --k) {
    for (int j = k + 1; j < conditions; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// Fits the weights: the smallest change of the target weights, by penalty, that meets the
/// conditions.
/// @param wanted  count of conditions: 2, the affine ones alone, or all
void fit(const Moments& moments, int wanted, Surroundings& around) {
  Column missing = moments;
  std::array<Column, conditions> gram{};
  for (int i = 0; i < conditions; ++i)
    gram[i][i] = i < 2 ? affine_softness : (i < wanted ? softness : 1.0);
  for (const Neighbour& at : around.ring) {
    const Column column = column_of(at);
    for (int i = 0; i < conditions; ++i) {
      missing[i] -= at.wish * column[i];
      for (int j = 0; j < conditions; ++j)
        if (i < wanted && j < wanted && (wanted == conditions || at.wish > 0))
          gram[i][j] += column[i] * column[j] / at.cost;
    }
  }
  const Column factor = solve(gram, missing);
  for (Neighbour& at : around.ring) {
    at.weight = at.wish;
    if (wanted < conditions && at.wish == 0) continue;
    const Column column = column_of(at);
    for (int i = 0; i < wanted; ++i) at.weight += factor[i] * column[i] / at.cost;
  }
}

/// The largest error of the weights in the first `count` conditions.
template <class Weight>
double largest_miss(const Surroundings& around, Column missing, int count, const Weight& weight) {
  double max = 0;
  for (int i = 0; i < count; ++i) {
    for (const Neighbour& at : around.ring) missing[i] -= weight(at) * column_of(at)[i];
    max = std::max(max, std::abs(missing[i]));
  }
  return max;
}

/// Converts weights per mean edge to weights per metre and bounds them; sets them to zero if they
/// are not finite or miss the affine conditions.
void finish(Surroundings& around, double mean_spacing) {
  constexpr double affine = 1e-5;
  double sum = 0;
  for (const Neighbour& at : around.ring) sum += std::abs(at.weight);
  const bool good = std::isfinite(sum) && around.spacing > 0 &&
                    largest_miss(around, {}, 2, [](const Neighbour& at) { return at.weight; }) <=
                        affine * std::max(1.0, sum);
  const double min = min_spacing * mean_spacing;
  const double max = 8 / (min * min), spacing = around.spacing * around.spacing;
  const double scale = good && sum > 0 ? std::min(1 / spacing, max / sum) : 0;
  for (Neighbour& at : around.ring) at.weight *= scale;
}

void set_weights(const Operator& wanted, double mean_spacing, Surroundings& around) {
  const Frame frame = around.spacing > 0 ? flatten(around) : Frame{};
  if (!frame.good()) {
    for (Neighbour& at : around.ring) at.weight = 0;
    return;
  }
  const WarpAngle warp = warp_angle(frame, around);
  set_wishes(wanted, warp, around);
  const Moments moments = moments_of(wanted, warp, around);
  const double miss =
      largest_miss(around, moments, conditions, [](const Neighbour& a) { return a.wish; });
  fit(moments, miss < straight_enough ? 2 : conditions, around);
  finish(around, mean_spacing);
}

/// Writes the particles' rows of M and what derives from them: rest curvature, diagonal and flags.
class Writer {
 public:
  Writer(int n, double bending, BendingPlanes& planes)
      : n_(n), bending_(bending), planes_(planes), diagonal_(n, n) {
    for (Grid<float>& plane : planes.weight) plane = Grid<float>(n, n);
    planes.rest = Grid<float>(n, n);
    planes.diagonal = Grid<float>(n, n);
  }

  void write(std::span<const int> samples, double area, double reach, const Surroundings& around) {
    const double scale = std::sqrt(bending_ * area);
    Vec3d curvature;
    double rounding = 0;
    std::vector<std::pair<int, double>> column;
    for (const Neighbour& at : around.ring) {
      float& weight = planes_.weight[at.place](at.sample / n_, at.sample % n_);
      weight = static_cast<float>(scale * at.weight);
      if (weight == 0) continue;
      planes_.active = true;
      planes_.diagonals = planes_.diagonals || !straight(at);
      curvature += double{weight} * at.edge;
      rounding += std::abs(double{weight}) * reach;
      column.emplace_back(at.other, weight);
      column.emplace_back(samples.front(), -weight);
    }
    add_to_diagonal(column);
    // Rest curvature within the rounding of positions counts as zero.
    const double rest = dot(curvature, normalized(around.area_vector));
    if (std::abs(rest) <= 4 * std::numeric_limits<float>::epsilon() * rounding) return;
    planes_.curved = true;
    for (const int s : samples) planes_.rest(s / n_, s % n_) = static_cast<float>(rest);
  }

  void finish() {
    for (int r = 0; r < n_; ++r)
      for (int c = 0; c < n_; ++c) planes_.diagonal(r, c) = static_cast<float>(diagonal_(r, c));
  }

 private:
  /// Adds the squares of one row of M to the diagonal. Weights of the same particle are summed
  /// first.
  void add_to_diagonal(std::vector<std::pair<int, double>>& column) {
    std::sort(column.begin(), column.end());
    for (std::size_t i = 0; i < column.size();) {
      const int particle = column[i].first;
      double sum = 0;
      for (; i < column.size() && column[i].first == particle; ++i) sum += column[i].second;
      diagonal_(particle / n_, particle % n_) += sum * sum;
    }
  }

  int n_;
  double bending_;
  BendingPlanes& planes_;
  Grid<double> diagonal_;
};

/// A quarter of each cell around the samples [m^2].
double area_around(const RestShape& shape, std::span<const int> samples) {
  const int n = shape.size();
  double area = 0;
  for (const int s : samples)
    for (const int corner : {0, 1, 2, 3}) {
      const int r = s / n - corner / 2, c = s % n - corner % 2;
      if (r >= 0 && c >= 0 && r + 1 < n && c + 1 < n) area += 0.25 * shape.cell_area(r, c);
    }
  return area;
}

/// The largest coordinate, which sets the rounding error of positions.
double reach_of(const Planes3& position) {
  double reach = 0;
  for (int s = 0; s < position.size() * position.size(); ++s) {
    const Vec3d p = vec_cast<double>(position.at(s));
    reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return reach;
}

void add_to_diagonal(const BorderBending& border, Grid<float>& diagonal) {
  for (int r = 0; r + 1 < static_cast<int>(border.starts.size()); ++r)
    for (int i = border.starts[r]; i < border.starts[r + 1]; ++i)
      diagonal(r, border.edges[i].col) += border.edges[i].stiffness;
}

}  // namespace

BendingPlanes make_bending(const RestShape& shape, const Material& material) {
  BendingPlanes planes;
  if (material.bending == 0) return planes;
  const int n = shape.size();
  const RingReader reader(shape);
  const double reach = reach_of(shape.position);
  const Operator wanted(material.bending);
  Writer writer(n, wanted.stiffness, planes);
  const auto add = [&](std::span<const int> samples) {
    Surroundings around = reader.read(samples);
    set_weights(wanted, shape.mean_spacing, around);
    writer.write(samples, area_around(shape, samples), reach, around);
  };
  std::vector<bool> has_mates(static_cast<std::size_t>(n) * n, false);
  for (int index = 0; index < shape.mates.class_count(); ++index) {
    add(shape.mates.copies(index));
    for (const int s : shape.mates.mates(index)) has_mates[static_cast<std::size_t>(s)] = true;
  }
  for (int s = 0; s < n * n; ++s)
    if (!has_mates[static_cast<std::size_t>(s)]) add(std::span(&s, 1));
  writer.finish();
  if (planes.active && !planes.curved) {
    const double both = std::sqrt(material.bending.warp * material.bending.weft);
    planes.border = make_border_bending(shape, both);
    add_to_diagonal(planes.border, planes.diagonal);
  }
  return planes;
}

}  // namespace weft
