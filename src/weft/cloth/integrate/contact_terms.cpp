#include "weft/cloth/integrate/contact_terms.h"

#include <cmath>

namespace weft {
namespace {

constexpr float contact_stiffness = 10;

}  // namespace

ContactTerms::ContactTerms(int size) : axis_(size), target_(size, size), depth_(size, size) {}

void ContactTerms::clear() {
  if (active_ == 0) return;
  for (Grid<float>* plane : {&axis_.x, &axis_.y, &axis_.z, &target_, &depth_}) plane->fill(0);
  active_ = 0;
}

void ContactTerms::choose(std::span<const Contact> contacts, const Planes3& start,
                          const Planes3& proposed, double time_step) {
  clear();
  const int n = target_.rows();
  for (const Contact& contact : contacts) {
    const int r = contact.samples[0] / n, c = contact.samples[0] % n;
    const float depth = contact.offset - dot(contact.normal, proposed.at(r, c));
    if (!(depth > depth_(r, c))) continue;
    ++active_;
    depth_(r, c) = depth;
    axis_.set(r, c, contact.normal);
    const float way = contact.offset - dot(contact.normal, start.at(r, c));
    target_(r, c) = way / static_cast<float>(time_step);
  }
}

void ContactTerms::scale(const Cloth& cloth, const Blocks& diagonal) {
  const int n = cloth.size;
  const auto move = [&](int from, int to) {
    axis_.set(to, axis_.at(from));
    target_(to / n, to % n) = target_(from / n, from % n);
    depth_(to / n, to % n) = depth_(from / n, from % n);
  };
  for (int index = 0; index < cloth.mates.class_count(); ++index) {
    const std::span<const int> samples = cloth.mates.mates(index);
    int deepest = samples.front();
    for (const int s : samples)
      if (depth_(s / n, s % n) > depth_(deepest / n, deepest % n)) deepest = s;
    if (deepest != samples.front()) move(deepest, samples.front());
    for (const int s : samples.subspan(1)) {
      axis_.set(s, {});
      target_(s / n, s % n) = depth_(s / n, s % n) = 0;
    }
  }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      if (depth_(r, c) == 0) continue;
      const float trace = diagonal[0](r, c) + diagonal[3](r, c) + diagonal[5](r, c);
      const float root = std::sqrt(contact_stiffness * trace / 3);
      axis_.set(r, c, root * axis_.at(r, c));
      target_(r, c) *= root;
    }
}

}  // namespace weft
