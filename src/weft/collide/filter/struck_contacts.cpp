#include "weft/collide/filter/struck_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Firmness of these contacts. A body that hits stiff cloth draws points out of it, and folds are
/// squeezed where there is no room: their springs pull harder than a contact of the usual stiffness
/// can press within its small depth, so every solve would let them through, and the filter would
/// stretch the springs again. Layers have to give way while seams are being sewn.
constexpr float firmness = 64;
/// Way of one side relative to the other, in thicknesses, beyond which a contact is not kept: its
/// normal is that of features which have parted since, and would hold back what slides.
/// Also between cloths that keep a smaller gap: with that, or with all of them kept, a garment's
/// seams pulled layers into each other's creases, where they stayed open by centimetres.
constexpr double max_way = 0.1;
/// Cosine of the angle between a plane's normal and that of the body beyond which a contact takes
/// the latter. Where cloth is pressed onto facets, planes between their edges and folds lie across
/// the surface: kept while the sides touch, they would hold what is to slide, as a waist up a hip,
/// without any friction.
constexpr double along_normal = 0.9;
/// Distance beyond what a contact holds apart, in thicknesses, up to which its sides still touch.
constexpr double still_touching = 0.05;

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

/// A sample of a side; the weights of side b are negative.
struct SidePoint {
  std::size_t cloth = 0;
  int sample = 0;
  double weight = 0;
};

/// The points of a plane that its closest points depend on.
struct PlanePoints {
  std::array<SidePoint, 6> points;
  std::size_t count = 0;

  /// Sorts the points, those of the side with the first of them in front: searches meet a pair from
  /// either side, in any order, and it is one contact.
  /// @return whether the sides were exchanged
  bool put_in_order() {
    const auto ours = std::span(points).first(count);
    const auto number = [](const SidePoint& one) { return std::pair(one.cloth, one.sample); };
    const SidePoint least = *std::ranges::min_element(ours, {}, number);
    const bool exchange = least.weight < 0;
    for (SidePoint& one : ours) one.weight = exchange ? -one.weight : one.weight;
    std::ranges::sort(ours, {}, [&](const SidePoint& one) {
      return std::tuple(one.weight < 0, one.cloth, one.sample);
    });
    return exchange;
  }
};

/// Sum over a contact's samples of their weights times a value of them.
template <class Value>
Vec3d sum_of(const SharedContact& shared, std::span<const MovingCloth> moving,
             const Value& value_of) {
  Vec3d sum;
  for (std::size_t k = 0; k < shared.contact.samples.size(); ++k) {
    const float weight = shared.contact.weights[k];
    if (weight == 0) continue;
    const MovingCloth& cloth = moving[static_cast<std::size_t>(shared.cloth_of(k))];
    sum += double{weight} * vec_cast<double>(value_of(cloth, shared.contact.samples[k]));
  }
  return sum;
}

}  // namespace

StruckContact StruckContacts::contact_of(const SeparatingPlane& plane,
                                         std::span<const MovingCloth> moving,
                                         double time_step) const {
  PlanePoints of;
  for (int k = 0; k < plane.count_a + plane.count_b; ++k) {
    if (!(plane.weights[k] > 0)) continue;
    const std::size_t cloth = world_.cloth_of(plane.points[k]);
    const double weight = k < plane.count_a ? plane.weights[k] : -plane.weights[k];
    of.points[of.count++] = {cloth, plane.points[k] - world_.cloths[cloth].first_point, weight};
  }
  StruckContact out;
  Contact& contact = out.shared.contact;
  if (of.count == 0 || of.count > contact.samples.size()) return {};
  Vec3d normal = of.put_in_order() ? -1.0 * plane.normal : plane.normal;
  contact.weights = {};
  Vec3d apart;
  PointCompliance compliance;
  for (std::size_t k = 0; k < of.count; ++k) {
    const auto& [cloth, sample, weight] = of.points[k];
    (weight > 0 ? out.shared.first : out.shared.second) = static_cast<int>(cloth);
    contact.samples[k] = sample;
    contact.weights[k] = static_cast<float>(weight);
    apart += weight * vec_cast<double>(moving[cloth].start.at(sample));
    const int n = world_.cloths[cloth].properties.size;
    compliance.add(weight, moving[cloth].inverse_mass(sample / n, sample % n));
  }
  out.compliance = compliance.value();
  out.body = plane.body;
  if (out.body >= 0) normal = away_from_body(out, normal, plane.body_point);
  hold_apart(plane, normal, dot(normal, apart - plane.body_point), out);
  out.body_velocity = vec_cast<float>((1 / time_step) * plane.body_point_displacement);
  return out;
}

Vec3d StruckContacts::away_from_body(const StruckContact& one, Vec3d normal, Vec3d at) const {
  const auto body = static_cast<std::size_t>(one.body);
  const BodyQuery& query = *world_.bodies[body].query;
  const CollidingCloth& cloth =
      world_.cloths[static_cast<std::size_t>(one.shared.first)].properties;
  const auto point = query.closest(at, cloth.thickness);
  if (is_sewn(one) || !point) return normal;
  const Vec3d outwards = query.normal_at(*point);
  const double along = dot(outwards, normal);
  if (std::abs(along) >= along_normal) return normal;
  const bool is_in =
      query.closed() ? !cloth.kept_in.empty() && cloth.kept_in[body] != 0 : along < 0;
  return is_in ? -1.0 * outwards : outwards;
}

void StruckContacts::hold_apart(const SeparatingPlane& plane, Vec3d normal, double distance,
                                StruckContact& out) const {
  Contact& contact = out.shared.contact;
  const bool before_body = plane.body >= 0;
  if (before_body) out.shared.second = out.shared.first;
  const auto first = static_cast<std::size_t>(out.shared.first),
             second = static_cast<std::size_t>(out.shared.second);
  const CollidingCloth &a = world_.cloths[first].properties, &b = world_.cloths[second].properties;
  const double gap = before_body ? a.thickness : world_.gap_between(first, second);
  contact.normal = vec_cast<float>(normal);
  contact.offset = static_cast<float>(std::min(gap, distance) + dot(normal, plane.body_point));
  if (before_body || !is_sewn(out)) contact.firmness = firmness;
  contact.friction = static_cast<float>(pair_friction(
      a.friction,
      before_body ? world_.bodies[static_cast<std::size_t>(plane.body)].friction : b.friction));
}

void StruckContacts::add(std::span<const SeparatingPlane> planes,
                         std::span<const MovingCloth> moving, double time_step,
                         std::vector<StruckContact>& out) const {
  for (const SeparatingPlane& plane : planes) {
    const StruckContact one = contact_of(plane, moving, time_step);
    if (one.compliance > 0) out.push_back(one);
  }
  std::sort(out.begin(), out.end(), before);
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
}

bool StruckContacts::learn(std::span<const SeparatingPlane> planes,
                           std::span<const MovingCloth> moving, double time_step) {
  const std::size_t known = found_.size();
  add(planes, moving, time_step, found_);
  return found_.size() > known;
}

void StruckContacts::keep(std::span<const SeparatingPlane> planes,
                          std::span<const MovingCloth> moving, double time_step) {
  kept_.clear();
  add(planes, moving, time_step, kept_);
  std::erase_if(kept_, [&](StruckContact& one) { return slides(one, moving, time_step); });
  for (StruckContact& one : kept_) {
    Contact& contact = one.shared.contact;
    contact.offset += static_cast<float>(time_step) * dot(contact.normal, one.body_velocity);
  }
  keep_touching(moving, time_step);
}

void StruckContacts::keep_touching(std::span<const MovingCloth> moving, double time_step) {
  const auto struck = static_cast<std::ptrdiff_t>(kept_.size());
  const auto key_before = [](const StruckContact& a, const StruckContact& b) {
    return key_of(a) < key_of(b);
  };
  for (StruckContact one : found_)
    if (!std::binary_search(kept_.begin(), kept_.begin() + struck, one, key_before) &&
        goes_on(one, moving, time_step))
      kept_.push_back(one);
  std::sort(kept_.begin(), kept_.end(), before);
}

/// Where a body that moves will be is not known once its plane is gone.
bool StruckContacts::goes_on(StruckContact& one, std::span<const MovingCloth> moving,
                             double time_step) const {
  if (is_sewn(one)) return false;
  if (one.body >= 0 && world_.bodies[static_cast<std::size_t>(one.body)].moves()) return false;
  if (slides(one, moving, time_step)) return false;
  const Vec3d at = sum_of(one.shared, moving, [](const MovingCloth& cloth, int sample) {
    return cloth.position.at(sample);
  });
  const Contact& contact = one.shared.contact;
  return dot(vec_cast<double>(contact.normal), at) <
         double{contact.offset} + still_touching * thickness_of(one);
}

bool StruckContacts::slides(StruckContact& one, std::span<const MovingCloth> moving,
                            double time_step) const {
  const Vec3d way = sum_of(one.shared, moving, [](const MovingCloth& cloth, int sample) {
    return cloth.position.at(sample) - cloth.start.at(sample);
  });
  one.way += vec_cast<float>(way - time_step * vec_cast<double>(one.body_velocity));
  return length(vec_cast<double>(one.way)) > max_way * thickness_of(one);
}

bool StruckContacts::is_sewn(const StruckContact& one) const {
  const auto of = [&](int cloth) {
    return world_.cloths[static_cast<std::size_t>(cloth)].grid.is_sewn();
  };
  return of(one.shared.first) || of(one.shared.second);
}

double StruckContacts::thickness_of(const StruckContact& one) const {
  return world_.cloths[static_cast<std::size_t>(one.shared.first)].properties.thickness;
}

void StruckContacts::commit() {
  found_.swap(kept_);
  kept_.clear();
}

void StruckContacts::end_frame() {
  std::erase_if(found_, [&](const StruckContact& one) { return is_sewn(one); });
}

void StruckContacts::restore(std::span<const StruckContact> kept) {
  clear();
  std::copy_if(kept.begin(), kept.end(), std::back_inserter(found_),
               [&](const StruckContact& one) { return is_valid(one); });
}

/// Samples that a seam has joined since are no two sides.
bool StruckContacts::is_valid(const StruckContact& one) const {
  const int cloths = static_cast<int>(world_.cloths.size()),
            bodies = static_cast<int>(world_.bodies.size());
  const auto& [contact, first, second] = one.shared;
  if (std::min(first, second) < 0 || std::max(first, second) >= cloths || one.body >= bodies)
    return false;
  std::array<int, 4> points{-1, -2, -3, -4};
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (contact.weights[k] == 0) continue;
    const WorldCloth& cloth = world_.cloths[static_cast<std::size_t>(one.shared.cloth_of(k))];
    const int n = cloth.properties.size;
    if (contact.samples[k] < 0 || contact.samples[k] >= n * n) return false;
    points[k] = cloth.first_point + cloth.grid.joint(contact.samples[k]);
  }
  std::sort(points.begin(), points.end());
  return std::adjacent_find(points.begin(), points.end()) == points.end();
}

void StruckContacts::clear() {
  found_.clear();
  kept_.clear();
}

}  // namespace weft
