#include "weft/cloth/integrate/contact_springs.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Times the diagonal of the cloth's own operator.
constexpr float relative_stiffness = 4;

}  // namespace

ContactSprings::ContactSprings(int size)
    : normal_(size),
      offset_(size, size),
      stiffness_(size, size),
      depth_(size, size),
      rows_(static_cast<std::size_t>(size)) {}

ConstRow3 ContactSprings::normal_row(int row) const { return row_of(normal_, row); }

void ContactSprings::clear() {
  const int n = depth_.rows();
  for (int r = 0; r < n; ++r) {
    if (rows_[r] == 0) continue;
    for (Grid<float>* plane : {&normal_.x, &normal_.y, &normal_.z, &offset_, &stiffness_, &depth_})
      std::fill(plane->row(r), plane->row(r) + n, 0.0F);
    rows_[r] = 0;
  }
  active_ = 0;
}

void ContactSprings::choose(const Cloth& cloth, std::span<const Contact> contacts,
                            const Planes3& proposed, const Grid<float>& inverse_diagonal) {
  clear();
  const int n = depth_.rows();
  const auto put = [&](int sample, const Vec3f& normal, float offset) {
    const int r = sample / n, c = sample % n;
    normal_.set(r, c, normal);
    offset_(r, c) = offset;
    const float inverse = inverse_diagonal(r, c);
    stiffness_(r, c) = inverse > 0 ? relative_stiffness / inverse : 0;
    rows_[r] = 1;
  };
  for (const Contact& contact : contacts) {
    const int r = contact.samples[0] / n, c = contact.samples[0] % n;
    const float depth = contact.offset - dot(contact.normal, proposed.at(r, c));
    if (!(depth > depth_(r, c))) continue;
    ++active_;
    depth_(r, c) = depth;
    put(contact.samples[0], contact.normal, contact.offset);
  }
  if (active_ == 0) return;
  // A class is one particle: it heeds the contact that any of its samples violates most.
  for (int index = 0; index < cloth.mates.class_count(); ++index) {
    const std::span<const int> samples = cloth.mates.mates(index);
    int deepest = samples.front();
    for (const int s : samples)
      if (depth_(s / n, s % n) > depth_(deepest / n, deepest % n)) deepest = s;
    if (depth_(deepest / n, deepest % n) == 0) continue;
    for (const int s : samples) put(s, normal_.at(deepest), offset_(deepest / n, deepest % n));
  }
}

void ContactSprings::add_force(int row, const float* share, const Planes3& position,
                               Row3 force) const {
  const ConstRow3 n = row_of(normal_, row), x = row_of(position, row);
  const float *offset = offset_.row(row), *stiffness = stiffness_.row(row);
#pragma omp simd
  for (int c = 0; c < depth_.cols(); ++c) {
    const float depth = offset[c] - (n.x[c] * x.x[c] + n.y[c] * x.y[c] + n.z[c] * x.z[c]);
    const float own = share == nullptr ? 1.0F : share[c];
    const float push = depth > 0 ? own * stiffness[c] * depth : 0.0F;
    force.x[c] += push * n.x[c];
    force.y[c] += push * n.y[c];
    force.z[c] += push * n.z[c];
  }
}

}  // namespace weft
