#include "weft/cloth/newton/contact_product.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Part of the bound on contacts between samples that the smoother takes. The whole bounds the
/// matrix; half of it lets eigenvalues go up to 2, as those of springs do. A contact of cloth with
/// an obstacle mostly is its own bound.
constexpr float smoothed_part = 0.5F;

}  // namespace

ContactProduct::Side::Side(const Cloth& cloth)
    : size(cloth.size),
      class_at(static_cast<std::size_t>(cloth.size) * cloth.size, -1),
      uses(cloth.size * cloth.size),
      row_starts(static_cast<std::size_t>(cloth.size) + 1) {
  for (int index = 0; index < cloth.mates.class_count(); ++index)
    for (const int sample : cloth.mates.mates(index))
      class_at[static_cast<std::size_t>(sample)] = index;
}

ContactProduct::ContactProduct(std::span<const Cloth* const> cloths)
    : cloths_(cloths.begin(), cloths.end()) {
  for (const Cloth* cloth : cloths) sides_.emplace_back(*cloth);
}

void ContactProduct::clear() {
  quads_.clear();
  groups_.clear();
  slots_.clear();
  count_ = 0;
  for (Side& side : sides_) {
    side.uses.clear();
    std::fill(side.row_starts.begin(), side.row_starts.end(), 0);
  }
}

void ContactProduct::add_use(int cloth, int sample, int slot, float weight) {
  Side& side = sides_[cloth];
  const int index = side.class_at[static_cast<std::size_t>(sample)];
  if (index < 0) return side.uses.add(sample, {slot, weight});
  const std::span<const int> copies = cloths_[cloth]->mates.copies(index);
  for (const int copy : copies)
    side.uses.add(copy, {slot, weight / static_cast<float>(copies.size())});
}

void ContactProduct::add(const Spring& spring) {
  if (groups_.empty() || groups_.back().cloths != spring.cloths) {
    const int next = static_cast<int>(quads_.size());
    groups_.push_back({spring.cloths, next, next});
    count_ = 4 * next;
  }
  if (count_ == 4 * groups_.back().last) {
    quads_.emplace_back();
    ++groups_.back().last;
  }
  const int slot = count_++, lane = slot % 4;
  slots_.push_back(slot);
  Quad& quad = quads_.back();
  for (std::size_t k = 0; k < 4; ++k) {
    const float weight = spring.weights[k];
    if (weight == 0) continue;
    const int side = weight < 0 ? 1 : 0, cloth = spring.cloths[side], n = cloths_[cloth]->size;
    quad.places[k][lane] =
        spring.samples[k] / n * PaddedPlane::stride_for(n) + spring.samples[k] % n;
    quad.second[k][lane] = static_cast<unsigned char>(side);
    quad.weights[k][lane] = weight;
    add_use(cloth, spring.samples[k], slot, weight);
  }
  quad.x[lane] = spring.normal.x;
  quad.y[lane] = spring.normal.y;
  quad.z[lane] = spring.normal.z;
  quad.stiffness[lane] = spring.stiffness - spring.grip;
  quad.grip[lane] = spring.grip;
}

void ContactProduct::finish() {
  loads_.resize(4 * quads_.size());
  for (Side& side : sides_) {
    side.uses.finish();
    const std::span<const int> used = side.uses.samples();
    int at = 0;
    for (int r = 0; r <= side.size; ++r) {
      while (at < static_cast<int>(used.size()) && used[at] < r * side.size) ++at;
      side.row_starts[r] = at;
    }
  }
}

void ContactProduct::multiply(const Group& group, Range quads, Fields field) {
  const PaddedVectors &first = *field[group.cloths[0]], &second = *field[group.cloths[1]];
  const std::array<const float*, 2> x{first.x.row(0), second.x.row(0)},
      y{first.y.row(0), second.y.row(0)}, z{first.z.row(0), second.z.row(0)};
  for (int q = std::max(quads.first, group.first); q < std::min(quads.last, group.last); ++q) {
    const Quad& quad = quads_[q];
    Four moved[3]{};
    for (int k = 0; k < 4; ++k) {
      const auto gather = [&](const std::array<const float*, 2>& planes) {
        const auto& place = quad.places[k];
        const auto& side = quad.second[k];
        return Four{planes[side[0]][place[0]], planes[side[1]][place[1]], planes[side[2]][place[2]],
                    planes[side[3]][place[3]]};
      };
      moved[0] += quad.weights[k] * gather(x);
      moved[1] += quad.weights[k] * gather(y);
      moved[2] += quad.weights[k] * gather(z);
    }
    const Four along = quad.stiffness * (quad.x * moved[0] + quad.y * moved[1] + quad.z * moved[2]);
    Four loads[4] = {along * quad.x + quad.grip * moved[0], along * quad.y + quad.grip * moved[1],
                     along * quad.z + quad.grip * moved[2], Four{}};
    transpose(loads);
    std::copy_n(loads, 4, loads_.data() + std::ptrdiff_t{4} * q);
  }
}

void ContactProduct::multiply(Fields field, Worker& worker) {
  const Range mine = worker.share(static_cast<int>(quads_.size()));
  for (const Group& group : groups_) multiply(group, mine, field);
  worker.barrier();
}

void ContactProduct::add_row(std::size_t cloth, int row, float factor, Row3 out) const {
  const Side& side = sides_[cloth];
  for (int at = side.row_starts[row]; at < side.row_starts[row + 1]; ++at) {
    Four sum{};
    for (const ContactUses::Use& use : side.uses.of(at)) sum += use.weight * loads_[use.contact];
    const int col = side.uses.samples()[at] - row * side.size;
    out.x[col] += factor * sum[0];
    out.y[col] += factor * sum[1];
    out.z[col] += factor * sum[2];
  }
}

ContactProduct::Blocks ContactProduct::blocks_of(const Side& side, int at) const {
  Blocks sum;
  for (const ContactUses::Use& use : side.uses.of(at)) {
    const Quad& quad = quads_[use.contact / 4];
    const int lane = use.contact % 4;
    float weights = 0, total = 0;
    for (const Four& weight : quad.weights) {
      weights += std::abs(weight[lane]);
      total += weight[lane];
    }
    const float part = weights * std::abs(use.weight);
    const float grip = part * quad.grip[lane], k = part * quad.stiffness[lane];
    const Vec3f n{quad.x[lane], quad.y[lane], quad.z[lane]};
    const std::array<float, 6> block{k * n.x * n.x + grip, k * n.x * n.y, k * n.x * n.z,
                                     k * n.y * n.y + grip, k * n.y * n.z, k * n.z * n.z + grip};
    const float smoothed = total > 0.5F ? 1.0F : smoothed_part;
    for (std::size_t i = 0; i < block.size(); ++i) {
      sum.whole[i] += block[i];
      sum.lines[i] += smoothed * block[i];
    }
  }
  return sum;
}

}  // namespace weft
