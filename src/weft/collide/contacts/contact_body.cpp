#include "weft/collide/contacts/contact_body.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Of the gap: how much of what is missing to it a step may win back, so that cloth that starts
/// inside something is pushed out and not shot out.
constexpr double most_recovery = 0.25;

}  // namespace

Vec3d way_of(const ContactBody& body, const BodyPoint& at) {
  if (body.start == body.end) return {};
  Vec3d moved;
  for (std::size_t k = 0; k < 3; ++k)
    moved += at.weights[k] * (vec_cast<double>(body.end->at(at.samples[k])) -
                              vec_cast<double>(body.start->at(at.samples[k])));
  return moved;
}

double pair_friction(double a, double b) { return std::sqrt(a * b); }

void put_offset(double surface, double gap_at_start, double gap, Contact& contact) {
  contact.offset = static_cast<float>(surface + std::min(gap, gap_at_start));
  contact.lift = static_cast<float>(std::clamp(gap - gap_at_start, 0.0, most_recovery * gap));
}

std::optional<Contact> contact_before(const ContactBody& body, const BodyPoint& at,
                                      const ClothPoint& point, const KeptGap& kept) {
  const double distance = std::sqrt(at.squared_distance);
  // On the surface itself rounding would choose the direction.
  constexpr double touching = 1e-9;
  const Vec3d normal = distance > touching
                           ? ((point.behind ? -1 : 1) / distance) * (point.start - at.position)
                           : body.query->normal_at(at);
  const double gap = point.behind ? -distance : distance;
  const Vec3d slide = way_of(body, at);
  if (gap + dot(normal, point.way - slide) >= contact_foresight * kept.gap) return std::nullopt;
  Contact contact;
  contact.samples = point.samples;
  contact.weights = point.weights;
  contact.normal = vec_cast<float>(normal);
  put_offset(dot(normal, at.position + slide), gap, kept.gap, contact);
  contact.friction = static_cast<float>(pair_friction(kept.friction, body.friction));
  contact.slide = vec_cast<float>(slide);
  return contact;
}

}  // namespace weft
