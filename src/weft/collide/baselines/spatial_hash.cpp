#include "weft/collide/baselines/spatial_hash.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "weft/collide/contact_pipeline.h"

namespace weft {
namespace {

/// Cells that sweep more cubes than this in a step are kept apart and compared with all others.
constexpr double max_cubes_a_cell = 256;
/// Integer coordinates of cubes are clamped to this.
constexpr double largest_place = 1 << 30;

int place_of(double coordinate, double side) {
  return static_cast<int>(std::clamp(std::floor(coordinate / side), -largest_place, largest_place));
}

bool is_finite(Vec3f p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool is_prime(std::size_t value) {
  for (std::size_t d = 2; d * d <= value; ++d)
    if (value % d == 0) return false;
  return true;
}

/// Tables work best with a prime number of buckets.
std::size_t prime_from(std::size_t value) {
  while (!is_prime(value)) ++value;
  return value;
}

double mean_edge(const MovingSurface& surface) {
  const Planes3& at = *surface.start;
  const int n = at.size();
  double sum = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c + 1 < n; ++c)
      sum += double{length(at.at(r, c + 1) - at.at(r, c))} + length(at.at(c + 1, r) - at.at(c, r));
  return sum / (2.0 * n * (n - 1));
}

}  // namespace

HashedCells::HashedCells(int cells)
    : extents_(cells),
      starts_(prime_from(2 * static_cast<std::size_t>(cells) * cells) + 1),
      next_(starts_.size() - 1) {}

double HashedCells::CubeRange::count() const {
  double product = 1;
  for (std::size_t k = 0; k < 3; ++k) product *= 1.0 + last[k] - first[k];
  return product;
}

HashedCells::CubeRange HashedCells::cubes_of(const Box3f& box, double reach) const {
  if (!is_finite(box.lower) || !is_finite(box.upper)) return {{0, 0, 0}, {-1, -1, -1}};
  const Vec3d lower = vec_cast<double>(box.lower), upper = vec_cast<double>(box.upper);
  return {{place_of(lower.x - reach, side_), place_of(lower.y - reach, side_),
           place_of(lower.z - reach, side_)},
          {place_of(upper.x + reach, side_), place_of(upper.y + reach, side_),
           place_of(upper.z + reach, side_)}};
}

std::size_t HashedCells::bucket(const Cube& cube) const {
  const std::uint32_t hash = static_cast<std::uint32_t>(cube[0]) * 73856093U ^
                             static_cast<std::uint32_t>(cube[1]) * 19349663U ^
                             static_cast<std::uint32_t>(cube[2]) * 83492791U;
  return hash % next_.size();
}

template <class Visit>
void HashedCells::for_cubes(const CubeRange& range, const Visit& visit) {
  for (int i = range.first[0]; i <= range.last[0]; ++i)
    for (int j = range.first[1]; j <= range.last[1]; ++j)
      for (int k = range.first[2]; k <= range.last[2]; ++k) visit(Cube{i, j, k});
}

template <class Visit>
void HashedCells::for_entries(const Visit& visit) const {
  for (int cell = 0; cell < count(); ++cell) {
    const CubeRange range = cubes_of(box(cell), 0);
    if (range.count() > max_cubes_a_cell) continue;
    for_cubes(range, [&](const Cube& cube) { visit(cell, cube); });
  }
}

void HashedCells::choose_side(const MovingSurface& surface) {
  lengths_.clear();
  for (int cell = 0; cell < count(); ++cell) {
    const float length = longest_side(box(cell));
    if (std::isfinite(length)) lengths_.push_back(length);
  }
  // Cubes are at least as large as the median extent of the cells' boxes over the step, so that
  // cells do not sweep many of them.
  double median = 0;
  if (!lengths_.empty()) {
    const auto middle = lengths_.begin() + static_cast<std::ptrdiff_t>(lengths_.size() / 2);
    std::nth_element(lengths_.begin(), middle, lengths_.end());
    median = *middle;
  }
  const double edge = mean_edge(surface);
  side_ = std::max({std::isfinite(edge) ? edge : 0, median, 1e-30});
}

void HashedCells::fill_table() {
  std::fill(starts_.begin(), starts_.end(), 0);
  for_entries([&](int /*cell*/, const Cube& cube) { ++starts_[bucket(cube) + 1]; });
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::copy(starts_.begin(), starts_.end() - 1, next_.begin());
  entries_.resize(starts_.back());
  for_entries([&](int cell, const Cube& cube) { entries_[next_[bucket(cube)]++] = {cube, cell}; });
  large_.clear();
  for (int cell = 0; cell < count(); ++cell)
    if (cubes_of(box(cell), 0).count() > max_cubes_a_cell) large_.push_back(cell);
}

void HashedCells::fit(const MovingSurface& surface, ThreadTeam& team) {
  team.run([&](Worker& worker) {
    fill_position_extents(*surface.start, *surface.end, extents_, worker);
    extents_.fit(worker);
  });
  choose_side(surface);
  fill_table();
}

template <class Visit>
void HashedCells::for_near(const Box3f& other, float reach, const Visit& visit) const {
  const CubeRange range = cubes_of(other, reach);
  const auto near = [&](int cell) { return overlap(other, box(cell), reach); };
  if (range.count() > max_cubes_a_cell) {
    for (int cell = 0; cell < count(); ++cell)
      if (near(cell)) visit(cell);
    return;
  }
  for (const int cell : large_)
    if (near(cell)) visit(cell);
  for_cubes(range, [&](const Cube& cube) {
    const std::size_t in = bucket(cube);
    for (std::size_t i = starts_[in]; i < starts_[in + 1]; ++i) {
      const Entry& entry = entries_[i];
      if (entry.cube != cube || !near(entry.cell)) continue;
      // Two boxes may share many cubes: the pair is visited in the first of them.
      const CubeRange its = cubes_of(box(entry.cell), 0);
      bool first = true;
      for (std::size_t k = 0; k < 3; ++k)
        first = first && cube[k] == std::max(range.first[k], its.first[k]);
      if (first) visit(entry.cell);
    }
  });
}

SpatialHashPairs::SpatialHashPairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths)
    : fitted_to_(grids.size(), 0) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    tables_.emplace_back(grids[i]->cells());
    if (i < cloths) folds_.emplace_back(grids[i]->cells());
  }
}

void SpatialHashPairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const int name = surfaces[i].name;
    if (name == 0 || name != fitted_to_[i]) tables_[i].fit(surfaces[i], team);
    fitted_to_[i] = name;
  }
  surfaces_.assign(surfaces.begin(), surfaces.end());
}

void SpatialHashPairs::find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                            std::vector<CandidateTile>& out) {
  const HashedCells& a = tables_[static_cast<std::size_t>(surface_a)];
  const HashedCells& b = tables_[static_cast<std::size_t>(surface_b)];
  // Cells of the table with smaller cubes look up the one with larger cubes, as they take fewer of
  // these each.
  const bool swapped = a.side() > b.side();
  const HashedCells &small = swapped ? b : a, &large = swapped ? a : b;
  const auto tiling_of = [&](int surface) {
    return Tiling(surfaces_[static_cast<std::size_t>(surface)].grid->cells());
  };
  shared_.collect(
      small.count(), {tiling_of(surface_a), tiling_of(surface_b)}, team, out,
      [&](int cell, std::vector<CandidatePair>& mine) {
        large.for_near(small.box(cell), reach, [&](int other) {
          mine.push_back(swapped ? CandidatePair{other, cell} : CandidatePair{cell, other});
        });
      });
}

void SpatialHashPairs::find_self(int surface, float reach, float slack, ThreadTeam& team,
                                 std::vector<CandidateTile>& out) {
  const HashedCells& table = tables_[static_cast<std::size_t>(surface)];
  UnfoldedWindows& folds = folds_[static_cast<std::size_t>(surface)];
  folds.find_unfolded(surfaces_[static_cast<std::size_t>(surface)], slack, team);
  const Tiling tiling(surfaces_[static_cast<std::size_t>(surface)].grid->cells());
  shared_.collect(table.count(), {tiling, tiling}, team, out,
                  [&](int cell, std::vector<CandidatePair>& mine) {
                    table.for_near(table.box(cell), reach, [&](int other) {
                      if (cell < other && !folds.unfolded(CandidatePair{cell, other}))
                        mine.push_back({cell, other});
                    });
                  });
}

std::unique_ptr<Collider> make_collider_of(const SpatialHashOptions& /*options*/,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths) {
  return make_pipeline<SpatialHashPairs>(obstacles, cloths);
}

}  // namespace weft
