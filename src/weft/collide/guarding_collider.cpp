#include "weft/collide/guarding_collider.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// How far the guard may move a point aside before the rest has to be looked at again: parts of the
/// gap that is kept, and of the rest spacing.
constexpr double slack_in_gaps = 0.2, slack_in_spacings = 0.03;
/// Points that were held back or moved far may lead others astray, so all is looked at again. In
/// the first rounds points may be moved by this part of the rest spacing, which leaves them their
/// motion along what they meet; in the next ones they are held back on their way.
constexpr int rounds_aside = 4, rounds_on_the_way = 6;
constexpr double aside_in_spacings = 1;
/// Then whoever is stopped stays where it was with all around it, in squares that double from round
/// to round; at last the cloths stay where they were as a whole, where nothing meets.
constexpr int most_rounds = 14;
/// Pairs are looked at that come within this many gaps, see PairContacts.
constexpr double foresight = 1.5;
/// Before the ground, against rounding [m].
constexpr double ground_margin = 2e-6;

}  // namespace

GuardingCollider::GuardingCollider(MakeBroadPhase make_broad_phase, const Obstacles& obstacles,
                                   std::span<const GuardedCloth> cloths) {
  slack_ = most_aside_ = HUGE_VAL;
  cloths_.reserve(cloths.size());
  for (const GuardedCloth& cloth : cloths) {
    cloths_.push_back({SurfaceGrid(cloth.size, cloth.mates, cloth.diagonals),
                       cloth,
                       nullptr,
                       ContactResponse(cloth.mates),
                       {},
                       points_,
                       {}});
    points_ += cloth.size * cloth.size;
    slack_ = std::min(
        {slack_, slack_in_gaps * cloth.self_thickness, slack_in_spacings * cloth.rest_spacing});
  }
  for (const GuardedCloth& cloth : cloths)
    most_aside_ = std::min(most_aside_, aside_in_spacings * cloth.rest_spacing);
  for (GuardedOne& one : cloths_)
    one.body_contacts = std::make_unique<BodyContacts>(one.grid, one.facts);
  bodies_.reserve(obstacles.bodies.size());
  for (const Body& body : obstacles.bodies) {
    bodies_.push_back({SurfaceGrid(body.positions.size(), body.mates, body.diagonals), nullptr,
                       body.positions, nullptr, body.friction, 0, true});
  }
  for (GuardedBody& body : bodies_) {
    body.query = std::make_unique<BodyQuery>(body.grid);
    body.end = &body.start;
  }
  if (obstacles.ground) ground_ = {*obstacles.ground, obstacles.ground_friction};
  std::vector<const SurfaceGrid*> grids;
  for (const GuardedOne& one : cloths_) grids.push_back(&one.grid);
  for (const GuardedBody& body : bodies_) grids.push_back(&body.grid);
  broad_phase_ = make_broad_phase(grids, cloths_.size());
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    cloth_of_.insert(cloth_of_.end(),
                     static_cast<std::size_t>(cloths_[i].facts.size) * cloths_[i].facts.size, i);
}

void GuardingCollider::move_bodies(std::span<const Planes3* const> ends) noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    GuardedBody& body = bodies_[i];
    body.end = ends[i] != nullptr ? ends[i] : &body.start;
    body.most_moved = 0;
    if (body.end == &body.start) continue;
    const int n = body.grid.size();
    double most = 0;
    for (int s = 0; s < n * n; ++s)
      most = std::max(most, double{squared_length(body.end->at(s) - body.start.at(s))});
    body.most_moved = std::sqrt(most);
    if (most == 0) body.end = &body.start;
  }
}

void GuardingCollider::finish_bodies() {
  for (GuardedBody& body : bodies_) {
    if (body.end == &body.start) continue;
    body.start = *body.end;
    body.end = &body.start;
    body.moved = true;
  }
}

void GuardingCollider::gather_surfaces(std::span<const MovingCloth> cloths) {
  surfaces_.clear();
  for (std::size_t i = 0; i < cloths.size(); ++i)
    surfaces_.push_back({&cloths_[i].grid, &cloths[i].start, &cloths[i].position});
  for (const GuardedBody& body : bodies_) surfaces_.push_back({&body.grid, &body.start, body.end});
}

void GuardingCollider::place_bodies(ThreadTeam& team) {
  contact_bodies_.clear();
  for (GuardedBody& body : bodies_) {
    if (body.moved) {
      body.query->place(body.start, team);
      ++body.placed;
    }
    body.moved = false;
    contact_bodies_.push_back({static_cast<int>(contact_bodies_.size()) + 1, body.query.get(),
                               &body.start, body.end, body.friction, body.most_moved, body.placed});
  }
}

void GuardingCollider::detect(std::span<const MovingCloth> cloths, double time_step,
                              ThreadTeam& team) noexcept {
  place_bodies(team);
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    GuardedOne& one = cloths_[i];
    one.body_contacts->find(cloths[i], contact_bodies_, ground_ ? &*ground_ : nullptr, team);
    const std::span<const Contact> found = one.body_contacts->contacts();
    one.contacts.assign(found.begin(), found.end());
  }
  gather_surfaces(cloths);
  broad_phase_->refit(surfaces_, team);
  find_pair_contacts(cloths, time_step, team);
}

void GuardingCollider::find_pair_contacts(std::span<const MovingCloth> cloths, double time_step,
                                          ThreadTeam& team) {
  self_contacts_ = 0;
  const auto before = [&] {
    int count = 0;
    for (const GuardedOne& one : cloths_) count += static_cast<int>(one.contacts.size());
    return count;
  };
  const int with_bodies = before();
  for (std::size_t i = 0; i < cloths.size(); ++i)
    for (std::size_t j = i; j < cloths.size(); ++j) {
      GuardedOne &a = cloths_[i], &b = cloths_[j];
      if (i == j && !a.facts.self_collision) continue;
      const double gap = 0.5 * (a.facts.self_thickness + b.facts.self_thickness);
      cells_.clear();
      const int first = static_cast<int>(i), second = static_cast<int>(j);
      if (i == j) {
        broad_phase_->find_self(first, static_cast<float>(foresight * gap),
                                static_cast<float>(slack_), team, cells_);
      } else {
        broad_phase_->find(first, second, static_cast<float>(foresight * gap), team, cells_);
      }
      pair_contacts_.find({&a.grid, &b.grid, &cloths[i], &cloths[j], i == j, gap,
                           std::sqrt(a.facts.friction * b.facts.friction), time_step},
                          cells_, team, a.contacts, b.contacts);
    }
  self_contacts_ = before() - with_bodies;
}

int GuardingCollider::correct(std::size_t cloth, const MovingCloth& moving,
                              std::span<const float> forces, double time_step,
                              ThreadTeam& team) noexcept {
  GuardedOne& one = cloths_[cloth];
  // Those with obstacles come first; layers are soft and stay as they were solved.
  const std::span<const Contact> hard = one.body_contacts->contacts();
  return one.response.respond(moving, {hard, forces.first(std::min(forces.size(), hard.size()))},
                              time_step, team);
}

void GuardingCollider::copy_to_mates(const GuardedOne& one, const MovingCloth& moving) {
  const BorderMates& mates = one.facts.mates;
  for (int k = 0; k < mates.class_count(); ++k)
    for (const int s : mates.mates(k).subspan(1)) {
      moving.position.set(s, moving.position.at(mates.mates(k)[0]));
      moving.velocity.set(s, moving.velocity.at(mates.mates(k)[0]));
    }
}

PlaneSide GuardingCollider::side_of(std::size_t surface) const {
  const bool body = surface >= cloths_.size();
  return {surfaces_[surface], body ? 0 : cloths_[surface].first_point, body};
}

void GuardingCollider::find_planes(ThreadTeam& team) {
  planes_.clear();
  const float reach = static_cast<float>(2 * slack_), slack = static_cast<float>(slack_);
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    for (std::size_t j = i; j < surfaces_.size(); ++j) {
      if (i == j && !cloths_[i].facts.self_collision) continue;
      cells_.clear();
      const int first = static_cast<int>(i), second = static_cast<int>(j);
      if (i == j) {
        broad_phase_->find_self(first, reach, slack, team, cells_);
      } else {
        broad_phase_->find(first, second, reach, team, cells_);
      }
      PlaneSearch search{side_of(i), side_of(j), i == j, slack_, nullptr, 0};
      if (search.b.body) {
        search.inside = &cloths_[i].body_contacts->inside();
        search.body_number = static_cast<int>(j - cloths_.size()) + 1;
      }
      cell_planes_.find(search, cells_, team, planes_);
    }
}

void GuardingCollider::add_ground_planes(std::span<const MovingCloth> cloths) {
  if (!ground_) return;
  const double least = ground_->height + ground_margin;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const GuardedOne& one = cloths_[i];
    for (int s = 0; s < one.facts.size * one.facts.size; ++s) {
      if (one.grid.point(s) != s || cloths[i].position.at(s).y >= least + slack_ ||
          cloths[i].start.at(s).y < least)
        continue;
      SeparatingPlane plane;
      plane.normal = {0, 1, 0};
      plane.offset_a = plane.still_a = least;
      plane.points[0] = one.first_point + s;
      plane.count_a = 1;
      planes_.push_back(plane);
    }
  }
}

PlaneGuard::Result GuardingCollider::hold(std::span<const MovingCloth> cloths, double time_step,
                                          double farthest, ThreadTeam& team) {
  const auto at = [&](int point) {
    const std::size_t cloth = cloth_of_[point];
    const int sample = point - cloths_[cloth].first_point;
    return GuardedPoint{cloths[cloth].start.at(sample), cloths[cloth].position.at(sample)};
  };
  const auto put = [&](int point, Vec3f end) {
    const std::size_t cloth = cloth_of_[point];
    const int sample = point - cloths_[cloth].first_point;
    const MovingCloth& moving = cloths[cloth];
    const Vec3f change = static_cast<float>(1 / time_step) * (end - moving.position.at(sample));
    moving.position.set(sample, end);
    moving.velocity.set(sample, moving.velocity.at(sample) + change);
  };
  return plane_guard_.hold(planes_, points_, {slack_, farthest}, at, put, team);
}

void GuardingCollider::stay(std::span<const MovingCloth> cloths, double time_step, int around,
                            bool all) {
  const auto stay_at_start = [&](const MovingCloth& cloth, int row, int col) {
    const Vec3f start = cloth.start.at(row, col);
    const Vec3f change = static_cast<float>(1 / time_step) * (start - cloth.position.at(row, col));
    cloth.position.set(row, col, start);
    cloth.velocity.set(row, col, cloth.velocity.at(row, col) + change);
  };
  for (std::size_t i = 0; all && i < cloths.size(); ++i)
    for (int r = 0; r < cloths_[i].facts.size; ++r)
      for (int c = 0; c < cloths_[i].facts.size; ++c) stay_at_start(cloths[i], r, c);
  if (all) return;
  for (const int point : plane_guard_.stopped()) {
    const std::size_t cloth = cloth_of_[point];
    const int n = cloths_[cloth].facts.size, sample = point - cloths_[cloth].first_point;
    const int row = sample / n, col = sample % n;
    for (int r = std::max(0, row - around); r <= std::min(n - 1, row + around); ++r)
      for (int c = std::max(0, col - around); c <= std::min(n - 1, col + around); ++c)
        stay_at_start(cloths[cloth], r, c);
  }
}

int GuardingCollider::guard(std::span<const MovingCloth> cloths, double time_step,
                            ThreadTeam& team) noexcept {
  gather_surfaces(cloths);
  int stopped = 0;
  for (int round = 0; round < most_rounds; ++round) {
    broad_phase_->refit(surfaces_, team);
    find_planes(team);
    add_ground_planes(cloths);
    const PlaneGuard::Result held =
        hold(cloths, time_step, round < rounds_aside ? most_aside_ : slack_, team);
    stopped += held.stopped + held.lost;
    for (const int point : plane_guard_.lost()) {
      GuardedOne& one = cloths_[cloth_of_[point]];
      one.body_contacts->doubt(point - one.first_point);
    }
    const bool settled = held.stopped + held.far == 0;
    if (!settled && round >= rounds_on_the_way)
      stay(cloths, time_step, 1 << (round - rounds_on_the_way), round + 1 == most_rounds);
    for (std::size_t i = 0; i < cloths_.size(); ++i) copy_to_mates(cloths_[i], cloths[i]);
    if (settled) break;
  }
  finish_bodies();
  return stopped;
}

double GuardingCollider::smallest_gap(std::size_t cloth, const Planes3& positions,
                                      ThreadTeam& team) noexcept {
  GuardedOne& one = cloths_[cloth];
  place_bodies(team);
  const int n = positions.size();
  one.row_gaps.resize(static_cast<std::size_t>(n));
  const double reach = 2 * one.facts.thickness;
  team.run([&](Worker& worker) {
    const Range rows = worker.share(n);
    for (int r = rows.first; r < rows.last; ++r) {
      double least = HUGE_VAL;
      for (int c = 0; c < n; ++c) {
        const Vec3d p = vec_cast<double>(positions.at(r, c));
        if (ground_) least = std::min(least, p.y - ground_->height);
        for (const ContactBody& body : contact_bodies_)
          if (const auto found = body.query->closest(p, reach)) {
            const bool behind = body.query->closed() && body.query->behind(p, *found);
            const double distance = std::sqrt(found->squared_distance);
            least = std::min(least, behind ? -distance : distance);
          }
      }
      one.row_gaps[r] = least;
    }
  });
  return *std::min_element(one.row_gaps.begin(), one.row_gaps.end());
}

}  // namespace weft
