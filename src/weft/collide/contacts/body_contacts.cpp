#include "weft/collide/contacts/body_contacts.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Part of the gap within which a sample is doubtful: it is among triangles that still cross the
/// body, which no plane parts from it, so a step may put it on the other side. There, what keeps it
/// off the surface would drive it in.
constexpr float touching_part = 0.25F;
/// Part of the gap by which what is below the ground is more than rounding.
constexpr double below_part = 0.02;

}  // namespace

BodyContacts::BodyContacts(const SurfaceGrid& grid, const CollidingCloth& cloth)
    : grid_(grid),
      kept_{cloth.thickness, cloth.friction},
      kept_in_(cloth.kept_in),
      marks_{cloth.wrong_side, {}, !cloth.wrong_side.empty(), !cloth.wrong_side.empty()} {
  const std::size_t samples = static_cast<std::size_t>(grid.size()) * grid.size();
  marks_.inside.resize(samples, 0);
  marks_.doubted.resize(samples, 0);
  touching_.resize(static_cast<std::size_t>(grid.size()), 0);
  commit();
}

void BodyContacts::save(std::vector<int>& marks) const {
  marks.clear();
  for (std::size_t s = 0; marks_.looked && s < marks_.inside.size(); ++s)
    marks.push_back(2 * marks_.inside[s] + marks_.doubted[s]);
}

void BodyContacts::restore(std::span<const int> marks) {
  marks_.looked = marks.size() == marks_.inside.size();
  marks_.any = true;
  for (std::size_t s = 0; marks_.looked && s < marks_.inside.size(); ++s) {
    marks_.inside[s] = marks[s] / 2;
    marks_.doubted[s] = static_cast<char>(marks[s] % 2);
  }
  commit();
}

void BodyContacts::arrive(std::size_t body, int motion) {
  if (body < near_.size()) near_[body].arrive(motion);
}

bool BodyContacts::any_inside(int body) const {
  return marks_.any &&
         std::find(marks_.inside.begin(), marks_.inside.end(), body) != marks_.inside.end();
}

NearSamples& BodyContacts::near(const ContactBody& body) {
  const auto index = static_cast<std::size_t>(body.number - 1);
  while (near_.size() <= index) near_.emplace_back(grid_, kept_, keeps_in(near_.size()));
  return near_[index];
}

/// The samples that may start on the wrong side of a body: those that did, those that it moved
/// onto, and all as long as nobody has looked.
std::span<const char> BodyContacts::find_deep(const ContactBody& body) {
  if (!body.query->closed() || (marks_.looked && !marks_.any)) return {};
  deep_.resize(marks_.inside.size());
  for (std::size_t s = 0; s < deep_.size(); ++s)
    deep_[s] = !marks_.looked || marks_.inside[s] == body.number || marks_.doubted[s] != 0 ? 1 : 0;
  return deep_;
}

void BodyContacts::find_ground(const MovingCloth& cloth, const Ground& ground, int row, int col,
                               std::vector<Contact>& out) const {
  Contact contact;
  contact.samples[0] = row * grid_.size() + col;
  contact.normal = {0, 1, 0};
  put_offset(ground.height, double{cloth.start.y(row, col)} - ground.height, kept_.gap, contact);
  contact.friction = static_cast<float>(pair_friction(kept_.friction, ground.friction));
  // What is well below is on its way back, as what is inside of a body.
  if (double{cloth.start.y(row, col)} < ground.height - below_part * kept_.gap)
    bring_back(farthest_exit_, contact);
  out.push_back(contact);
}

void BodyContacts::find_row(const MovingCloth& cloth, std::span<const ContactBody> bodies,
                            const Ground* ground, int row, std::vector<Contact>& out) {
  const int n = grid_.size();
  const double low = ground != nullptr ? ground->height + contact_margin * kept_.gap : -HUGE_VAL;
  for (int c = 0; c < n; ++c) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      near_[b].add_contact(cloth, bodies[b], row, c, out);
    doubt_touching(bodies, row, c);
    if (cloth.position.y(row, c) < low && grid_.point(row * n + c) == row * n + c)
      find_ground(cloth, *ground, row, c, out);
  }
}

/// Doubts a sample that touches a closed body, or is next to a part of it that lies in it, so that
/// the next step asks on which side it is.
void BodyContacts::doubt_touching(std::span<const ContactBody> bodies, int row, int col) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const NearSample* near = near_[b].find(row, col);
    if (near == nullptr || near->triangle < 0 || !bodies[b].query->closed()) continue;
    if (!bodies[b].is_buried(near->triangle) &&
        !(std::abs(near->gap) < touching_part * static_cast<float>(kept_.gap)))
      continue;
    marks_.doubted[row * grid_.size() + col] = 1;
    touching_[row] = 1;
  }
}

/// Notes which samples are on the wrong side of which body.
void BodyContacts::mark_inside(std::span<const ContactBody> bodies) {
  std::fill(marks_.inside.begin(), marks_.inside.end(), 0);
  std::fill(marks_.doubted.begin(), marks_.doubted.end(), 0);
  marks_.any = false;
  const int n = grid_.size();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int s = 0; s < n * n; ++s) {
      const NearSample* near = near_[b].find(s / n, s % n);
      if (near == nullptr || !near->astray) continue;
      marks_.inside[s] = bodies[b].number;
      marks_.any = true;
    }
}

void BodyContacts::find(const MovingCloth& cloth, std::span<const ContactBody> bodies,
                        const Ground* ground, ThreadTeam& team) {
  contacts_.clear();
  const bool looks_deep = !marks_.looked || marks_.any;
  for (const ContactBody& body : bodies)
    near(body).find(cloth, body, {find_deep(body), farthest_exit_}, team);
  if (looks_deep) mark_inside(bodies);
  marks_.looked = true;
  if (bodies.empty() && ground == nullptr) return;
  std::fill(touching_.begin(), touching_.end(), 0);
  found_.fill(grid_.size(), team, [&](int row, std::vector<Contact>& out) {
    find_row(cloth, bodies, ground, row, out);
  });
  append(found_, contacts_);
  marks_.any = marks_.any || std::find(touching_.begin(), touching_.end(), 1) != touching_.end();
}

double BodyContacts::smallest_gap(const Planes3& positions, const ContactBody& body, double reach,
                                  ThreadTeam& team) {
  return near(body).smallest_gap(positions, body, reach, team);
}

}  // namespace weft
