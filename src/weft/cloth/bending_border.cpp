#include "weft/cloth/bending_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "weft/cloth/bending.h"

namespace weft {

namespace {

/// Whether each border edge is sewn to another, by the border position it starts from.
std::vector<bool> sewn_edges(const BorderMates& mates) {
  const int count = 4 * (mates.size() - 1);
  std::vector<bool> sewn(static_cast<std::size_t>(count), false);
  for (const MateInterval& interval : mates.intervals())
    for (int k = 0; k < interval.count; ++k) {
      sewn[static_cast<std::size_t>((interval.first + k) % count)] = true;
      sewn[static_cast<std::size_t>((interval.mate - 1 - k + 2 * count) % count)] = true;
    }
  return sewn;
}

}  // namespace

RingReader::RingReader(const RestShape& shape)
    : shape_(shape), n_(shape.size()), sewn_(sewn_edges(shape.mates)) {}

Surroundings RingReader::read(std::span<const int> samples) const {
  Surroundings around;
  for (const int sample : samples) add_sample(sample, around);
  double sum = 0;
  int count = 0;
  for (const Neighbour& at : around.ring)
    if (straight(at)) {
      sum += length(at.edge);
      ++count;
    }
  around.spacing = count > 0 ? sum / count : 0;
  return around;
}

Vec3d RingReader::place(int sample) const { return vec_cast<double>(shape_.position.at(sample)); }

bool RingReader::inside(int row, int col) const {
  return row >= 0 && row < n_ && col >= 0 && col < n_;
}

void RingReader::add_sample(int sample, Surroundings& around) const {
  const int row = sample / n_, col = sample % n_;
  for (int k = 0; k < bending_neighbours; ++k) {
    const auto [down, right] = bending_offsets[k];
    if (!inside(row + down, col + right)) continue;
    const int there = (row + down) * n_ + col + right;
    Neighbour at{sample, k, shape_.mates.representative(there)};
    if (at.other == shape_.mates.representative(sample)) continue;
    at.edge = place(there) - place(sample);
    mark_border(sample, there, at);
    around.free = around.free || at.border;
    around.ring.push_back(at);
  }
  around.rows.push_back(row_direction(row, col));
  add_area(row, col, around);
}

Vec3d RingReader::row_direction(int row, int col) const {
  const int before = inside(row, col - 1) ? col - 1 : col;
  const int after = inside(row, col + 1) ? col + 1 : col;
  return normalized(place(row * n_ + after) - place(row * n_ + before));
}

void RingReader::mark_border(int sample, int there, Neighbour& at) const {
  if (!straight(at)) return;
  const int count = 4 * (n_ - 1);
  const int from = border_position(n_, sample), to = border_position(n_, there);
  if (from < 0 || to < 0) return;
  const bool ahead = (from + 1) % count == to, behind = (to + 1) % count == from;
  if (!ahead && !behind) return;
  const bool sewn = sewn_[static_cast<std::size_t>(ahead ? from : to)];
  at.share = sewn ? 0.5 : 1.0;
  at.border = !sewn;
}

void RingReader::add_area(int row, int col, Surroundings& around) const {
  constexpr std::array<BendingOffset, 5> turn{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}}};
  for (std::size_t k = 0; k + 1 < turn.size(); ++k) {
    const BendingOffset a = turn[k], b = turn[k + 1];
    if (!inside(row + a.down, col + a.right) || !inside(row + b.down, col + b.right)) continue;
    const Vec3d here = place(row * n_ + col);
    const Vec3d to_a = place((row + a.down) * n_ + col + a.right) - here;
    const Vec3d to_b = place((row + b.down) * n_ + col + b.right) - here;
    around.area_vector += cross(to_a, to_b);
  }
}

namespace {

/// Poisson's ratio nu of fabric bent in two directions at once; also the margin by which uneven
/// grids stay stable.
constexpr double poisson_ratio = 0.25;
/// A triangle is a sliver if twice its area over its longest squared edge is below this.
constexpr double min_fatness = 0.05;
/// Cosine of 60 degrees. A border that turns by less at a corner of the image is smooth there in
/// the rest shape.
constexpr double max_turn = 0.5;

/// The gradient of a linear function on a triangle: sum of factor times value.
struct Gradient {
  std::array<int, 3> sample{};
  std::array<Vec2d, 3> factor{};
};

class BorderWalk {
 public:
  explicit BorderWalk(const RestShape& shape) : shape_(shape), n_(shape.size()) {
    // Turning from rows to columns has the same orientation as ascending border positions.
    const Vec3d u = place(n_ - 1) - place(0), v = place(n_ * (n_ - 1)) - place(0);
    normal_ = normalized(cross(u, v));
    along_ = normalized(u);
    across_ = cross(normal_, along_);
  }

  /// Gradients on both triangles of each border edge, in border order; none if one is a sliver.
  [[nodiscard]] std::optional<std::vector<Gradient>> gradients() const {
    std::vector<Gradient> all;
    const int count = 4 * (n_ - 1);
    for (int p = 0; p < count; ++p)
      for (const int end : {p, (p + 1) % count}) {
        const int other = end == p ? (p + 1) % count : p;
        const int apex = apex_of(end, other);
        const auto one = gradient(border_sample(n_, p), border_sample(n_, (p + 1) % count), apex);
        if (!one) return std::nullopt;
        all.push_back(*one);
      }
    return all;
  }

 private:
  [[nodiscard]] Vec3d place(int sample) const {
    return vec_cast<double>(shape_.position.at(sample));
  }
  [[nodiscard]] Vec2d flat(int sample) const {
    return {dot(place(sample), along_), dot(place(sample), across_)};
  }

  /// The apex of the triangle on a border edge at its end `position`: the inward neighbour, or at a
  /// corner of the rest shape the other border neighbour.
  [[nodiscard]] int apex_of(int position, int other) const {
    const int sample = border_sample(n_, position), count = 4 * (n_ - 1);
    const int row = sample / n_, col = sample % n_, last = n_ - 1;
    const int inner_row = std::clamp(row, 1, last - 1), inner_col = std::clamp(col, 1, last - 1);
    const bool corner = (row == 0 || row == last) && (col == 0 || col == last);
    const int inward = inner_row * n_ + inner_col;
    if (!corner) return inward;
    const int before = (position + count - 1) % count, after = (position + 1) % count;
    const int round = border_sample(n_, other == before ? after : before);
    const Vec3d here = place(sample);
    const Vec3d a = normalized(place(border_sample(n_, before)) - here);
    const Vec3d b = normalized(place(border_sample(n_, after)) - here);
    return -dot(a, b) < max_turn ? round : inward;
  }

  [[nodiscard]] std::optional<Gradient> gradient(int a, int b, int c) const {
    const std::array<int, 3> sample{a, b, c};
    const std::array<Vec2d, 3> at{flat(a), flat(b), flat(c)};
    const double twice_area = cross(at[1] - at[0], at[2] - at[0]);
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec2d edge = at[(i + 1) % 3] - at[i];
      longest = std::max(longest, dot(edge, edge));
    }
    if (!(std::abs(twice_area) > min_fatness * longest)) return std::nullopt;
    Gradient result{sample, {}};
    for (int i = 0; i < 3; ++i) {
      const Vec2d edge = at[(i + 2) % 3] - at[(i + 1) % 3];
      result.factor[i] = {-edge.y / twice_area, edge.x / twice_area};
    }
    return result;
  }

  const RestShape& shape_;
  int n_;
  Vec3d normal_, along_, across_;
};

/// The matrix K of the energy x . K x / 2, by pairs of samples.
std::map<std::pair<int, int>, double> border_matrix(const std::vector<Gradient>& gradients,
                                                    double strength) {
  std::map<std::pair<int, int>, double> matrix;
  for (std::size_t k = 0; k < gradients.size(); ++k) {
    const Gradient &a = gradients[k], &b = gradients[(k + 1) % gradients.size()];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double product = -0.5 * strength * cross(a.factor[i], b.factor[j]);
        matrix[{a.sample[i], b.sample[j]}] += product;
        matrix[{b.sample[j], a.sample[i]}] += product;
      }
  }
  return matrix;
}

}  // namespace

BorderBending make_border_bending(const RestShape& shape, double bending) {
  BorderBending border;
  const int n = shape.size();
  if (shape.mates.class_count() > 0 || n < 3) return border;
  const auto gradients = BorderWalk(shape).gradients();
  if (!gradients) return border;
  border.starts.assign(static_cast<std::size_t>(n) + 1, 0);
  for (const auto& [pair, value] : border_matrix(*gradients, (1 - poisson_ratio) * bending)) {
    const auto [from, to] = pair;
    if (from == to || value == 0) continue;
    border.edges.push_back({from % n, to / n, to % n, static_cast<float>(-value)});
    ++border.starts[static_cast<std::size_t>(from / n) + 1];
  }
  for (int r = 0; r < n; ++r) border.starts[r + 1] += border.starts[r];
  return border;
}

}  // namespace weft
