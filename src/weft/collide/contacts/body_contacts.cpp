#include "weft/collide/contacts/body_contacts.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Further steps like the present one that a search covers in advance.
constexpr double ahead = 1;
/// Generous bound of the relative rounding error of distances in single precision.
constexpr double rounding = 1e-5;
/// Distances to bodies are cached up to this many gaps.
constexpr double known_gaps = 6;
/// Approaches of bodies below this part of a gap need no sharper bound.
constexpr double known_well = 0.05;

}  // namespace

BodyContacts::BodyContacts(const SurfaceGrid& grid, const CollidingCloth& cloth)
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

double BodyContacts::farthest_known() const { return known_gaps * kept_.gap; }

int BodyContacts::blocks_a_side() const { return (grid_.size() - 1) / BlockMotion::block_size + 1; }

const BodyContacts::NearBlock& BodyContacts::block_of(const Past& past, int sample) const {
  const int n = grid_.size();
  return past.blocks[sample / n / BlockMotion::block_size * blocks_a_side() +
                     sample % n / BlockMotion::block_size];
}

Box3f BodyContacts::box_of_block(const Planes3& at, int block) const {
  constexpr float far = HUGE_VALF;
  constexpr int wide = BlockMotion::block_size;
  Box3f box{{far, far, far}, {-far, -far, -far}};
  const int n = grid_.size(), row = block / blocks_a_side() * wide,
            col = block % blocks_a_side() * wide;
  for (int r = row; r < std::min(n, row + wide); ++r)
    for (int c = col; c < std::min(n, col + wide); ++c) {
      box.lower = min(box.lower, at.at(r, c));
      box.upper = max(box.upper, at.at(r, c));
    }
  return box;
}

/// Body parts that never come within `reach` of a block in a step stay more than twice the largest
/// cached distance away from its samples, as long as none of these moves by more than that
/// distance; so they invalidate no cached distance.
void BodyContacts::find_near_blocks(const MovingCloth& cloth, const ContactBody& body,
                                    ThreadTeam& team) {
  Past& past = past_[body.number - 1];
  if (past.motion == body.motion) return;
  past.motion = body.motion;
  const auto reach = static_cast<float>(3 * farthest_known());
  team.run([&](Worker& worker) {
    const Range mine = worker.share(static_cast<int>(past.blocks.size()));
    for (int b = mine.first; b < mine.last; ++b)
      past.blocks[b].now = body.blocks != nullptr ? body.blocks->near(box_of_block(cloth.start, b),
                                                                      reach, known_well * kept_.gap)
                                                  : BlockMotion::Near{};
  });
}

void BodyContacts::arrive(std::size_t body, int motion) {
  if (body >= past_.size()) return;
  Past& past = past_[body];
  if (past.motion != motion)  // the motion was never searched
    return past.samples.assign(past.samples.size(), {});
  for (NearBlock& block : past.blocks) {
    block.carried += block.now.displacement;
    block.travelled += block.now.approach;
  }
}

/// Motion of a body where a sample may come: that near its block, or a bound for the whole body
/// where the sample moves too far.
BlockMotion::Near BodyContacts::near_of(const ContactBody& body, const NearBlock& block,
                                        Vec3d displacement) const {
  if (length(displacement) <= farthest_known()) return block.now;
  return {{}, body.max_approach};
}

std::optional<BodyPoint> BodyContacts::find_closest(const ContactBody& body, const NearBlock& near,
                                                    Vec3d start, double reach, Known& known) const {
  const Vec3d place = start - near.carried;
  if (length(start - vec_cast<double>(known.seen)) > farthest_known()) known.distance = 0;
  known.seen = vec_cast<float>(start);
  const double since = length(place - known.place) + (near.travelled - known.travelled);
  if (known.distance - since > reach * (1 + rounding)) return std::nullopt;
  // The search reaches farther than needed, so that the next steps can use the cached distance.
  const double minimum = contact_margin * kept_.gap;
  const double wider =
      std::max(reach, std::min(reach + ahead * (reach - minimum) + minimum, farthest_known()));
  const auto found = body.query->closest(start, wider, known.triangle);
  const double distance = found ? std::sqrt(found->squared_distance) : wider;
  known.place = place;
  known.travelled = near.travelled;
  known.distance = static_cast<float>(std::min(distance, farthest_known()));
  if (found) known.triangle = found->triangle;
  if (!found || !(found->squared_distance < reach * reach)) return std::nullopt;
  return found;
}

void BodyContacts::find_body(const MovingCloth& cloth, const ContactBody& body, bool deep,
                             int sample, std::vector<Contact>& out) {
  const Vec3d start = vec_cast<double>(cloth.start.at(sample));
  const Vec3d displacement = vec_cast<double>(cloth.position.at(sample)) - start;
  Past& past = past_[body.number - 1];
  const NearBlock& block = block_of(past, sample);
  const BlockMotion::Near near = near_of(body, block, displacement);
  const double reach =
      deep ? HUGE_VAL
           : contact_margin * kept_.gap + length(displacement - near.displacement) + near.approach;
  const auto found = find_closest(body, block, start, reach, past.samples[sample]);
  if (!found) return;
  // A sample that was outside and kept out cannot be inside now, whatever the normals say of an
  // image that folds or crosses itself somewhere.
  const bool astray = deep && body.query->behind(start, *found) != keeps_in(body);
  if (astray) marks_.inside[sample] = body.number;
  ClothPoint at;
  at.samples[0] = sample;
  at.start = start;
  at.displacement = displacement;
  at.kept_in = keeps_in(body);
  at.astray = astray;
  at.farthest = farthest_exit_;
  if (const auto contact = contact_before(body, *found, at, kept_)) out.push_back(*contact);
}

void BodyContacts::find_ground(const MovingCloth& cloth, const Ground& ground, int sample,
                               std::vector<Contact>& out) const {
  if (cloth.position.at(sample).y >= ground.height + contact_margin * kept_.gap) return;
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
  past_.resize(bodies.size());
  for (Past& past : past_) {
    past.samples.resize(marks_.inside.size());
    past.blocks.resize(static_cast<std::size_t>(blocks_a_side()) * blocks_a_side());
  }
  for (const ContactBody& body : bodies) find_near_blocks(cloth, body, team);
  const int n = grid_.size();
  found_.fill(n * n, team, [&](int s, std::vector<Contact>& out) {
    if (grid_.point(s) == s) find_for_sample(cloth, bodies, ground, s, out);
  });
  contacts_.clear();
  append(found_, contacts_);
  marks_.looked = true;
}

}  // namespace weft
