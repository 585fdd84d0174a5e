#include "weft/cloth/integrate/contact_springs.h"

#include <algorithm>
#include <array>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Times what the cloth's own operator holds the contact's point by.
constexpr double relative_stiffness = 4;
/// Nearer to the half-space than this part of the rest spacing counts as touching it.
constexpr double touching = 1e-3;

}  // namespace

ContactSprings::ContactSprings(const Cloth& cloth) : cloth_(cloth), loads_(cloth) {}

void ContactSprings::clear() { take({}); }

void ContactSprings::take(std::span<const Contact> contacts, double farthest) {
  farthest_ = farthest;
  loads_.take(contacts);
  force_.assign(contacts.size(), 0.0F);
  offset_.resize(contacts.size());
}

bool ContactSprings::may_press(const Contact& contact, const Planes3& start,
                               const Planes3& now) const {
  const Vec3d n = vec_cast<double>(contact.normal);
  std::array<double, 2> before{}, after{};  // the heights of both sides
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    if (w == 0) continue;
    const std::size_t side = w > 0 ? 0 : 1;
    before[side] += w * dot(n, vec_cast<double>(start.at(contact.samples[i])));
    after[side] += w * dot(n, vec_cast<double>(now.at(contact.samples[i])));
  }
  const double least = std::min(before[0], after[0]) + std::min(before[1], after[1]);
  return contact.offset - least > -touching * cloth_.rest_spacing;
}

bool ContactSprings::heed(const Planes3& start, const Planes3& now,
                          const Grid<float>& inverse_diagonal, Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  if (contacts.empty()) return false;
  const std::span<float> stiffness = loads_.stiffness();
  const int before = loads_.stiff();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    if (stiffness[i] > 0 || !may_press(contacts[i], start, now)) continue;
    if (contacts[i].stiffness > 0) {
      stiffness[i] = contacts[i].stiffness;
      offset_[i] = contacts[i].offset;
      continue;
    }
    stiffness[i] = static_cast<float>(relative_stiffness *
                                      ContactLoads::own_stiffness(contacts[i], inverse_diagonal));
    offset_[i] = attainable_offset(contacts[i], start, farthest_);
  }
  loads_.count(worker);
  return loads_.stiff() > before;
}

double ContactSprings::depth_at(int index, const Place& place) const {
  const Contact& contact = loads_.contacts()[index];
  const Vec3d n = vec_cast<double>(contact.normal);
  double depth = offset_[index];
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    if (w == 0) continue;
    const int s = contact.samples[i];
    depth -= w * dot(n, vec_cast<double>(place.from.at(s)) + vec_cast<double>(place.move.at(s)) +
                            double{place.way} * vec_cast<double>(place.direction.at(s)));
  }
  return depth;
}

void ContactSprings::press(const Place& place, Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const float k = loads_.stiffness()[i];
    if (k == 0) continue;
    force_[i] = static_cast<float>(double{k} * std::max(0.0, depth_at(i, place)));
    loads_.loads()[i] = force_[i] * contacts[i].normal;
  }
  worker.barrier();
}

}  // namespace weft
