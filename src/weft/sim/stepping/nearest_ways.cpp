#include "weft/sim/stepping/nearest_ways.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft {
namespace {

/// The mean way of the samples on a contact's side that have one.
std::optional<Vec3d> way_of_side(const Contact& contact, float side, const NearestWays& ways) {
  Vec3d sum;
  double weights = 0;
  for (std::size_t k = 0; k < contact.samples.size(); ++k) {
    const double weight = side * contact.weights[k];
    const Vec3d* way = weight > 0 ? ways.at(contact.samples[k]) : nullptr;
    if (way == nullptr) continue;
    sum += weight * *way;
    weights += weight;
  }
  return weights > 0 ? std::optional((1 / weights) * sum) : std::nullopt;
}

void put_on_side(const Contact& contact, float side, Vec3d way, NearestWays& ways) {
  for (std::size_t k = 0; k < contact.samples.size(); ++k)
    if (side * contact.weights[k] > 0) ways.put(contact.samples[k], way);
}

}  // namespace

NearestWays::NearestWays(const Cloth& cloth)
    : cloth_(cloth),
      way_(static_cast<std::size_t>(cloth.size) * cloth.size),
      holder_(way_.size(), Holder::none),
      class_of_(way_.size(), -1) {
  for (int k = 0; k < cloth.mates.class_count(); ++k)
    for (const int s : cloth.mates.copies(k)) class_of_[s] = k;
  ring_.reserve(way_.size());
  last_ring_.reserve(way_.size());
}

void NearestWays::clear() noexcept {
  std::fill(holder_.begin(), holder_.end(), Holder::none);
  ring_.clear();
}

void NearestWays::put(int sample, Vec3d way, Holder holder) noexcept {
  const int s = cloth_.mates.representative(sample);
  if (holder_[s] != Holder::none) return;
  holder_[s] = holder;
  way_[s] = way;
  ring_.push_back(s);
}

const Vec3d* NearestWays::at(int sample) const {
  const int s = cloth_.mates.representative(sample);
  return holder_[s] != Holder::none ? &way_[s] : nullptr;
}

NearestWays::Holder NearestWays::holder_of(int sample) const {
  return holder_[cloth_.mates.representative(sample)];
}

void NearestWays::spread_from(int sample, int representative) noexcept {
  const int n = cloth_.size;
  const auto go = [&](int to) {
    if (cloth_.mates.same_chart(sample, to)) put(to, way_[representative], holder_[representative]);
  };
  if (sample >= n) go(sample - n);
  if (sample + n < n * n) go(sample + n);
  if (sample % n > 0) go(sample - 1);
  if (sample % n + 1 < n) go(sample + 1);
}

bool NearestWays::spread() noexcept {
  ring_.swap(last_ring_);
  ring_.clear();
  for (const int s : last_ring_) {
    // All copies of a sample have neighbours, each within its chart.
    if (class_of_[s] < 0) {
      spread_from(s, s);
    } else {
      for (const int copy : cloth_.mates.copies(class_of_[s])) spread_from(copy, s);
    }
  }
  return !ring_.empty();
}

void hand_over(const Contact& contact, NearestWays& first, NearestWays& second) noexcept {
  const std::optional<Vec3d> above = way_of_side(contact, 1, first),
                             below = way_of_side(contact, -1, second);
  if (above && !below) put_on_side(contact, -1, *above, second);
  if (below && !above) put_on_side(contact, 1, *below, first);
}

}  // namespace weft
