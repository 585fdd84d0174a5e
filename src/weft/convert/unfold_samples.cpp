#include "weft/convert/unfold_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "weft/convert/patch_deviation.h"
#include "weft/convert/patch_unfolding.h"
#include "weft/convert/rasterise.h"
#include "weft/convert/sample.h"
#include "weft/convert/sliding_samples.h"
#include "weft/core/disjoint_sets.h"
#include "weft/mesh/crossings.h"

namespace weft {
namespace {

/// Samples that slide lie within this many rows and columns of a reversed triangle: one that faces
/// away from the surface's normals at its corners.
constexpr int reach = 3;
/// Times that the samples of a spot are moved. Each time they slide over the surface as it is bent,
/// and quads choose their diagonals anew.
constexpr int max_moves = 6;
/// Of samples' old places from the new triangles, and of those triangles' middles from the surface,
/// in spacings, unless it was more before: fingers and ears are to keep their tips, and no triangle
/// is to bridge an armpit.
constexpr PatchDeviation max_deviation{0.9, 0.15};

/// An attempt at spots of at most so many samples. Larger ones are limbs that are sampled too
/// coarsely: nothing unfolds those beyond the first limit, and between both many steps unfolded
/// none that few did not.
struct Attempt {
  PatchUnfolding::Attempt unfolding;
  std::size_t max_samples;
};
/// Of each spot the best is kept.
constexpr std::array attempts{Attempt{{false, 60}, 1024}, Attempt{{false, 600}, 512},
                              Attempt{{true, 600}, 512}};
constexpr std::size_t max_samples = attempts[0].max_samples;

/// The right-angled corner of a triangle of the grid comes first.
Triangle from_right_angle(const Triangle& t, int n) {
  const auto in_line = [&](int a, int b) { return a / n == b / n || a % n == b % n; };
  for (int k = 0; k < 3; ++k) {
    const int own = t[k], next = t[(k + 1) % 3], last = t[(k + 2) % 3];
    if (in_line(own, next) && in_line(own, last)) return {own, next, last};
  }
  return t;
}

/// Samples that slide together.
struct Spot {
  /// Of its samples, with the triangles that touch it.
  struct State {
    std::vector<SurfaceSample> samples{};
    int reversed = 0;  // triangles
    PatchDeviation deviation{};
    int crossings = 0;  // pairs of triangles that cross of which one touches it
    [[nodiscard]] bool is_unfolded() const { return reversed == 0 && crossings == 0; }
    [[nodiscard]] bool is_better_than(const State& other) const {
      return reversed <= other.reversed && crossings <= other.crossings &&
             reversed + crossings < other.reversed + other.crossings;
    }
  };
  std::vector<int> samples{};
  std::vector<Triangle> triangles{};  // that touch it now
  State before{}, best{}, tried{};
  bool goes_on = true;  // the last move did some good
};

class Unfolding {
 public:
  /// @param progress  may be null
  Unfolding(const MappedDisk& mapped, Progress* progress);

  [[nodiscard]] bool has_spots() const { return !spots_.empty(); }
  void run();
  [[nodiscard]] std::vector<Vec2d> places() const;

 private:
  [[nodiscard]] bool is_inside(int s) const {
    return s / n_ > 0 && s / n_ < size_.rows - 1 && s % n_ > 0 && s % n_ < size_.cols - 1;
  }
  [[nodiscard]] Corners corners(const Triangle& t) const {
    return {samples_[t[0]].position, samples_[t[1]].position, samples_[t[2]].position};
  }
  [[nodiscard]] Vec3d middle_of(const Triangle& t) const {
    const auto [a, b, c] = corners(t);
    return (1.0 / 3) * (a + b + c);
  }
  [[nodiscard]] Vec3d area_of(const Triangle& t) const {
    const auto [a, b, c] = corners(t);
    return 0.5 * cross(b - a, c - a);
  }
  [[nodiscard]] bool is_reversed(const Triangle& t) const {
    return dot(area_of(t), samples_[t[0]].normal + samples_[t[1]].normal + samples_[t[2]].normal) <
           0;
  }
  [[nodiscard]] int count_reversed(const Spot& spot) const {
    return static_cast<int>(std::count_if(spot.triangles.begin(), spot.triangles.end(),
                                          [&](const Triangle& t) { return is_reversed(t); }));
  }
  /// The spot that a triangle touches; spots are too far apart to share one. -1: none
  [[nodiscard]] int spot_of(const Triangle& t) const {
    return std::max({spot_of_[t[0]], spot_of_[t[1]], spot_of_[t[2]]});
  }
  [[nodiscard]] std::vector<SurfaceSample> samples_of(const Spot& spot) const {
    std::vector<SurfaceSample> samples;
    for (const int s : spot.samples) samples.push_back(samples_[s]);
    return samples;
  }
  void put(const Spot& spot, const Spot::State& state) {
    for (std::size_t k = 0; k < spot.samples.size(); ++k)
      samples_[spot.samples[k]] = state.samples[k];
  }

  [[nodiscard]] std::vector<char> marked_around_reversed() const;
  void find_spots();
  void choose_triangles();
  /// Tries to unfold all spots that still are not.
  void try_again(const Attempt& attempt, const SlidingSurface& surface, Progress& progress);
  void slide(const Spot& spot, const PatchUnfolding::Attempt& attempt,
             const SlidingSurface& surface);
  void keep_if_less_reversed(Spot& spot, const SlidingSurface& surface);
  [[nodiscard]] std::vector<int> triangles_near_spots() const;
  void count_crossings(Spot::State Spot::*state);
  [[nodiscard]] PatchDeviation deviation_of(const Spot& spot, const SlidingSurface& surface) const;

  Progress* progress_;
  ChartSize size_;
  GeometryImage image_;
  int n_;
  const MappedDisk& mapped_;
  std::vector<Triangle> triangles_;
  std::vector<SurfaceSample> samples_;  // [n * n]
  std::vector<Spot> spots_;
  std::vector<int> spot_of_;  // [n * n] of samples that slide; -1: none
};

Unfolding::Unfolding(const MappedDisk& mapped, Progress* progress)
    : progress_(progress),
      size_(mapped.map.size),
      image_(sample_image(mapped)),
      n_(image_.size()),
      mapped_(mapped),
      triangles_(grid_triangles(image_)) {
  const NormalMap normals = sample_normals(mapped, size_);
  for (int s = 0; s < n_ * n_; ++s) {
    const int row = s / n_, col = s % n_;
    samples_.push_back({image_.world.to_world(image_.cube.at(s)),
                        vec_cast<double>(normals.normal.at(s)),
                        {static_cast<double>(col), static_cast<double>(row)}});
  }
  find_spots();
}

std::vector<char> Unfolding::marked_around_reversed() const {
  std::vector<char> marked(samples_.size(), 0);
  const auto mark = [&](int s) {
    for (int r = std::max(0, s / n_ - reach); r <= std::min(size_.rows - 1, s / n_ + reach); ++r)
      for (int c = std::max(0, s % n_ - reach); c <= std::min(size_.cols - 1, s % n_ + reach); ++c)
        marked[r * n_ + c] = 1;
  };
  for (const Triangle& t : triangles_)
    if (is_reversed(t)) std::for_each(t.begin(), t.end(), mark);
  return marked;
}

/// Spots are connected regions of marked samples.
void Unfolding::find_spots() {
  const std::vector<char> marked = marked_around_reversed();
  DisjointSets sets(n_ * n_);
  for (int s = 0; s < n_ * n_; ++s)
    for (const int next : {s - n_ - 1, s - n_, s - n_ + 1, s - 1})
      if (marked[s] != 0 && next >= 0 && std::abs(s % n_ - next % n_) <= 1 && marked[next] != 0)
        sets.join(s, next);
  std::vector<std::vector<int>> regions(samples_.size());
  for (int s = 0; s < n_ * n_; ++s)
    if (marked[s] != 0 && is_inside(s)) regions[sets.root(s)].push_back(s);
  spot_of_.assign(samples_.size(), -1);
  for (std::vector<int>& region : regions) {
    if (region.empty() || region.size() > max_samples) continue;
    for (const int s : region) spot_of_[s] = static_cast<int>(spots_.size());
    spots_.push_back({std::move(region)});
  }
  choose_triangles();
  for (Spot& spot : spots_) spot.before = {samples_of(spot), count_reversed(spot)};
}

void Unfolding::choose_triangles() {
  for (Spot& spot : spots_) {
    spot.triangles.clear();
    for (const int s : spot.samples)
      image_.cube.set(s, to_cube(image_.world, samples_[s].position));
  }
  triangles_ = grid_triangles(image_);
  for (const Triangle& t : triangles_)
    if (const int spot = spot_of(t); spot >= 0) spots_[spot].triangles.push_back(t);
}

bool is_allowed(const PatchDeviation& now, const PatchDeviation& before) {
  return now.largest <= std::max(max_deviation.largest, before.largest) &&
         now.rms <= std::max(max_deviation.rms, before.rms);
}

/// Whether the last attempt at a spot, if there was one, left no more than three quarters of its
/// reversed triangles.
bool is_promising(const Spot& spot) {
  return spot.tried.samples.empty() || 4 * spot.tried.reversed <= 3 * spot.before.reversed;
}

void Unfolding::run() {
  const SlidingSurface surface(mapped_);
  count_crossings(&Spot::before);
  for (Spot& spot : spots_) {
    spot.before.deviation = deviation_of(spot, surface);
    spot.best = spot.before;
  }
  for (std::size_t k = 0; k < attempts.size(); ++k) {
    const double all = attempts.size();
    PartOfProgress part(progress_, "unfold", k / all, (k + 1) / all);
    try_again(attempts[k], surface, part);
  }
}

void Unfolding::try_again(const Attempt& attempt, const SlidingSurface& surface,
                          Progress& progress) {
  PatchUnfolding::Attempt next = attempt.unfolding;
  for (Spot& spot : spots_) {
    spot.goes_on = !spot.best.is_unfolded() && is_promising(spot) &&
                   spot.samples.size() <= attempt.max_samples;
    spot.tried = spot.goes_on ? spot.before : spot.best;
    put(spot, spot.tried);
  }
  choose_triangles();
  for (int move = 0; move < max_moves; ++move) {
    for (std::size_t k = 0; k < spots_.size(); ++k) {
      if (!spots_[k].goes_on) continue;
      progress.update("", (move + static_cast<double>(k) / spots_.size()) / max_moves);
      slide(spots_[k], next, surface);
    }
    next.from_smooth = false;
    choose_triangles();
    for (Spot& spot : spots_) keep_if_less_reversed(spot, surface);
  }
  for (const Spot& spot : spots_) put(spot, spot.tried);
  choose_triangles();
  count_crossings(&Spot::tried);
  for (Spot& spot : spots_) {
    if (spot.tried.is_better_than(spot.best)) spot.best = spot.tried;
    put(spot, spot.best);
  }
}

void Unfolding::slide(const Spot& spot, const PatchUnfolding::Attempt& attempt,
                      const SlidingSurface& surface) {
  std::vector<int> number(samples_.size(), -1), own;
  std::vector<PatchUnfolding::Point> points;
  std::vector<Triangle> patch;
  std::vector<PlaneAt> feet;
  for (const Triangle& t : spot.triangles) {
    feet.push_back(surface.foot(middle_of(t)));
    patch.push_back(from_right_angle(t, n_));
    for (int& s : patch.back()) {
      if (number[s] < 0) {
        number[s] = static_cast<int>(points.size());
        own.push_back(s);
        points.push_back({samples_[s].position, samples_[s].normal, spot_of_[s] >= 0});
      }
      s = number[s];
    }
  }
  const std::vector<Vec3d> displacements = PatchUnfolding(points, patch, feet).find(attempt);
  for (std::size_t k = 0; k < own.size(); ++k)
    if (points[k].moves)
      samples_[own[k]] =
          surface.moved(samples_[own[k]], displacements[k]).value_or(samples_[own[k]]);
}

void Unfolding::keep_if_less_reversed(Spot& spot, const SlidingSurface& surface) {
  if (!spot.goes_on) return;
  const int reversed = count_reversed(spot);
  const bool better = reversed < spot.tried.reversed;
  if (better) {
    const PatchDeviation deviation = deviation_of(spot, surface);
    if (is_allowed(deviation, spot.before.deviation))
      spot.tried = {samples_of(spot), reversed, deviation};
  }
  spot.goes_on = better && reversed > 0;
}

std::vector<int> Unfolding::triangles_near_spots() const {
  std::vector<Box3d> boxes;
  for (const Spot& spot : spots_) {
    boxes.emplace_back();
    for (const Triangle& t : spot.triangles)
      for (const Vec3d corner : corners(t)) boxes.back().add(corner);
  }
  std::vector<int> near;
  for (int k = 0; k < static_cast<int>(triangles_.size()); ++k) {
    Box3d own;
    for (const Vec3d corner : corners(triangles_[k])) own.add(corner);
    if (std::any_of(boxes.begin(), boxes.end(),
                    [&](const Box3d& box) { return overlap(box, own); }))
      near.push_back(k);
  }
  return near;
}

/// Counts for each spot the pairs of triangles that cross of which one touches it. Tests are exact,
/// which takes long where many triangles lie in one plane, so only those near spots are looked at.
void Unfolding::count_crossings(Spot::State Spot::*state) {
  const std::vector<int> near = triangles_near_spots();
  std::vector<Corners> surface;
  std::vector<Triangle> joined;
  for (const int k : near) {
    const Triangle& t = triangles_[k];
    surface.push_back(corners(t));
    const auto point = [&](int s) { return image_.mates.representative(s); };
    joined.push_back({point(t[0]), point(t[1]), point(t[2])});
  }
  for (Spot& spot : spots_) (spot.*state).crossings = 0;
  for_self_crossings(surface, Neighbours(joined), [&](int a, int b) {
    const int first = spot_of(triangles_[near[a]]), second = spot_of(triangles_[near[b]]);
    if (first >= 0) ++(spots_[first].*state).crossings;
    if (second >= 0 && second != first) ++(spots_[second].*state).crossings;
  });
}

PatchDeviation Unfolding::deviation_of(const Spot& spot, const SlidingSurface& surface) const {
  std::vector<Corners> triangles;
  for (const Triangle& t : spot.triangles) triangles.push_back(corners(t));
  return PatchDeviation::of(triangles, spot.before.samples, surface);
}

std::vector<Vec2d> Unfolding::places() const {
  std::vector<Vec2d> places;
  for (int row = 0; row < size_.rows; ++row)
    for (int col = 0; col < size_.cols; ++col) places.push_back(samples_[row * n_ + col].place);
  return places;
}

}  // namespace

std::vector<Vec2d> unfolded_places(const MappedDisk& mapped, Progress* progress) {
  Unfolding unfolding(mapped, progress);
  if (!unfolding.has_spots()) return {};
  unfolding.run();
  return unfolding.places();
}

}  // namespace weft
