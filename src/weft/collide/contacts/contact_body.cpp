#include "weft/collide/contacts/contact_body.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/contacts/closest.h"

namespace weft {
namespace {

/// Largest lift in a step as a part of the gap, so that cloth that starts inside a body is pushed
/// out slowly.
constexpr double max_recovery = 0.25;

}  // namespace

Vec3d displacement_of(const ContactBody& body, const BodyPoint& at) {
  if (body.start == body.end) return {};
  Vec3d moved;
  for (std::size_t k = 0; k < 3; ++k)
    moved += at.weights[k] * (vec_cast<double>(body.end->at(at.samples[k])) -
                              vec_cast<double>(body.start->at(at.samples[k])));
  return moved;
}

ClothPoint point_of_triangle(const MovingCloth& cloth, const std::array<int, 3>& samples,
                             const std::array<double, 3>& weights) {
  ClothPoint point;
  point.start = blend(corners_at(cloth.start, samples), weights);
  point.displacement = blend(corners_at(cloth.position, samples), weights) - point.start;
  point.weights = {};
  for (std::size_t k = 0; k < 3; ++k) {
    point.samples[k] = samples[k];
    point.weights[k] = static_cast<float>(weights[k]);
  }
  return point;
}

double pair_friction(double a, double b) { return std::sqrt(a * b); }

void put_offset(double surface, double gap_at_start, double gap, Contact& contact) {
  contact.offset = static_cast<float>(surface + std::min(gap, gap_at_start));
  contact.lift = static_cast<float>(std::clamp(gap - gap_at_start, 0.0, max_recovery * gap));
}

void bring_back(double farthest, Contact& contact) {
  const float exit = std::min(contact.lift, static_cast<float>(farthest));
  contact.offset += exit;
  contact.surface_displacement += exit * contact.normal;
  contact.lift = contact.friction = 0;
}

namespace {

/// Nearer than this to a surface, rounding chooses the direction from it.
double touching_distance(Vec3d place) {
  constexpr double roundings = 256;
  const double farthest = std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
  return 1e-9 + roundings * 0x1p-24 * farthest;
}

}  // namespace

PlaceBefore place_before(const ContactBody& body, const BodyPoint& at, const ClothPoint& point) {
  const double distance = std::sqrt(at.squared_distance), side = point.astray ? -1 : 1;
  const Vec3d way = point.start - at.position;
  if (distance > touching_distance(point.start)) return {(side / distance) * way, side * distance};
  Vec3d normal = (point.kept_in ? -1.0 : 1.0) * body.query->normal_at(at);
  // An open surface is touched from the side on which the point is.
  if (!body.query->closed() && dot(normal, way) < 0) normal = -normal;
  return {normal, side * distance};
}

/// A surface that slides or turns in place does not approach, though its points move.
Vec3d surface_displacement(const ContactBody& body, const BodyPoint& at, const BodyPoint* at_end,
                           const PlaceBefore& before, Vec3d place) {
  const Vec3d moved = displacement_of(body, at);
  if (at_end == nullptr) return moved;
  const double after = std::sqrt(at_end->squared_distance);
  const bool passed = dot(before.normal, place - at_end->position) < 0;
  const double approach = dot(before.normal, place - at.position) - (passed ? -after : after);
  return moved + std::max(0.0, approach - dot(before.normal, moved)) * before.normal;
}

double reach_at_end(double gap, double approach) { return std::abs(gap) + approach; }

bool comes_near(const PlaceBefore& before, Vec3d displacement, double along, const KeptGap& kept) {
  return before.gap + dot(before.normal, displacement) - along < contact_margin * kept.gap;
}

Contact contact_at(const ContactBody& body, const BodyPoint& at, const ClothPoint& point,
                   const PlaceBefore& before, Vec3d surface_displacement, const KeptGap& kept) {
  Contact contact;
  contact.samples = point.samples;
  contact.weights = point.weights;
  contact.normal = vec_cast<float>(before.normal);
  put_offset(dot(before.normal, at.position + surface_displacement), before.gap, kept.gap, contact);
  contact.friction = static_cast<float>(pair_friction(kept.friction, body.friction));
  contact.surface_displacement = vec_cast<float>(surface_displacement);
  if (point.astray) bring_back(point.farthest, contact);
  return contact;
}

std::optional<Contact> contact_before(const ContactBody& body, const BodyPoint& at,
                                      const ClothPoint& point, const KeptGap& kept) {
  const PlaceBefore before = place_before(body, at, point);
  std::optional<BodyPoint> at_end;
  if (body.at_end != nullptr)
    at_end = body.at_end->closest(
        point.start, reach_at_end(before.gap, body.max_approach) + contact_margin * kept.gap,
        at.triangle);
  if (at_end && body.is_buried(at_end->triangle)) at_end.reset();
  const Vec3d moved =
      surface_displacement(body, at, at_end ? &*at_end : nullptr, before, point.start);
  if (!comes_near(before, point.displacement, dot(before.normal, moved), kept)) return std::nullopt;
  return contact_at(body, at, point, before, moved, kept);
}

}  // namespace weft
