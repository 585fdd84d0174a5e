#include "weft/collide/contacts/near_samples.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr int tile_side = 8;
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
  [[nodiscard]] bool is_deep(int sample) const { return !deep.empty() && deep[sample] != 0; }
};

/// The samples of a tile in a search, with their body points.
class NearSamples::Tile {
 public:
  Tile(NearSamples& all, const Search& search) : all_(all), search_(search) {}
  void add(int row, int col);
  void find_starts();
  void find_ends();

 private:
  void look_deep(int k);
  void set_start(int k, const BodyPoint& at);
  void set_end(int k, const BodyPoint* at_end);
  [[nodiscard]] ClothPoint point_of(const NearSample& of) const;
  [[nodiscard]] double reach_of(const NearSample& of) const {
    const int n = all_.grid_.size();
    return all_.reach_(of.sample / n, of.sample % n);
  }

  NearSamples& all_;
  const Search& search_;
  int count_ = 0;
  std::array<NearSample*, NearestTile::capacity> samples_{};
  std::array<BodyPoint, NearestTile::capacity> at_;
};

NearSamples::NearSamples(const SurfaceGrid& grid, const KeptGap& kept, bool keeps_in)
    : grid_(grid),
      kept_(kept),
      keeps_in_(keeps_in),
      known_(grid.size(), kept.gap),
      reach_(grid.size(), grid.size()) {
  for (Found* found : {&now_, &before_}) {
    found->first.resize(static_cast<std::size_t>(grid.size()) + 1, 0);
    found->place.resize(static_cast<std::size_t>(grid.size()) * grid.size(), -1);
  }
}

/// Calls visit(worker, first row, first column, number) for all tiles.
template <class Visit>
void NearSamples::for_tiles(ThreadTeam& team, const Visit& visit) const {
  const int tiles = (grid_.size() + tile_side - 1) / tile_side;
  team.run([&](Worker& worker) {
    for (int t = worker.rank(); t < tiles * tiles; t += worker.size())
      visit(t / tiles * tile_side, t % tiles * tile_side, t);
  });
}

void NearSamples::find(const MovingCloth& cloth, const ContactBody& body, const Doubts& doubts,
                       ThreadTeam& team) {
  const Search search{cloth, body, doubts.deep, doubts.farthest_exit, placement_ == body.placement};
  placement_ = body.placement;
  std::swap(now_, before_);
  known_.begin(cloth, body, team);
  scratch_.resize(static_cast<std::size_t>(team.size()));
  const int n = grid_.size();
  const KnownDistances::Look look{cloth.start, cloth.position, body, contact_margin * kept_.gap,
                                  body_kernels_for(team.instructions())};
  team.run([&](Worker& worker) {
    const Range mine = worker.share(n);
    for (int r = mine.first; r < mine.last; ++r) {
      known_.find_reaches(look, r, scratch_[static_cast<std::size_t>(worker.rank())],
                          reach_.row(r));
      number_row(search, r);
    }
  });
  for (int r = 0; r < n; ++r) now_.first[r + 1] += now_.first[r];
  now_.samples.resize(static_cast<std::size_t>(now_.first[n]));
  if (now_.samples.empty()) return;
  for_tiles(team, [&](int first_row, int first_col, int /*number*/) {
    Tile tile(*this, search);
    for_samples(n, first_row, first_col, [&](int r, int c) { tile.add(r, c); });
    tile.find_starts();
    tile.find_ends();
  });
}

/// Gives the samples of a row that are to be looked at their places.
void NearSamples::number_row(const Search& search, int row) {
  const int n = grid_.size();
  float* reach = reach_.row(row);
  int count = 0;
  for (int c = 0, s = row * n; c < n; ++c, ++s) {
    if (search.is_deep(s)) reach[c] = HUGE_VALF;
    now_.place[s] = reach[c] > 0 && grid_.point(s) == s ? count++ : -1;
  }
  now_.first[row + 1] = count;
}

/// Takes over what the last search found of a sample, if that still holds.
bool NearSamples::take_over(const Search& search, NearSample& to) const {
  if (!search.same_placement) return false;
  const NearSample* past = before_.find(to.sample / grid_.size(), to.sample % grid_.size());
  if (past == nullptr || past->triangle < 0 || past->astray || !(past->start == to.start))
    return false;
  to = *past;
  return true;
}

void NearSamples::Tile::add(int row, int col) {
  const int n = all_.grid_.size(), sample = row * n + col;
  const int place = all_.now_.place[sample];
  if (place < 0) return;
  NearSample& one = all_.now_.samples[all_.now_.first[row] + place];
  one.sample = sample;
  one.triangle = -1;
  one.motion = 0;
  one.astray = false;
  one.start = search_.cloth.start.at(row, col);
  samples_[count_++] = &one;
}

void NearSamples::Tile::find_starts() {
  NearestTile asked;
  std::array<int, NearestTile::capacity> of{};
  for (int k = 0; k < count_; ++k) {
    NearSample& one = *samples_[k];
    if (search_.is_deep(one.sample)) {
      look_deep(k);
    } else if (!all_.take_over(search_, one)) {
      of[asked.count] = k;
      asked.add(one.start, all_.known_.search_reach(reach_of(one)),
                all_.known_.triangle(one.sample));
    }
  }
  if (asked.count == 0) return;
  NearestPoints found;
  search_.body.query->closest(asked, found);
  for (int i = 0; i < asked.count; ++i) {
    const BodyPoint& at = found[i];
    const NearSample& one = *samples_[of[i]];
    const bool any = at.triangle >= 0;
    all_.known_.set(one.sample, one.start, any ? std::sqrt(at.squared_distance) : asked.reach[i],
                    at.triangle);
    if (any) set_start(of[i], at);
  }
}

/// A sample that was outside and kept out cannot be inside now, whatever the normals say of an
/// image that folds or crosses itself somewhere; others are asked.
void NearSamples::Tile::look_deep(int k) {
  NearSample& one = *samples_[k];
  const Vec3d start = vec_cast<double>(one.start);
  const auto found = search_.body.query->closest(start, HUGE_VAL, all_.known_.triangle(one.sample));
  if (!found) return;
  all_.known_.set(one.sample, one.start, std::sqrt(found->squared_distance), found->triangle);
  one.astray = search_.body.query->behind(start, *found) != all_.keeps_in_;
  set_start(k, *found);
}

void NearSamples::Tile::set_start(int k, const BodyPoint& at) {
  NearSample& one = *samples_[k];
  at_[k] = at;
  one.triangle = at.triangle;
  one.before = place_before(search_.body, at, point_of(one));
}

ClothPoint NearSamples::Tile::point_of(const NearSample& of) const {
  ClothPoint point;
  point.samples[0] = of.sample;
  point.start = vec_cast<double>(of.start);
  point.kept_in = all_.keeps_in_;
  point.astray = of.astray;
  point.farthest = search_.farthest_exit;
  return point;
}

/// Finds how the surface moves before the samples that may come near it.
void NearSamples::Tile::find_ends() {
  const ContactBody& body = search_.body;
  NearestTile asked;
  std::array<int, NearestTile::capacity> of{};
  for (int k = 0; k < count_; ++k) {
    NearSample& one = *samples_[k];
    if (one.triangle < 0 || one.motion == body.motion || !(one.before.gap < reach_of(one)))
      continue;
    if (at_[k].triangle < 0)
      at_[k] = body.query->point_of(vec_cast<double>(one.start), one.triangle);
    if (body.at_end == nullptr) {
      set_end(k, nullptr);
      continue;
    }
    const BlockMotion::Near& near = all_.known_.near(one.sample);
    of[asked.count] = k;
    asked.add(one.start,
              reach_at_end(one.before, length(near.displacement) + near.approach) +
                  contact_margin * all_.kept_.gap,
              one.triangle);
  }
  if (asked.count == 0) return;
  NearestPoints found;
  body.at_end->closest(asked, found);
  for (int i = 0; i < asked.count; ++i)
    set_end(of[i], found[i].triangle >= 0 ? &found[i] : nullptr);
}

void NearSamples::Tile::set_end(int k, const BodyPoint* at_end) {
  NearSample& one = *samples_[k];
  const ContactBody& body = search_.body;
  const ClothPoint point = point_of(one);
  const Vec3d moved = surface_displacement(body, at_[k], at_end, one.before, point.start);
  one.along = dot(one.before.normal, moved);
  one.contact = contact_at(body, at_[k], point, one.before, moved, all_.kept_);
  one.motion = body.motion;
}

double NearSamples::smallest_gap(const Planes3& positions, const ContactBody& body, double reach,
                                 ThreadTeam& team) {
  const int n = grid_.size();
  scratch_.resize(static_cast<std::size_t>(team.size()));
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
  for_tiles(team, [&](int first_row, int first_col, int number) {
    tile_gaps_[static_cast<std::size_t>(number)] =
        gap_of_tile(positions, body, reach, first_row, first_col);
  });
  return *std::min_element(tile_gaps_.begin(), tile_gaps_.end());
}

double NearSamples::gap_of_tile(const Planes3& positions, const ContactBody& body, double reach,
                                int first_row, int first_col) const {
  const int n = grid_.size();
  NearestTile asked;
  for_samples(n, first_row, first_col, [&](int r, int c) {
    if (reach_(r, c) > 0) asked.add(positions.at(r, c), reach, known_.triangle(r * n + c));
  });
  if (asked.count == 0) return HUGE_VAL;
  NearestPoints found;
  body.query->closest(asked, found);
  double least = HUGE_VAL;
  for (int k = 0; k < asked.count; ++k) {
    if (found[k].triangle < 0) continue;
    const double distance = std::sqrt(found[k].squared_distance);
    const Vec3d at = vec_cast<double>(asked.at[k]);
    const bool astray = body.query->closed() && body.query->behind(at, found[k]) != keeps_in_;
    least = std::min(least, astray ? -distance : distance);
  }
  return least;
}

}  // namespace weft
