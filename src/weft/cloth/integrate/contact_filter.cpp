#include "weft/cloth/integrate/contact_filter.h"

#include "weft/cloth/neighbours.h"

namespace weft {

ContactFilter::ContactFilter(int size) : normal_(size), offset_(size, size), depth_(size, size) {}

void ContactFilter::clear() {
  if (active_ == 0) return;
  for (Grid<float>* plane : {&normal_.x, &normal_.y, &normal_.z, &offset_, &depth_}) plane->fill(0);
  active_ = 0;
}

void ContactFilter::choose(const Cloth& cloth, std::span<const Contact> contacts,
                           const Planes3& proposed) {
  clear();
  const int n = depth_.rows();
  for (const Contact& contact : contacts) {
    const int r = contact.sample / n, c = contact.sample % n;
    const float depth = contact.offset - dot(contact.normal, proposed.at(r, c));
    if (!(depth > depth_(r, c))) continue;
    ++active_;
    depth_(r, c) = depth;
    normal_.set(r, c, contact.normal);
    offset_(r, c) = contact.offset;
  }
  if (active_ == 0) return;
  // A class is one particle: it heeds the contact that any of its samples violates most.
  for (int index = 0; index < cloth.mates.class_count(); ++index) {
    const std::span<const int> samples = cloth.mates.mates(index);
    int deepest = samples.front();
    for (const int s : samples)
      if (depth_(s / n, s % n) > depth_(deepest / n, deepest % n)) deepest = s;
    for (const int s : samples) {
      normal_.set(s, normal_.at(deepest));
      offset_(s / n, s % n) = offset_(deepest / n, deepest % n);
    }
  }
}

void ContactFilter::push_out(const Cloth& cloth, const Planes3& fall, Planes3& move,
                             Worker& worker) const {
  const Range mine = worker.share(cloth.size);
  for (int r = mine.first; active_ > 0 && r < mine.last; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      const Vec3f normal = normal_.at(r, c);
      if (squared_length(normal) == 0 || cloth.inverse_mass(r, c) == 0) continue;
      const float depth = offset_(r, c) - dot(normal, fall.at(r, c) + move.at(r, c));
      move.set(r, c, move.at(r, c) + depth * normal);
    }
  worker.barrier();
}

void ContactFilter::filter_row(Planes3& values, int row) const {
  if (active_ == 0) return;
  const ConstRow3 normal = row_of(normal_, row);
  const Row3 v = row_of(values, row);
  for (int c = 0; c < values.size(); ++c) {
    const float along = normal.x[c] * v.x[c] + normal.y[c] * v.y[c] + normal.z[c] * v.z[c];
    v.x[c] -= along * normal.x[c];
    v.y[c] -= along * normal.y[c];
    v.z[c] -= along * normal.z[c];
  }
}

}  // namespace weft
