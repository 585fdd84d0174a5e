#include "weft/cloth/bending_ring.h"

#include <array>

#include "weft/cloth/bending.h"

namespace weft {
namespace {

/// Whether each border edge, by the position it starts from, is joined to another.
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

}  // namespace weft
