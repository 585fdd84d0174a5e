// What finds the cells of surfaces that may meet: the colliders' broad phases and the bounding
// volumes of the paper's survey, on moments of running scenes, by the pairs that they leave and the
// time that they take.
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/bounding_volumes.h"
#include "bench/command_line.h"
#include "weft/cloth/cloth.h"
#include "weft/collide/baselines/image_space_pairs.h"
#include "weft/collide/baselines/spatial_hash.h"
#include "weft/collide/baselines/sphere_tree.h"
#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/pyramid_pairs.h"
#include "weft/error.h"
#include "weft/scene_file.h"
#include "weft/simulation.h"

namespace weft::bench {
namespace {

constexpr int rounds = 5;
/// What is near, and how far samples may leave their paths, in parts of the cloth's thickness.
constexpr double reach_in_gaps = 1.5, slack_in_gaps = 0.2;

/// All surfaces of a scene in the step after a frame: cloths, then bodies.
struct Moment {
  Moment(const Simulation& simulation, double step_seconds) {
    const double step = step_seconds;
    for (const SimulatedCloth& cloth : simulation.cloths()) {
      grids.emplace_back(cloth.image.size(), cloth.image.mates, choose_diagonals(cloth.image));
      starts.push_back(cloth.state.position);
      ends.push_back(cloth.state.position);
      for (int s = 0; s < cloth.image.size() * cloth.image.size(); ++s)
        ends.back().set(s, vec_cast<float>(vec_cast<double>(cloth.state.position.at(s)) +
                                           step * vec_cast<double>(cloth.state.velocity.at(s))));
      gap = std::min(gap, cloth.model->material.thickness);
    }
    cloths = grids.size();
    for (const PlacedBody& body : simulation.bodies()) {
      grids.emplace_back(body.image.size(), body.image.mates, choose_diagonals(body.image));
      starts.push_back(body.positions);
      ends.push_back(body.positions);
    }
    for (std::size_t i = 0; i < grids.size(); ++i)
      surfaces.push_back({&grids[i], &starts[i], &ends[i]});
  }
  /// Calls visit(a, b) for all pairs of surfaces that are looked at.
  template <class Visit>
  void for_pairs(const Visit& visit) const {
    for (int a = 0; a < static_cast<int>(cloths); ++a)
      for (int b = a; b < static_cast<int>(surfaces.size()); ++b) visit(a, b);
  }
  [[nodiscard]] float reach() const { return static_cast<float>(reach_in_gaps * gap); }
  [[nodiscard]] float slack() const { return static_cast<float>(slack_in_gaps * gap); }

  std::vector<SurfaceGrid> grids;
  std::vector<Planes3> starts, ends;
  std::vector<MovingSurface> surfaces;
  std::size_t cloths = 0;
  double gap = HUGE_VAL;
};

struct Result {
  std::size_t pairs = 0, near = 0, tests = 0;
  double fit_ms = HUGE_VAL, find_ms = HUGE_VAL;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

std::size_t count_pairs(const std::vector<CandidateTile>& found) {
  std::size_t count = 0;
  for (const CandidateTile& one : found) count += std::popcount(one.cells);
  return count;
}

CellTiles tiles_of(const MovingSurface& surface) {
  ThreadTeam alone(1);
  CellTiles tiles(*surface.grid);
  tiles.take(surface);
  tiles.fit(alone);
  return tiles;
}

/// Those whose cells come as near as was asked, by the narrow phase's first test.
std::size_t count_near(const Moment& moment, int a, int b,
                       const std::vector<CandidateTile>& found) {
  const CellTiles of_a = tiles_of(moment.surfaces[a]), of_b = tiles_of(moment.surfaces[b]);
  const CollideKernels& kernels = collide_kernels_for(InstructionSet::baseline);
  std::size_t near = 0;
  for (const CandidateTile& one : found) {
    std::array<float, tile_cells> gaps;
    kernels.tile_gaps(of_a.cell(one.row_a, one.col_a), of_b.tile(of_b.tiling().tile_b(one)), 0, 0,
                      gaps.data());
    for_lanes(one.cells, [&](int lane) { near += gaps[lane] < moment.reach() ? 1 : 0; });
  }
  return near;
}

template <class Pairs>
Result measure_phase(const Moment& moment) {
  std::vector<const SurfaceGrid*> grids;
  for (const SurfaceGrid& grid : moment.grids) grids.push_back(&grid);
  Pairs phase(grids, moment.cloths);
  ThreadTeam alone(1);
  std::vector<CandidateTile> found;
  Result result;
  for (int round = 0; round < rounds; ++round) {
    auto start = std::chrono::steady_clock::now();
    phase.refit(moment.surfaces, alone);
    result.fit_ms = std::min(result.fit_ms, milliseconds_since(start));
    double find_ms = 0;
    result.pairs = 0;
    moment.for_pairs([&](int a, int b) {
      found.clear();
      start = std::chrono::steady_clock::now();
      if (a == b)
        phase.find_self(a, moment.reach(), moment.slack(), alone, found);
      else
        phase.find(a, b, moment.reach(), alone, found);
      find_ms += milliseconds_since(start);
      result.pairs += count_pairs(found);
      if (round == 0) result.near += count_near(moment, a, b, found);
    });
    result.find_ms = std::min(result.find_ms, find_ms);
  }
  return result;
}

/// Goes down both hierarchies in turn, the larger first, as those of the survey do.
template <class Volume>
struct NonlinearPcg {
  const VolumeLevels<Volume>&a, &b;
  float reach;
  bool same;
  std::size_t& tests;

  template <class Emit>
  void go(const Node& first, const Node& second, const Emit& emit) const {
    const bool one = same && first == second;
    if (!one) {
      ++tests;
      if (a.at(first).gap_to(b.at(second)) > reach) return;
      if (first.level == 0 && second.level == 0) return emit(first, second);
    } else if (first.level == 0) {
      return;
    }
    if (one) {
      for_children(first, a.sides(), [&](const Node& p) {
        for_children(first, a.sides(), [&](const Node& q) {
          if (p.row < q.row || (p.row == q.row && p.col <= q.col)) go(p, q, emit);
        });
      });
    } else if (first.level >= second.level) {
      for_children(first, a.sides(), [&](const Node& child) { go(child, second, emit); });
    } else {
      for_children(second, b.sides(), [&](const Node& child) { go(first, child, emit); });
    }
  }
};

template <class Volume>
Result measure_volumes(const Moment& moment) {
  Result result;
  ThreadTeam alone(1);
  for (int round = 0; round < rounds; ++round) {
    auto start = std::chrono::steady_clock::now();
    std::vector<VolumeLevels<Volume>> levels;
    for (const MovingSurface& surface : moment.surfaces) levels.emplace_back(surface);
    result.fit_ms = std::min(result.fit_ms, milliseconds_since(start));
    start = std::chrono::steady_clock::now();
    result.pairs = result.tests = 0;
    moment.for_pairs([&](int a, int b) {
      UnfoldedWindows folds(moment.grids[a].cells());
      if (a == b) folds.find_unfolded(moment.surfaces[a], moment.slack(), alone);
      const int cells = moment.grids[a].cells();
      const NonlinearPcg<Volume> descent{levels[a], levels[b], moment.reach(), a == b,
                                         result.tests};
      descent.go(levels[a].root(), levels[b].root(), [&](const Node& p, const Node& q) {
        const auto [first, second] = std::minmax({p.row * cells + p.col, q.row * cells + q.col});
        if (a != b || !folds.unfolded(CandidatePair{first, second})) ++result.pairs;
      });
    });
    result.find_ms = std::min(result.find_ms, milliseconds_since(start));
  }
  return result;
}

void print_row(const std::string& scene, const char* name, const Result& result) {
  fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} |\n", scene, name, result.pairs,
             result.tests > 0 ? fmt::format("{}", result.tests) : "", result.fit_ms,
             result.find_ms);
  std::fflush(stdout);
}

void measure_scene(const std::string& file, int frames, int size) {
  Scene scene = read_scene(file);
  for (SceneCloth& cloth : scene.cloths) cloth.size = size;
  Simulation simulation(scene, file, 2);
  for (int i = 0; i < frames; ++i) simulation.advance();
  const Moment moment(simulation, 1 / (scene.frame_rate * scene.substeps));
  const std::string name = std::filesystem::path(file).stem().string();
  const Result pyramid = measure_phase<PyramidPairs>(moment);
  fmt::print("| {} | come that near | {} | | | |\n", name, pyramid.near);
  print_row(name, "`pyramid`", pyramid);
  print_row(name, "`sphere_tree`", measure_phase<SphereTreePairs>(moment));
  print_row(name, "`spatial_hash`", measure_phase<SpatialHashPairs>(moment));
  print_row(name, "`image_space`", measure_phase<ImageSpacePairs>(moment));
  print_row(name, "spheres", measure_volumes<Sphere>(moment));
  print_row(name, "boxes along the axes", measure_volumes<DiscreteOriented<3>>(moment));
  print_row(name, "18-DOPs", measure_volumes<DiscreteOriented<9>>(moment));
  print_row(name, "26-DOPs", measure_volumes<DiscreteOriented<13>>(moment));
  print_row(name, "oriented boxes", measure_volumes<Oriented>(moment));
}

void measure(const std::vector<std::string>& files, int frames, int size) {
  fmt::print("Cloths of {0} x {0} samples, after frame {1}; one thread.\n\n", size, frames);
  fmt::print(
      "| scene | by | pairs of cells | tests of volumes | fit ms | find ms |\n"
      "|---|---|---|---|---|---|\n");
  for (const std::string& file : files) measure_scene(file, frames, size);
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  std::vector<std::string> files;
  int frames = 60, size = 129;
  weft::bench::CommandLine words{
      "What finds pairs of cells that may meet, by what is left and what it costs."};
  words.add("scenes", &files, "Scene files");
  words.add("--frames", &frames, "After so many");
  words.add("--size", &size, "Samples a side of cloths");
  return words.run(argc, argv, [&] { weft::bench::measure(files, frames, size); });
}
