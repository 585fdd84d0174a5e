#include "weft/collide/contacts/contact_body.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Largest lift in a step as a part of the gap, so that cloth that starts inside a body is pushed
/// out slowly.
constexpr double max_recovery = 0.25;

/// Approach of a body's surface to a place along a normal. A surface that slides or turns in place
/// does not approach, though its points move. Nothing where the surface is out of reach at the end.
/// [m]
std::optional<double> approach_of(const ContactBody& body, const BodyPoint& at, Vec3d place,
                                  Vec3d normal, double reach) {
  const auto then = body.at_end->closest(place, reach);
  if (!then) return std::nullopt;
  const double before = dot(normal, place - at.position);
  const double after = std::sqrt(then->squared_distance);
  return before - (dot(normal, place - then->position) < 0 ? -after : after);
}

}  // namespace

Vec3d displacement_of(const ContactBody& body, const BodyPoint& at) {
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
  contact.lift = static_cast<float>(std::clamp(gap - gap_at_start, 0.0, max_recovery * gap));
}

std::optional<Contact> contact_before(const ContactBody& body, const BodyPoint& at,
                                      const ClothPoint& point, const KeptGap& kept) {
  const double distance = std::sqrt(at.squared_distance);
  // On the surface itself rounding would choose the direction.
  constexpr double touching = 1e-9;
  const Vec3d normal = distance > touching
                           ? ((point.astray ? -1 : 1) / distance) * (point.start - at.position)
                           : (point.kept_in ? -1.0 : 1.0) * body.query->normal_at(at);
  const double gap = point.astray ? -distance : distance;
  Vec3d surface_displacement = displacement_of(body, at);
  if (body.at_end != nullptr) {
    const auto approach = approach_of(
        body, at, point.start, normal,
        std::abs(gap) + body.max_approach + contact_margin * kept.gap + length(point.displacement));
    if (approach)
      surface_displacement += std::max(0.0, *approach - dot(normal, surface_displacement)) * normal;
  }
  if (gap + dot(normal, point.displacement - surface_displacement) >= contact_margin * kept.gap)
    return std::nullopt;
  Contact contact;
  contact.samples = point.samples;
  contact.weights = point.weights;
  contact.normal = vec_cast<float>(normal);
  put_offset(dot(normal, at.position + surface_displacement), gap, kept.gap, contact);
  contact.friction = static_cast<float>(pair_friction(kept.friction, body.friction));
  if (point.astray) {
    // No force presses there: the point is on its way back, by a part of the gap in every step, or
    // by less in a short one.
    contact.offset += std::min(contact.lift, static_cast<float>(point.farthest));
    contact.lift = contact.friction = 0;
  }
  contact.surface_displacement = vec_cast<float>(surface_displacement);
  return contact;
}

}  // namespace weft
