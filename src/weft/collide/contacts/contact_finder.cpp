#include "weft/collide/contacts/contact_finder.h"

#include <algorithm>
#include <cmath>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Smallest rest spacing, in gaps, at which cells that share a corner get contacts: finer cloth
/// bends round its thickness over several cells.
constexpr double min_crease_in_gaps = 3;

}  // namespace

ContactFinder::ContactFinder(CollisionWorld& world, const Obstacles& obstacles) : world_(world) {
  for (const WorldCloth& cloth : world.cloths)
    found_.push_back({std::make_unique<CornerContacts>(cloth.grid, cloth.properties)});
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
    one.hard = one.contacts.size();
    near_ = near_ || one.hard > 0;
  }
}

int ContactFinder::count() const {
  int count = static_cast<int>(shared_.size());
  for (const Found& one : found_) count += static_cast<int>(one.contacts.size());
  return count;
}

void ContactFinder::find_between_cloths(std::span<const MovingCloth> moving, double time_step,
                                        const Untangler& untangler, ThreadTeam& team) {
  shared_.clear();
  const int with_bodies = count();
  for (std::size_t i = 0; i < moving.size(); ++i)
    for (std::size_t j = i; j < moving.size(); ++j) {
      const WorldCloth &a = world_.cloths[i], &b = world_.cloths[j];
      if (i == j && !a.properties.self_collision) continue;
      const double gap = world_.gap_between(i, j);
      const std::span<const CandidateTile> cells = world_.near_cells(i, j, team);
      const bool near = pair_contacts_.find(
          {&a.grid, &b.grid, &moving[i], &moving[j], &world_.pairs().tiles(static_cast<int>(i)),
           &world_.pairs().tiles(static_cast<int>(j)), static_cast<int>(i), static_cast<int>(j),
           a.properties.rest, gap, std::sqrt(a.properties.friction * b.properties.friction),
           time_step, i == j && a.properties.rest_spacing >= min_crease_in_gaps * gap,
           untangler.marks(i, j)},
          cells, team, {found_[i].contacts, found_[j].contacts, shares_ ? &shared_ : nullptr});
      near_ = near_ || near;
    }
  self_contacts_ = count() - with_bodies;
}

void ContactFinder::add_struck(std::span<const StruckContact> struck, double time_step) {
  for (StruckContact one : struck) {
    Contact& contact = one.shared.contact;
    Found& first = found_[static_cast<std::size_t>(one.shared.first)];
    if (one.body >= 0) {
      first.contacts.insert(first.contacts.begin() + static_cast<std::ptrdiff_t>(first.hard++),
                            contact);
      continue;
    }
    contact.stiffness = layer_stiffness(one.compliance, time_step);
    if (one.shared.first == one.shared.second)
      first.contacts.push_back(contact);
    else if (shares_)
      shared_.push_back(one.shared);
  }
}

}  // namespace weft
