#include "weft/collide/contacts/contact_finder.h"

#include <algorithm>
#include <cmath>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Smallest rest spacing, in gaps, at which cells that share a corner get contacts: finer cloth
/// bends round its thickness over several cells.
constexpr double min_crease_in_gaps = 3;
/// Distance in gaps up to which ends of other proposals count as the same: contacts are found from
/// half a gap before they press.
constexpr float same_place_in_gaps = 0.25F;

}  // namespace

ContactFinder::ContactFinder(CollisionWorld& world, const Obstacles& obstacles) : world_(world) {
  for (const WorldCloth& cloth : world.cloths)
    found_.emplace_back(std::make_unique<CornerContacts>(cloth.grid, cloth.properties),
                        cloth.grid.cells());
  pair_contacts_ = std::vector<PairContacts>(found_.size() * found_.size());
  learn_corners(obstacles);
}

void ContactFinder::learn_corners(const Obstacles& obstacles) {
  ThreadTeam alone(1);
  for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
    WorldBody& body = world_.bodies[i];
    const Planes3& given = obstacles.bodies[i].shape;
    const Planes3& shape = given.size() > 0 ? given : obstacles.bodies[i].positions;
    body.query->place(shape, alone);
    for (Found& one : found_) one.corners->add_body(body.grid, *body.query, shape);
  }
}

void ContactFinder::find_with_bodies(std::span<const MovingCloth> moving, double time_step,
                                     ThreadTeam& team) {
  near_ = false;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    BodyContacts& bodies = *world_.cloths[i].body_contacts;
    Found& one = found_[i];
    bodies.bound_exits(max_exit_speed * time_step);
    bodies.find(moving[i], world_.contact_bodies, world_.ground(), team);
    if (one.corners->any_sharp())
      one.corners->find({moving[i], bodies.inside(),
                         world_.pairs().boxes(static_cast<int>(i), team), world_.pairs().skin()},
                        world_.contact_bodies, team);
    one.contacts.clear();
    for (const std::span<const Contact> found : {bodies.contacts(), one.corners->contacts()})
      one.contacts.insert(one.contacts.end(), found.begin(), found.end());
    for (std::size_t b = 0; b < world_.bodies.size(); ++b)
      add_crossings(i, b, moving[i], time_step);
    one.hard = one.contacts.size();
    near_ = near_ || one.hard > 0;
  }
}

/// Contacts that bring triangles of a cloth out of a body.
void ContactFinder::add_crossings(std::size_t cloth, std::size_t body, const MovingCloth& moving,
                                  double time_step) {
  const WorldCloth& one = world_.cloths[cloth];
  const CollidingCloth& properties = one.properties;
  const bool kept_in = !properties.kept_in.empty() && properties.kept_in[body] != 0;
  one.crossings[body].add_contacts(one.grid, moving, world_.contact_bodies[body],
                                   {{properties.thickness, properties.friction},
                                    max_exit_speed * time_step,
                                    kept_in,
                                    one.body_contacts->inside()},
                                   found_[cloth].contacts);
}

int ContactFinder::count() const {
  int count = static_cast<int>(shared_.size());
  for (const Found& one : found_) count += static_cast<int>(one.contacts.size());
  return count;
}

template <class Visit>
void ContactFinder::for_pairs_of_cloths(const Visit& visit) const {
  for (std::size_t i = 0; i < found_.size(); ++i)
    for (std::size_t j = i; j < found_.size(); ++j)
      if (i != j || world_.cloths[i].properties.self_collision) visit(i, j);
}

ClothPair ContactFinder::pair_of(std::size_t i, std::size_t j, std::span<const MovingCloth> moving,
                                 double time_step, const Untangler& untangler) const {
  const WorldCloth &a = world_.cloths[i], &b = world_.cloths[j];
  ClothPair pair;
  pair.grid_a = &a.grid;
  pair.grid_b = &b.grid;
  pair.a = &moving[i];
  pair.b = &moving[j];
  pair.number_a = static_cast<int>(i);
  pair.number_b = static_cast<int>(j);
  pair.tiles_a = &world_.pairs().tiles(pair.number_a);
  pair.tiles_b = &world_.pairs().tiles(pair.number_b);
  pair.rest = a.properties.rest;
  pair.gap = world_.gap_between(i, j);
  pair.friction = std::sqrt(a.properties.friction * b.properties.friction);
  pair.time_step = time_step;
  pair.creases = i == j && a.properties.rest_spacing >= min_crease_in_gaps * pair.gap;
  pair.tangle = untangler.marks(i, j);
  return pair;
}

void ContactFinder::add_found(std::size_t i, std::size_t j) {
  const PairFound& found = contacts_of(i, j).found();
  const auto add = [](const auto& from, auto& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(found.of_a, found_[i].contacts);
  add(found.of_b, found_[j].contacts);
  add(found.shared, shared_);
  near_ = near_ || found.near;
}

void ContactFinder::find_between_cloths(std::span<const MovingCloth> moving, double time_step,
                                        const Untangler& untangler, ThreadTeam& team) {
  shared_.clear();
  const int with_bodies = count();
  for_pairs_of_cloths([&](std::size_t i, std::size_t j) {
    const std::span<const CandidateTile> cells = world_.near_cells(i, j, team);
    contacts_of(i, j).find(pair_of(i, j, moving, time_step, untangler), cells, shares_, team);
    add_found(i, j);
  });
  self_contacts_ = count() - with_bodies;
}

void ContactFinder::take_ends(std::span<const MovingCloth> moving) {
  if (!near_) return;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    found_[i].ends.forget();
    found_[i].ends.renew({nullptr, &moving[i].start, &moving[i].position}, HUGE_VALF, 0);
  }
}

void ContactFinder::mark_moved(std::size_t cloth, const MovingCloth& moving) {
  Found& one = found_[cloth];
  Worker alone = Worker::lone();
  one.ends.measure({nullptr, &moving.start, &moving.position}, alone);
  const auto same = static_cast<float>(same_place_in_gaps * world_.gap_between(cloth, cloth));
  const int patches = one.ends.versions().patches() * one.ends.versions().patches();
  one.moved.resize(static_cast<std::size_t>(patches));
  one.any_moved = false;
  for (int patch = 0; patch < patches; ++patch) {
    one.moved[patch] = one.ends.distance(patch) > same ? 1 : 0;
    one.any_moved = one.any_moved || one.moved[patch] != 0;
  }
}

void ContactFinder::find_where_moved(std::span<const MovingCloth> moving, double time_step,
                                     const Untangler& untangler, ThreadTeam& team) {
  for (std::size_t i = 0; i < moving.size(); ++i) mark_moved(i, moving[i]);
  shared_.clear();
  const int with_bodies = count();
  for_pairs_of_cloths([&](std::size_t i, std::size_t j) {
    if (found_[i].any_moved || found_[j].any_moved) {
      const std::span<const CandidateTile> cells = world_.near_cells(i, j, team);
      contacts_of(i, j).find_again(pair_of(i, j, moving, time_step, untangler), cells,
                                   {found_[i].moved, found_[j].moved}, shares_, team);
    }
    add_found(i, j);
  });
  self_contacts_ = count() - with_bodies;
}

void ContactFinder::add_struck(std::span<const StruckContact> struck, double time_step) {
  for (StruckContact one : struck) {
    Contact& contact = one.shared.contact;
    Found& first = found_[static_cast<std::size_t>(one.shared.first)];
    if (one.body >= 0) {
      contact.surface_displacement = static_cast<float>(time_step) * one.body_velocity;
      contact.offset += dot(contact.normal, contact.surface_displacement);
      first.contacts.insert(first.contacts.begin() + static_cast<std::ptrdiff_t>(first.hard++),
                            contact);
      continue;
    }
    contact.stiffness = contact.firmness * layer_stiffness(one.compliance, time_step);
    if (one.shared.first == one.shared.second)
      first.contacts.push_back(contact);
    else if (shares_)
      shared_.push_back(one.shared);
  }
}

}  // namespace weft
