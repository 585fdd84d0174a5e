#include "weft/collide/filter/struck_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Firmness of contacts with bodies. A body that hits stiff cloth draws points out of it: their
/// springs pull harder than a contact of the usual stiffness can press within its small depth, so
/// every solve would let them through the body, and the filter would stretch the springs again.
constexpr float body_firmness = 64;
/// Way of one side relative to the other in a step, in thicknesses, beyond which a contact is not
/// kept: its normal is that of features which have parted since, and would hold back what slides.
constexpr double max_way = 0.1;

auto key_of(const StruckContact& one) {
  std::array<char, 4> sides{};
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const float weight = one.shared.contact.weights[k];
    sides[k] = weight > 0 ? 1 : weight < 0 ? -1 : 0;
  }
  return std::tuple(one.body, one.shared.first, one.shared.second, one.shared.contact.samples,
                    sides);
}

/// Of the same samples the contact that presses least comes first: a stable sort would allocate.
bool before(const StruckContact& a, const StruckContact& b) {
  const auto order = [](const StruckContact& one) {
    const Contact& contact = one.shared.contact;
    return std::tuple(contact.offset, contact.normal.x, contact.normal.y, contact.normal.z);
  };
  const auto key_a = key_of(a), key_b = key_of(b);
  return key_a != key_b ? key_a < key_b : order(a) < order(b);
}
bool same(const StruckContact& a, const StruckContact& b) { return key_of(a) == key_of(b); }

}  // namespace

StruckContact StruckContacts::contact_of(const SeparatingPlane& plane,
                                         std::span<const MovingCloth> moving) const {
  StruckContact out;
  Contact& contact = out.shared.contact;
  contact.weights = {};
  out.body = plane.body;
  if (plane.body >= 0) contact.firmness = body_firmness;
  std::size_t count = 0;
  Vec3d apart;
  for (int k = 0; k < plane.count_a + plane.count_b; ++k) {
    if (!(plane.weights[k] > 0)) continue;
    if (count == contact.samples.size()) return {};
    const bool first = k < plane.count_a;
    const std::size_t cloth = world_.cloth_of(plane.points[k]);
    (first ? out.shared.first : out.shared.second) = static_cast<int>(cloth);
    const int sample = plane.points[k] - world_.cloths[cloth].first_point;
    const int n = world_.cloths[cloth].properties.size;
    const double weight = first ? plane.weights[k] : -plane.weights[k];
    contact.samples[count] = sample;
    contact.weights[count++] = static_cast<float>(weight);
    apart += weight * vec_cast<double>(moving[cloth].start.at(sample));
    out.compliance += weight * weight * moving[cloth].inverse_mass(sample / n, sample % n);
  }
  if (plane.body >= 0) out.shared.second = out.shared.first;
  const auto first = static_cast<std::size_t>(out.shared.first),
             second = static_cast<std::size_t>(out.shared.second);
  const CollidingCloth &a = world_.cloths[first].properties, &b = world_.cloths[second].properties;
  const double distance = dot(plane.normal, apart - plane.body_point);
  const bool before_body = plane.body >= 0;
  const double gap = before_body ? a.thickness : world_.gap_between(first, second);
  contact.normal = vec_cast<float>(plane.normal);
  contact.offset =
      static_cast<float>(std::min(gap, distance) +
                         dot(plane.normal, plane.body_point + plane.body_point_displacement));
  contact.surface_displacement = vec_cast<float>(plane.body_point_displacement);
  contact.friction = static_cast<float>(pair_friction(
      a.friction,
      before_body ? world_.bodies[static_cast<std::size_t>(plane.body)].friction : b.friction));
  return out;
}

void StruckContacts::add(std::span<const SeparatingPlane> planes,
                         std::span<const MovingCloth> moving,
                         std::vector<StruckContact>& out) const {
  for (const SeparatingPlane& plane : planes) {
    const StruckContact one = contact_of(plane, moving);
    if (one.compliance > 0) out.push_back(one);
  }
  std::sort(out.begin(), out.end(), before);
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
}

bool StruckContacts::learn(std::span<const SeparatingPlane> planes,
                           std::span<const MovingCloth> moving) {
  const std::size_t known = found_.size();
  add(planes, moving, found_);
  return found_.size() > known;
}

void StruckContacts::keep(std::span<const SeparatingPlane> planes,
                          std::span<const MovingCloth> moving) {
  kept_.clear();
  add(planes, moving, kept_);
  std::erase_if(kept_, [&](const StruckContact& one) { return has_slid(one, moving); });
}

bool StruckContacts::has_slid(const StruckContact& one, std::span<const MovingCloth> moving) const {
  const SharedContact& shared = one.shared;
  Vec3d way;
  for (std::size_t k = 0; k < shared.contact.samples.size(); ++k) {
    const float weight = shared.contact.weights[k];
    const MovingCloth& cloth =
        moving[static_cast<std::size_t>(weight > 0 ? shared.first : shared.second)];
    const int sample = shared.contact.samples[k];
    way += double{weight} * vec_cast<double>(cloth.position.at(sample) - cloth.start.at(sample));
  }
  const double thickness =
      world_.cloths[static_cast<std::size_t>(shared.first)].properties.thickness;
  return length(way) > max_way * thickness;
}

void StruckContacts::commit() {
  found_.swap(kept_);
  kept_.clear();
  // Where a body that moves will be in the next step is not known here.
  std::erase_if(found_, [](const StruckContact& one) {
    return !(one.shared.contact.surface_displacement == Vec3f{});
  });
}

void StruckContacts::clear() {
  found_.clear();
  kept_.clear();
}

}  // namespace weft
