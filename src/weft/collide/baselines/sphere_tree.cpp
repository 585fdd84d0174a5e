#include "weft/collide/baselines/sphere_tree.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/contact_pipeline.h"

namespace weft {
namespace {

/// Level of the nodes whose pairs workers share as tasks: 2^3 cells a side.
constexpr int task_level = 3;

/// Against the rounding of roots and sums; radii are rounded up into floats besides.
constexpr double inflation = 1 + 0x1p-40;

/// A radius in single precision that surely holds what lies at distance `farthest`.
float safe_radius(double farthest) {
  return std::nextafter(static_cast<float>(farthest * inflation), HUGE_VALF);
}

double distance(const Vec3f& a, const Vec3f& b) {
  return length(vec_cast<double>(a) - vec_cast<double>(b));
}

bool meet(const SphereLevels::Sphere& a, const SphereLevels::Sphere& b, float reach) {
  if (a.empty() || b.empty()) return false;
  const double radii = (double{a.radius} + b.radius + reach) * inflation;
  return squared_length(vec_cast<double>(a.centre) - vec_cast<double>(b.centre)) <= radii * radii;
}

}  // namespace

SphereLevels::SphereLevels(int cells) : sides_(level_sides(cells)) {
  for (const int side : sides_) levels_.emplace_back(static_cast<std::size_t>(side) * side);
}

void SphereLevels::fit_cell(const MovingSurface& surface, int cell) {
  Box3d box;
  const std::array<int, 4> corners = surface.grid->corners(cell);
  for (const Planes3* planes : {surface.start, surface.end})
    for (const int s : corners) box.add(vec_cast<double>(planes->at(s)));
  Sphere sphere{vec_cast<float>(box.centre())};
  double farthest = 0;
  for (const Planes3* planes : {surface.start, surface.end})
    for (const int s : corners) {
      const double away = distance(sphere.centre, planes->at(s));
      farthest = away <= farthest ? farthest : away;  // keeps a NaN
    }
  if (std::isfinite(farthest)) sphere.radius = safe_radius(farthest);
  levels_.front()[static_cast<std::size_t>(cell)] = sphere;
}

void SphereLevels::fit_node(const Node& node) {
  Box3d box;
  const auto for_spheres = [&](const auto& visit) {
    for_children(node, sides_, [&](const Node& child) {
      if (!at(child).empty()) visit(at(child));
    });
  };
  for_spheres([&](const Sphere& child) {
    const double r = child.radius;
    box.add(vec_cast<double>(child.centre) - Vec3d{r, r, r});
    box.add(vec_cast<double>(child.centre) + Vec3d{r, r, r});
  });
  Sphere sphere{vec_cast<float>(box.centre())};
  double farthest = 0;
  for_spheres([&](const Sphere& child) {
    farthest = std::max(farthest, distance(sphere.centre, child.centre) + child.radius);
  });
  if (!box.empty()) sphere.radius = safe_radius(farthest);
  const auto level = static_cast<std::size_t>(node.level);
  levels_[level][static_cast<std::size_t>(node.row) * sides_[level] + node.col] = sphere;
}

void SphereLevels::fit(const MovingSurface& surface, Worker& worker) {
  const int cells = sides_.front() * sides_.front();
  const Range mine = worker.share(cells);
  for (int cell = mine.first; cell < mine.last; ++cell) fit_cell(surface, cell);
  worker.barrier();
  for (int level = 1; level < static_cast<int>(sides_.size()); ++level) {
    const int side = sides_[static_cast<std::size_t>(level)];
    const Range rows = worker.share(side);
    for (int r = rows.first; r < rows.last; ++r)
      for (int c = 0; c < side; ++c) fit_node({level, r, c});
    worker.barrier();
  }
}

SphereTreePairs::SphereTreePairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths)
    : fitted_to_(grids.size(), 0) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    levels_.emplace_back(grids[i]->cells());
    if (i < cloths) folds_.emplace_back(grids[i]->cells());
  }
}

void SphereTreePairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  surfaces_.assign(surfaces.begin(), surfaces.end());
  team.run([&](Worker& worker) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const int name = surfaces[i].name;
      if (name == 0 || name != fitted_to_[i]) levels_[i].fit(surfaces[i], worker);
    }
  });
  for (std::size_t i = 0; i < surfaces.size(); ++i) fitted_to_[i] = surfaces[i].name;
}

template <class Stop, class Emit>
void SphereTreePairs::descend(const Search& search, const NodePair& pair, const Stop& stop,
                              const Emit& emit) {
  const bool one = search.same && pair.a == pair.b;
  if (!one && !meet(search.a->at(pair.a), search.b->at(pair.b), search.reach)) return;
  if (stop(pair)) return emit(pair);
  if (one) {
    if (pair.a.level == 0) return;  // the two triangles of a cell share an edge
    for_children(pair.a, search.a->sides(), [&](const Node& first) {
      for_children(pair.a, search.a->sides(), [&](const Node& second) {
        if (first.row < second.row || (first.row == second.row && first.col <= second.col))
          descend(search, {first, second}, stop, emit);
      });
    });
  } else if (pair.a.level == 0 && pair.b.level == 0) {
    emit(pair);
  } else if (pair.a.level >= pair.b.level) {
    for_children(pair.a, search.a->sides(), [&](const Node& child) {
      descend(search, {child, pair.b}, stop, emit);
    });
  } else {
    for_children(pair.b, search.b->sides(), [&](const Node& child) {
      descend(search, {pair.a, child}, stop, emit);
    });
  }
}

void SphereTreePairs::gather_tasks(const Search& search) {
  tasks_.clear();
  const Node a = search.a->root(), b = search.b->root();
  const int stop_level = std::min(task_level, a.level);
  descend(
      search, {a, b}, [&](const NodePair& pair) { return pair.a.level <= stop_level; },
      [&](const NodePair& pair) { tasks_.push_back(pair); });
}

void SphereTreePairs::find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                           std::vector<CandidateTile>& out) {
  const Search search{&levels_[static_cast<std::size_t>(surface_a)],
                      &levels_[static_cast<std::size_t>(surface_b)], reach};
  gather_tasks(search);
  const int cells_a = search.a->sides().front(), cells_b = search.b->sides().front();
  shared_.collect(static_cast<int>(tasks_.size()), {Tiling(cells_a), Tiling(cells_b)}, team, out,
                  [&](int task, std::vector<CandidatePair>& mine) {
                    descend(
                        search, tasks_[static_cast<std::size_t>(task)],
                        [](const NodePair&) { return false; },
                        [&](const NodePair& pair) {
                          mine.push_back({pair.a.row * cells_a + pair.a.col,
                                          pair.b.row * cells_b + pair.b.col});
                        });
                  });
}

void SphereTreePairs::find_self(int surface, float reach, float slack, ThreadTeam& team,
                                std::vector<CandidateTile>& out) {
  const SphereLevels& levels = levels_[static_cast<std::size_t>(surface)];
  UnfoldedWindows& folds = folds_[static_cast<std::size_t>(surface)];
  folds.find_unfolded(surfaces_[static_cast<std::size_t>(surface)], slack, team);
  const Search search{&levels, &levels, reach, true};
  gather_tasks(search);
  const int cells = levels.sides().front();
  shared_.collect(
      static_cast<int>(tasks_.size()), {Tiling(cells), Tiling(cells)}, team, out,
      [&](int task, std::vector<CandidatePair>& mine) {
        descend(
            search, tasks_[static_cast<std::size_t>(task)], [](const NodePair&) { return false; },
            [&](const NodePair& pair) {
              const auto [a, b] =
                  std::minmax({pair.a.row * cells + pair.a.col, pair.b.row * cells + pair.b.col});
              if (!folds.unfolded(CandidatePair{a, b})) mine.push_back({a, b});
            });
      });
}

std::unique_ptr<Collider> make_collider_of(const SphereTreeOptions& /*options*/,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths) {
  return make_pipeline<SphereTreePairs>(obstacles, cloths);
}

}  // namespace weft
