#include "weft/cloth/bending_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "weft/cloth/bending.h"
#include "weft/cloth/border_springs.h"

namespace weft {

namespace {

std::size_t edge_between(int a, int b) {
  return static_cast<std::size_t>(2) * std::min(a, b) + (std::abs(a - b) == 1 ? 1 : 0);
}

}  // namespace

SewnEdges::SewnEdges(const BorderMates& mates)
    : sewn_(static_cast<std::size_t>(2) * mates.size() * mates.size(), false) {
  const auto mark = [&](int position) {
    const int next = mates.along_border(position, 1);
    sewn_[edge_between(mates.sample_at(position), mates.sample_at(next))] = true;
  };
  for (const MateInterval& interval : mates.intervals())
    for (int k = 0; k < interval.count; ++k) {
      mark(mates.along_border(interval.first, k));
      mark(mates.along_border(interval.mate, interval.turned ? k : -k - 1));
    }
}

bool SewnEdges::sewn(int a, int b) const { return sewn_[edge_between(a, b)]; }

RingReader::RingReader(const RestShape& shape)
    : shape_(shape), n_(shape.size()), sewn_(shape.mates) {}

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

/// Whether a place is in the chart of a sample.
bool RingReader::inside(int sample, int row, int col) const {
  return row >= 0 && row < n_ && col >= 0 && col < n_ &&
         shape_.mates.same_chart(sample, row * n_ + col);
}

void RingReader::add_sample(int sample, Surroundings& around) const {
  const int row = sample / n_, col = sample % n_;
  for (int k = 0; k < bending_neighbours; ++k) {
    const auto [down, right] = bending_offsets[k];
    if (!inside(sample, row + down, col + right)) continue;
    const int there = (row + down) * n_ + col + right;
    Neighbour at{sample, k, shape_.mates.representative(there)};
    if (at.other == shape_.mates.representative(sample)) continue;
    at.edge = place(there) - place(sample);
    if (straight(at)) mark_border(sample, at);
    around.free = around.free || at.border;
    around.ring.push_back(at);
  }
  const Vec3d warp = shape_.warp_at(sample);
  const bool cut = squared_length(warp) > 0;
  around.cut = around.cut || cut;
  around.rows.push_back(cut ? warp : row_direction(row, col));
  add_area(row, col, around);
}

Vec3d RingReader::row_direction(int row, int col) const {
  const int here = row * n_ + col;
  const int before = inside(here, row, col - 1) ? col - 1 : col;
  const int after = inside(here, row, col + 1) ? col + 1 : col;
  return normalized(place(row * n_ + after) - place(row * n_ + before));
}

void RingReader::mark_border(int sample, Neighbour& at) const {
  const auto [down, right] = bending_offsets[static_cast<std::size_t>(at.place)];
  const int row = sample / n_ + std::min(down, 0), col = sample % n_ + std::min(right, 0);
  if (!along_border(shape_.mates, down == 0 ? stretch_u : stretch_v, row, col)) return;
  const bool sewn = sewn_.sewn(sample, sample + down * n_ + right);
  at.share = sewn ? 0.5 : 1.0;
  at.border = !sewn;
}

void RingReader::add_area(int row, int col, Surroundings& around) const {
  constexpr std::array<BendingOffset, 5> turn{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}}};
  for (std::size_t k = 0; k + 1 < turn.size(); ++k) {
    const BendingOffset a = turn[k], b = turn[k + 1];
    const int sample = row * n_ + col;
    if (!inside(sample, row + a.down, col + a.right) ||
        !inside(sample, row + b.down, col + b.right))
      continue;
    const Vec3d here = place(sample);
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

/// The gradient of a linear function on a triangle: sum of factor times value.
struct Gradient {
  std::array<int, 3> particle{};  // representatives
  std::array<Vec2d, 3> factor{};
};

using BorderLoop = std::vector<Gradient>;

/// The free borders of a flat rest shape.
class FreeBorders {
 public:
  explicit FreeBorders(const RestShape& shape)
      : shape_(shape), mates_(shape.mates), n_(shape.size()) {}

  /// Gradients on both triangles of each edge of each border loop, in border order.
  /// @return none if a triangle is a sliver, or a particle lies twice on a border
  [[nodiscard]] std::optional<std::vector<BorderLoop>> loops() {
    const SewnEdges sewn(mates_);
    std::map<int, int> edge_from;  // its border position, by the particle that it starts from
    for (int p = 0; p < mates_.border_length(); ++p)
      if (!sewn.sewn(mates_.sample_at(p), mates_.sample_at(next(p))) &&
          !edge_from.try_emplace(particle(p), p).second)
        return std::nullopt;
    std::vector<BorderLoop> loops;
    for (int first = 0; first < mates_.border_length(); ++first) {
      const auto start = edge_from.find(particle(first));
      if (start == edge_from.end() || start->second != first) continue;
      set_frame(first);
      BorderLoop& loop = loops.emplace_back();
      for (auto at = start; at != edge_from.end();) {
        const int p = at->second;
        if (!add_edge(p, loop)) return std::nullopt;
        edge_from.erase(at);
        at = edge_from.find(particle(next(p)));
      }
    }
    return loops;
  }

 private:
  [[nodiscard]] int next(int position) const { return mates_.along_border(position, 1); }
  [[nodiscard]] int particle(int position) const {
    return mates_.representative(mates_.sample_at(position));
  }
  [[nodiscard]] Vec3d place(int sample) const {
    return vec_cast<double>(shape_.position.at(sample));
  }
  [[nodiscard]] Vec2d flat(int sample) const {
    return {dot(place(sample), along_), dot(place(sample), across_)};
  }
  [[nodiscard]] const Chart& chart_at(int position) const {
    const int sample = mates_.sample_at(position);
    return mates_.chart_of().empty() ? mates_.charts()[0]
                                     : mates_.charts()[mates_.chart_of()[sample]];
  }

  /// Lays a frame into the plane of the chart of a border position.
  void set_frame(int position) {
    const Chart& chart = chart_at(position);
    const int corner = chart.row * n_ + chart.col;
    // Turning from rows to columns has the same orientation as ascending border positions.
    const Vec3d u = place(corner + chart.cols - 1) - place(corner);
    const Vec3d v = place(corner + (chart.rows - 1) * n_) - place(corner);
    const Vec3d normal = normalized(cross(u, v));
    along_ = normalized(u);
    across_ = cross(normal, along_);
  }

  /// Adds the gradients at both ends of the edge from a border position to the next.
  [[nodiscard]] bool add_edge(int p, BorderLoop& loop) const {
    for (const int end : {p, next(p)}) {
      const int apex = apex_of(end, end == p ? next(p) : p);
      const auto one = gradient(mates_.sample_at(p), mates_.sample_at(next(p)), apex);
      if (!one) return false;
      loop.push_back(*one);
    }
    return true;
  }

  /// The apex of the triangle on a border edge at its end `position`: the inward neighbour, or at a
  /// corner of the rest shape the other border neighbour.
  [[nodiscard]] int apex_of(int position, int other) const {
    const Chart& chart = chart_at(position);
    const int sample = mates_.sample_at(position);
    const int row = sample / n_ - chart.row, col = sample % n_ - chart.col;
    const int last_row = chart.rows - 1, last_col = chart.cols - 1;
    const int inner_row = std::clamp(row, 1, last_row - 1);
    const int inner_col = std::clamp(col, 1, last_col - 1);
    const bool corner = (row == 0 || row == last_row) && (col == 0 || col == last_col);
    const int inward = (chart.row + inner_row) * n_ + chart.col + inner_col;
    if (!corner) return inward;
    const int before = mates_.along_border(position, -1), after = next(position);
    const int round = mates_.sample_at(other == before ? after : before);
    const Vec3d here = place(sample);
    const Vec3d a = normalized(place(mates_.sample_at(before)) - here);
    const Vec3d b = normalized(place(mates_.sample_at(after)) - here);
    return -dot(a, b) < corner_cosine ? round : inward;
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
    Gradient result;
    for (int i = 0; i < 3; ++i) {
      const Vec2d edge = at[(i + 2) % 3] - at[(i + 1) % 3];
      result.particle[i] = mates_.representative(sample[i]);
      result.factor[i] = {-edge.y / twice_area, edge.x / twice_area};
    }
    return result;
  }

  const RestShape& shape_;
  const BorderMates& mates_;
  int n_;
  Vec3d along_, across_;
};

using BorderMatrix = std::map<std::pair<int, int>, double>;

/// Adds a loop's part of the matrix K of the energy x . K x / 2, by pairs of particles.
void add_to_matrix(const BorderLoop& loop, double strength, BorderMatrix& matrix) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Gradient &a = loop[k], &b = loop[(k + 1) % loop.size()];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double product = -0.5 * strength * cross(a.factor[i], b.factor[j]);
        matrix[{a.particle[i], b.particle[j]}] += product;
        matrix[{b.particle[j], a.particle[i]}] += product;
      }
  }
}

bool is_wide(const Chart& chart) { return chart.rows >= 3 && chart.cols >= 3; }

}  // namespace

BorderBending make_border_bending(const RestShape& shape, double bending) {
  BorderBending border;
  const int n = shape.size();
  const std::vector<Chart>& charts = shape.mates.charts();
  if (!std::all_of(charts.begin(), charts.end(), is_wide)) return border;
  const auto loops = FreeBorders(shape).loops();
  if (!loops || loops->empty()) return border;
  BorderMatrix matrix;
  for (const BorderLoop& loop : *loops) add_to_matrix(loop, (1 - poisson_ratio) * bending, matrix);
  border.starts.assign(static_cast<std::size_t>(n) + 1, 0);
  for (const auto& [pair, value] : matrix) {
    const auto [from, to] = pair;
    if (from == to || value == 0) continue;
    border.edges.push_back({from % n, to / n, to % n, static_cast<float>(-value)});
    ++border.starts[static_cast<std::size_t>(from / n) + 1];
  }
  for (int r = 0; r < n; ++r) border.starts[r + 1] += border.starts[r];
  return border;
}

}  // namespace weft
