#include "weft/collide/contacts/body_contacts.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Steps as long as the present one that a look reckons with.
constexpr double ahead = 1;
/// Of distances in single precision, generously.
constexpr double rounding = 1e-5;

}  // namespace

BodyContacts::BodyContacts(const SurfaceGrid& grid, const GuardedCloth& cloth)
    : grid_(grid),
      kept_{cloth.thickness, cloth.friction},
      kept_in_(cloth.kept_in),
      marks_{cloth.wrong_side, {}, !cloth.wrong_side.empty()} {
  const std::size_t samples = static_cast<std::size_t>(grid.size()) * grid.size();
  marks_.inside.resize(samples, 0);
  marks_.doubted.resize(samples, 0);
  commit();
}

void BodyContacts::save(std::vector<int>& marks) const {
  marks.clear();
  for (std::size_t s = 0; marks_.looked && s < marks_.inside.size(); ++s)
    marks.push_back(2 * marks_.inside[s] + marks_.doubted[s]);
}

void BodyContacts::restore(std::span<const int> marks) {
  marks_.looked = marks.size() == marks_.inside.size();
  for (std::size_t s = 0; marks_.looked && s < marks_.inside.size(); ++s) {
    marks_.inside[s] = marks[s] / 2;
    marks_.doubted[s] = static_cast<char>(marks[s] % 2);
  }
  commit();
}

std::optional<BodyPoint> BodyContacts::look(const ContactBody& body, Vec3f start, double reach,
                                            Known& known) {
  const Vec3d point = vec_cast<double>(start);
  const double since =
      length(point - vec_cast<double>(known.place)) + (body.travelled - known.travelled);
  if (known.distance - since > reach * (1 + rounding)) return std::nullopt;
  // Farther than need be, so that the next steps need not look again.
  const double wider =
      reach + ahead * (reach - contact_foresight * kept_.gap) + contact_foresight * kept_.gap;
  const auto found = body.query->closest(point, wider, known.triangle);
  known = {start, static_cast<float>(found ? std::sqrt(found->squared_distance) : wider),
           body.travelled, found ? found->triangle : known.triangle};
  if (!found || !(found->squared_distance < reach * reach)) return std::nullopt;
  return found;
}

void BodyContacts::find_body(const MovingCloth& cloth, const ContactBody& body, bool deep,
                             int sample, std::vector<Contact>& out) {
  const Vec3d start = vec_cast<double>(cloth.start.at(sample));
  const Vec3d way = vec_cast<double>(cloth.position.at(sample)) - start;
  const double reach =
      deep ? HUGE_VAL : contact_foresight * kept_.gap + length(way) + body.most_approach;
  const auto found = look(body, cloth.start.at(sample), reach, known_[body.number - 1][sample]);
  if (!found) return;
  // What was outside and kept out cannot be inside now, whatever the normals of an image say that
  // folds or crosses itself somewhere.
  const bool astray = deep && body.query->behind(start, *found) != keeps_in(body);
  if (astray) marks_.inside[sample] = body.number;
  ClothPoint at;
  at.samples[0] = sample;
  at.start = start;
  at.way = way;
  at.kept_in = keeps_in(body);
  at.astray = astray;
  if (const auto contact = contact_before(body, *found, at, kept_)) out.push_back(*contact);
}

void BodyContacts::find_ground(const MovingCloth& cloth, const Ground& ground, int sample,
                               std::vector<Contact>& out) const {
  if (cloth.position.at(sample).y >= ground.height + contact_foresight * kept_.gap) return;
  Contact contact;
  contact.samples[0] = sample;
  contact.normal = {0, 1, 0};
  put_offset(ground.height, double{cloth.start.at(sample).y} - ground.height, kept_.gap, contact);
  contact.friction = static_cast<float>(pair_friction(kept_.friction, ground.friction));
  out.push_back(contact);
}

void BodyContacts::find_for_sample(const MovingCloth& cloth, std::span<const ContactBody> bodies,
                                   const Ground* ground, int sample, std::vector<Contact>& out) {
  const int was_inside = marks_.inside[sample];
  marks_.inside[sample] = 0;
  for (const ContactBody& body : bodies) {
    const bool doubt = !marks_.looked || was_inside == body.number || marks_.doubted[sample] != 0;
    find_body(cloth, body, doubt && body.query->closed(), sample, out);
  }
  marks_.doubted[sample] = 0;
  if (ground != nullptr) find_ground(cloth, *ground, sample, out);
}

void BodyContacts::find(const MovingCloth& cloth, std::span<const ContactBody> bodies,
                        const Ground* ground, ThreadTeam& team) {
  if (bodies.empty() && ground == nullptr) {
    contacts_.clear();
    marks_.looked = true;
    return;
  }
  known_.resize(bodies.size());
  for (std::vector<Known>& known : known_) known.resize(marks_.inside.size());
  const int n = grid_.size();
  team.run([&](Worker& worker) {
    found_.fill(n * n, worker, [&](int s, std::vector<Contact>& out) {
      if (grid_.point(s) == s) find_for_sample(cloth, bodies, ground, s, out);
    });
  });
  contacts_.clear();
  append(found_, contacts_);
  marks_.looked = true;
}

}  // namespace weft
