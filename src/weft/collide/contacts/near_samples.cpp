#include "weft/collide/contacts/near_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/collide/contacts/opposite_sides.h"

namespace weft {
namespace {

constexpr int tile_side = 8;
/// How much farther than the closest triangle of a body that stands still others are told apart, in
/// gaps.
constexpr double told_apart = 0.1;
static_assert(tile_side * tile_side <= NearestTile::capacity);

/// Calls visit(row, col) for the samples of a tile, in the order of a Z: neighbours in the order
/// are neighbours in the cloth.
template <class Visit>
void for_samples(int size, int first_row, int first_col, const Visit& visit) {
  for (unsigned k = 0; k < tile_side * tile_side; ++k) {
    const unsigned row = (k >> 1U & 1U) | (k >> 2U & 2U) | (k >> 3U & 4U),
                   col = (k & 1U) | (k >> 1U & 2U) | (k >> 2U & 4U);
    const int r = first_row + static_cast<int>(row), c = first_col + static_cast<int>(col);
    if (r < size && c < size) visit(r, c);
  }
}

}  // namespace

/// One search.
struct NearSamples::Search {
  const MovingCloth& cloth;
  const ContactBody& body;
  std::span<const char> deep;
  double farthest_exit;  // see ClothPoint::farthest [m]
  bool same_placement;   // as in the last search
  bool same_opposites;   // whether opposite sides are looked for, as in the last search
  [[nodiscard]] bool is_deep(int sample) const { return !deep.empty() && deep[sample] != 0; }
};

/// The samples of a tile in a search, with their body points. Made once for many tiles.
class NearSamples::Tile {
 public:
  Tile(NearSamples& all, const Search& search)
      : all_(all), search_(search), opposites_(all.kept_.gap) {}
  void clear() { count_ = 0; }
  void add(int row, int col);
  void find_starts();
  void find_opposites();
  void find_ends();

 private:
  [[nodiscard]] bool knows_closest(int k);
  void find_deep(int k);
  void ask(int k, double reach, int hint);
  void set_start(int k, const BodyPoint& at);
  void set_end(int k, const BodyPoint* at_end);
  [[nodiscard]] ClothPoint point_of(int k) const;
  [[nodiscard]] double reach_of(int k) const {
    const int n = all_.grid_.size();
    return all_.reach_(numbers_[k] / n, numbers_[k] % n);
  }

  NearSamples& all_;
  const Search& search_;
  int count_ = 0;
  std::array<NearSample*, NearestTile::capacity> samples_{};
  std::array<int, NearestTile::capacity> numbers_{};  // row * n + col
  std::array<char, NearestTile::capacity> new_{};     // whether its opposite side is not known
  std::array<BodyPoint, NearestTile::capacity> at_;
  // What is asked of the body, the samples it is asked for, and the answers.
  NearestTile asked_;
  std::array<int, NearestTile::capacity> of_{};
  NearestPoints found_;
  OppositeSides opposites_;
};

NearSamples::NearSamples(const SurfaceGrid& grid, const KeptGap& kept, bool keeps_in)
    : grid_(grid),
      kept_(kept),
      keeps_in_(keeps_in),
      known_(grid.size(), kept.gap),
      reach_(grid.size(), grid.size()),
      place_(static_cast<std::size_t>(grid.size()) * grid.size(), -1),
      fresh_(static_cast<std::size_t>(grid.size()) + 1, 0) {}

/// Calls visit(first row, first column, number) for a worker's tiles.
template <class Visit>
void NearSamples::for_tiles(const Worker& worker, const Visit& visit) const {
  const int tiles = (grid_.size() + tile_side - 1) / tile_side;
  for (int t = worker.rank(); t < tiles * tiles; t += worker.size())
    visit(t / tiles * tile_side, t % tiles * tile_side, t);
}

void NearSamples::find(const MovingCloth& cloth, const ContactBody& body, const Doubts& doubts,
                       ThreadTeam& team) {
  const bool looks = body.start == body.end && !grid_.is_sewn();
  const bool looked = std::exchange(knows_opposites_, looks);
  const Search search{.cloth = cloth,
                      .body = body,
                      .deep = doubts.deep,
                      .farthest_exit = doubts.farthest_exit,
                      .same_placement = placement_ == body.placement,
                      .same_opposites = looks == looked};
  placement_ = body.placement;
  known_.begin(cloth, body, team);
  make_scratch(team);
  const int n = grid_.size();
  const KnownDistances::Look look{cloth.start, cloth.position, body, contact_margin * kept_.gap,
                                  body_kernels_for(team.instructions())};
  team.run([&](Worker& worker) {
    const Range mine = worker.share(n);
    for (int r = mine.first; r < mine.last; ++r) {
      known_.find_reaches(look, r, scratch_[static_cast<std::size_t>(worker.rank())],
                          reach_.row(r));
      choose_row(search, r);
    }
  });
  make_room();
  team.run([&](Worker& worker) {
    Tile tile(*this, search);
    for_tiles(worker, [&](int first_row, int first_col, int /*number*/) {
      tile.clear();
      for_samples(n, first_row, first_col, [&](int r, int c) { tile.add(r, c); });
      tile.find_starts();
      tile.find_opposites();
      tile.find_ends();
    });
  });
}

/// Chooses the samples of a row that are to be looked at, and counts those that have no place yet.
void NearSamples::choose_row(const Search& search, int row) {
  const int n = grid_.size();
  float* reach = reach_.row(row);
  int fresh = 0;
  for (int c = 0, s = row * n; c < n; ++c, ++s) {
    if (search.is_deep(s)) reach[c] = HUGE_VALF;
    if (!(reach[c] > 0)) continue;
    if (grid_.point(s) != s)
      reach[c] = 0;
    else if (place_[s] < 0)
      ++fresh;
  }
  fresh_[row + 1] = fresh;
}

/// Gives the samples that are near for the first time their places.
void NearSamples::make_room() {
  const int n = grid_.size();
  fresh_[0] = static_cast<int>(samples_.size());
  for (int r = 0; r < n; ++r) {
    int next = fresh_[r];
    for (int c = 0; fresh_[r + 1] > 0 && c < n; ++c)
      if (int& place = place_[r * n + c]; reach_(r, c) > 0 && place < 0) place = next++;
    fresh_[r + 1] = next;
  }
  samples_.resize(static_cast<std::size_t>(fresh_[n]));
  opposite_.resize(samples_.size(), -1);
}

/// Adds a sample that is near, with what the last search found of it where that still holds.
void NearSamples::Tile::add(int row, int col) {
  if (!(all_.reach_(row, col) > 0)) return;
  const int sample = row * all_.grid_.size() + col;
  NearSample& one = all_.samples_[all_.place_[sample]];
  numbers_[count_] = sample;
  const Vec3f start = search_.cloth.start.at(row, col);
  const bool known = one.triangle >= 0 && !one.astray && search_.same_placement &&
                     one.start == start && !search_.is_deep(sample);
  if (!known) {
    one.start = start;
    one.triangle = -1;
    one.motion = 0;
    one.astray = false;
  }
  at_[count_].triangle = -1;
  new_[count_] = known && search_.same_opposites ? 0 : 1;
  samples_[count_++] = &one;
}

void NearSamples::Tile::ask(int k, double reach, int hint) {
  of_[asked_.count] = k;
  asked_.add(samples_[k]->start, reach, hint);
}

void NearSamples::Tile::find_starts() {
  asked_.count = 0;
  // Where bodies move, others come nearer too soon.
  asked_.beyond = search_.body.blocks == nullptr ? told_apart * all_.kept_.gap : 0;
  for (int k = 0; k < count_; ++k) {
    if (samples_[k]->triangle >= 0) continue;
    if (search_.is_deep(numbers_[k]))
      find_deep(k);
    else if (!knows_closest(k))
      ask(k, all_.known_.search_reach(reach_of(k)), all_.known_.triangle(numbers_[k]));
  }
  search_.body.query->closest(asked_, found_);
  for (int i = 0; i < asked_.count; ++i) {
    const BodyPoint& at = found_[i].point;
    const bool any = at.triangle >= 0;
    all_.known_.set(
        numbers_[of_[i]], asked_.at[i],
        {any ? std::sqrt(at.squared_distance) : asked_.reach[i], at.triangle, found_[i].others});
    if (any) set_start(of_[i], at);
  }
}

/// Whether the triangle that was closest to a sample is still certain to be.
bool NearSamples::Tile::knows_closest(int k) {
  const Vec3f start = samples_[k]->start;
  const double most = all_.known_.closest_up_to(numbers_[k], start);
  if (!(most > 0)) return false;
  const BodyPoint at =
      search_.body.query->point_of(vec_cast<double>(start), all_.known_.triangle(numbers_[k]));
  if (!(at.squared_distance < most * most)) return false;
  set_start(k, at);
  return true;
}

/// A sample that was outside and kept out cannot be inside now, whatever the normals say of an
/// image that folds or crosses itself somewhere; others are asked.
void NearSamples::Tile::find_deep(int k) {
  NearSample& one = *samples_[k];
  const Vec3d start = vec_cast<double>(one.start);
  const auto found =
      search_.body.query->closest(start, HUGE_VAL, all_.known_.triangle(numbers_[k]));
  if (!found) return;
  all_.known_.set(numbers_[k], one.start, {std::sqrt(found->squared_distance), found->triangle});
  const bool crossed = search_.body.is_crossed(found->triangle);
  one.astray = (crossed || !search_.body.is_buried(found->triangle)) &&
               search_.body.query->behind(start, *found) != (all_.keeps_in_ != crossed);
  set_start(k, *found);
}

void NearSamples::Tile::set_start(int k, const BodyPoint& at) {
  NearSample& one = *samples_[k];
  at_[k] = at;
  one.triangle = at.triangle;
  const PlaceBefore before = place_before(search_.body, at, point_of(k));
  one.normal = vec_cast<float>(before.normal);
  one.gap = static_cast<float>(before.gap);
}

ClothPoint NearSamples::Tile::point_of(int k) const {
  ClothPoint point;
  point.samples[0] = numbers_[k];
  point.start = vec_cast<double>(samples_[k]->start);
  point.kept_in = all_.keeps_in_ != search_.body.is_crossed(samples_[k]->triangle);
  point.astray = samples_[k]->astray;
  point.farthest = search_.farthest_exit;
  return point;
}

void NearSamples::Tile::find_opposites() {
  opposites_.clear();
  for (int k = 0; k < count_; ++k) {
    if (new_[k] == 0) continue;
    const NearSample& one = *samples_[k];
    int& opposite = all_.opposite_[all_.place_[numbers_[k]]];
    const int hint = std::exchange(opposite, -1);
    if (all_.knows_opposites_ && one.triangle >= 0 && !one.astray)
      opposites_.ask({one.start, one.normal, one.gap, hint}, &opposite);
  }
  opposites_.find(*search_.body.query);
}

/// Finds how the surface moves before the samples that may come near it.
void NearSamples::Tile::find_ends() {
  const ContactBody& body = search_.body;
  asked_.count = 0;
  asked_.beyond = 0;
  for (int k = 0; k < count_; ++k) {
    NearSample& one = *samples_[k];
    if (one.triangle < 0 || one.motion == body.motion || !(one.gap < reach_of(k))) continue;
    if (at_[k].triangle < 0)
      at_[k] = body.query->point_of(vec_cast<double>(one.start), one.triangle);
    if (body.at_end == nullptr) {
      set_end(k, nullptr);
      continue;
    }
    const BlockMotion::Near& near = all_.known_.near(numbers_[k]);
    ask(k,
        reach_at_end(one.gap, length(near.displacement) + near.approach) +
            contact_margin * all_.kept_.gap,
        one.triangle);
  }
  if (asked_.count == 0) return;
  body.at_end->closest(asked_, found_);
  for (int i = 0; i < asked_.count; ++i) {
    const BodyPoint& at_end = found_[i].point;
    const bool known = at_end.triangle >= 0 && !body.is_buried(at_end.triangle);
    set_end(of_[i], known ? &at_end : nullptr);
  }
}

void NearSamples::Tile::set_end(int k, const BodyPoint* at_end) {
  NearSample& one = *samples_[k];
  const ContactBody& body = search_.body;
  const ClothPoint point = point_of(k);
  const PlaceBefore before = place_before(body, at_[k], point);
  const Vec3d moved = surface_displacement(body, at_[k], at_end, before, point.start);
  const Contact contact = contact_at(body, at_[k], point, before, moved, all_.kept_);
  one.along = static_cast<float>(dot(before.normal, moved));
  one.displacement = contact.surface_displacement;
  one.offset = contact.offset;
  one.lift = contact.lift;
  one.motion = body.motion;
}

void NearSamples::add_contact(const MovingCloth& cloth, const ContactBody& body, int row, int col,
                              std::vector<Contact>& out) const {
  const NearSample* near = find(row, col);
  if (near == nullptr || near->triangle < 0 || near->motion != body.motion) return;
  const bool crossed = body.is_crossed(near->triangle);
  if (!crossed && body.is_buried(near->triangle)) return;
  const Vec3d displacement =
      vec_cast<double>(cloth.position.at(row, col)) - vec_cast<double>(near->start);
  add_opposite(*near, displacement, body, row * grid_.size() + col, out);
  if (!comes_near({vec_cast<double>(near->normal), near->gap}, displacement, near->along, kept_))
    return;
  Contact contact;
  contact.samples[0] = row * grid_.size() + col;
  contact.normal = near->normal;
  contact.offset = near->offset;
  contact.lift = near->lift;
  // Between sides that cross there is no room for a gap.
  if (crossed && !near->astray)
    put_offset(near->offset - std::min<double>(kept_.gap, near->gap), near->gap, 0, contact);
  contact.friction =
      near->astray ? 0 : static_cast<float>(pair_friction(kept_.friction, body.friction));
  contact.surface_displacement = near->displacement;
  out.push_back(contact);
}

void NearSamples::add_opposite(const NearSample& near, Vec3d displacement, const ContactBody& body,
                               int sample, std::vector<Contact>& out) const {
  const int triangle = opposite_[place_[sample]];
  if (triangle < 0 || body.is_buried(triangle)) return;
  ClothPoint point;
  point.samples[0] = sample;
  point.start = vec_cast<double>(near.start);
  point.displacement = displacement;
  point.kept_in = keeps_in_;
  const BodyPoint at = body.query->point_of(point.start, triangle);
  if (const auto contact = contact_before(body, at, point, kept_)) out.push_back(*contact);
}

void NearSamples::make_scratch(const ThreadTeam& team) {
  while (static_cast<int>(scratch_.size()) < team.size()) scratch_.push_back(known_.make_scratch());
}

double NearSamples::smallest_gap(const Planes3& positions, const ContactBody& body, double reach,
                                 ThreadTeam& team) {
  const int n = grid_.size();
  make_scratch(team);
  const KnownDistances::Look look{positions, positions, body, reach,
                                  body_kernels_for(team.instructions())};
  team.run([&](Worker& worker) {
    const Range mine = worker.share(n);
    for (int r = mine.first; r < mine.last; ++r)
      known_.find_reaches(look, r, scratch_[static_cast<std::size_t>(worker.rank())],
                          reach_.row(r));
  });
  const int tiles = (n + tile_side - 1) / tile_side;
  tile_gaps_.assign(static_cast<std::size_t>(tiles) * tiles, HUGE_VAL);
  team.run([&](Worker& worker) {
    NearestTile asked;
    NearestPoints found;
    for_tiles(worker, [&](int first_row, int first_col, int number) {
      asked.count = 0;
      for_samples(n, first_row, first_col, [&](int r, int c) {
        if (reach_(r, c) > 0) asked.add(positions.at(r, c), reach, known_.triangle(r * n + c));
      });
      body.query->closest(asked, found);
      tile_gaps_[static_cast<std::size_t>(number)] = smallest_of(asked, found, body);
    });
  });
  return *std::min_element(tile_gaps_.begin(), tile_gaps_.end());
}

double NearSamples::smallest_of(const NearestTile& asked, const NearestPoints& found,
                                const ContactBody& body) const {
  double least = HUGE_VAL;
  for (int k = 0; k < asked.count; ++k) {
    const BodyPoint& point = found[k].point;
    if (point.triangle < 0 || body.is_buried(point.triangle)) continue;
    const double distance = std::sqrt(point.squared_distance);
    const Vec3d at = vec_cast<double>(asked.at[k]);
    const bool astray = body.query->closed() && body.query->behind(at, point) != keeps_in_;
    least = std::min(least, astray ? -distance : distance);
  }
  return least;
}

}  // namespace weft
