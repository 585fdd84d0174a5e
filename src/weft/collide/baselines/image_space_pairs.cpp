#include "weft/collide/baselines/image_space_pairs.h"

#include <algorithm>
#include <cstdlib>

#include "weft/collide/contact_pipeline.h"

namespace weft {
namespace {

/// Level of the blocks: 8 cells a side.
constexpr int block_level = 3;
/// Number of culling passes. Culled blocks uncover others: a few passes find most.
constexpr int max_passes = 4;

/// Common part of two boxes, widened by `reach`.
Box3f common_part(const Box3f& a, const Box3f& b, float reach) {
  const Vec3f aside{reach, reach, reach};
  return {max(a.lower, b.lower) - aside, min(a.upper, b.upper) + aside};
}

}  // namespace

ImageSpacePairs::ImageSpacePairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths)
    : fitted_to_(grids.size(), 0) {
  blocks_.resize(grids.size());
  for (std::size_t i = 0; i < grids.size(); ++i) {
    blocks_[i].boxes = ExtentLevels(grids[i]->cells());
    blocks_[i].level = std::min(block_level, blocks_[i].boxes.top());
    if (i < cloths) folds_.emplace_back(grids[i]->cells());
  }
}

void ImageSpacePairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  surfaces_.assign(surfaces.begin(), surfaces.end());
  team.run([&](Worker& worker) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      if (surfaces[i].name != 0 && surfaces[i].name == fitted_to_[i]) continue;
      fill_position_extents(*surfaces[i].start, *surfaces[i].end, blocks_[i].boxes, worker);
      blocks_[i].boxes.fit(worker);
    }
  });
  for (std::size_t i = 0; i < surfaces.size(); ++i) fitted_to_[i] = surfaces[i].name;
}

/// Whether two blocks are the same, or neighbours that share samples.
bool ImageSpacePairs::touch(const Blocks& of, int block, int other) {
  const int side = of.side();
  return std::abs(block / side - other / side) <= 1 && std::abs(block % side - other % side) <= 1;
}

template <class Visit>
void ImageSpacePairs::for_cells(const Blocks& of, int block, const Visit& visit) {
  const int cells = of.boxes.sides().front(), wide = 1 << of.level;
  const int first_row = block / of.side() * wide, first_col = block % of.side() * wide;
  for (int r = first_row; r < std::min(cells, first_row + wide); ++r)
    for (int c = first_col; c < std::min(cells, first_col + wide); ++c)
      visit(of.boxes.at({0, r, c}), r * cells + c);
}

template <int Layers>
void ImageSpacePairs::draw(const Blocks& of, DepthImage<Layers>& image) {
  for (int block = 0; block < of.count(); ++block)
    if (of.left[block] != 0)
      for_cells(of, block, [&](const Box3f& box, int /*cell*/) { image.draw(box, block); });
}

template <int Layers, class Ignored>
void ImageSpacePairs::mark_seen(const Blocks& of, const DepthImage<Layers>& image, float reach,
                                const Ignored& ignored, Marks& seen) {
  seen.assign(of.left.size(), 0);
  for (int block = 0; block < of.count(); ++block) {
    if (of.left[block] == 0) continue;
    bool before = true;
    for_cells(of, block, [&](const Box3f& box, int /*cell*/) {
      before = before &&
               image.is_before_all(box, reach, [&](int other) { return ignored(block, other); });
    });
    seen[block] = before ? 1 : 0;
  }
}

/// @return whether there was anything to drop
bool ImageSpacePairs::drop(const std::array<Marks, view_count>& seen, Blocks& from) {
  bool any = false;
  for (std::size_t block = 0; block < from.left.size(); ++block) {
    const bool was = from.left[block] != 0;
    for (const Marks& one : seen)
      if (one[block] != 0) from.left[block] = 0;
    any = any || (was && from.left[block] == 0);
  }
  return any;
}

void ImageSpacePairs::cull(Blocks& a, Blocks& b, float reach, ThreadTeam& team) {
  const Box3f window =
      common_part(a.boxes.at({a.boxes.top(), 0, 0}), b.boxes.at({b.boxes.top(), 0, 0}), reach);
  for (Blocks* of : {&a, &b}) {
    of->left.assign(static_cast<std::size_t>(of->count()), 0);
    for (int block = 0; block < of->count(); ++block)
      of->left[block] = overlap(of->box(block), window, reach) ? 1 : 0;
  }
  const auto none = [](int /*block*/, int /*other*/) { return false; };
  for (int turn = 0; turn < max_passes; ++turn) {
    team.run([&](Worker& worker) {
      for (int v = worker.rank(); v < view_count; v += worker.size()) {
        const auto view = static_cast<std::size_t>(v);
        images_a_[view].clear(window, view_direction(v));
        images_b_[view].clear(window, view_direction(v));
        draw(a, images_a_[view]);
        draw(b, images_b_[view]);
        mark_seen(a, images_b_[view], reach, none, seen_a_[view]);
        mark_seen(b, images_a_[view], reach, none, seen_b_[view]);
      }
    });
    const bool fewer_a = drop(seen_a_, a), fewer_b = drop(seen_b_, b);
    if (!fewer_a && !fewer_b) break;
  }
}

void ImageSpacePairs::cull_self(Blocks& of, float reach, ThreadTeam& team) {
  const Box3f window = of.boxes.at({of.boxes.top(), 0, 0});
  of.left.assign(static_cast<std::size_t>(of.count()), 1);
  const auto beside = [&](int block, int other) { return touch(of, block, other); };
  for (int turn = 0; turn < max_passes; ++turn) {
    team.run([&](Worker& worker) {
      for (int v = worker.rank(); v < view_count; v += worker.size()) {
        const auto view = static_cast<std::size_t>(v);
        self_images_[view].clear(window, view_direction(v));
        draw(of, self_images_[view]);
        mark_seen(of, self_images_[view], reach, beside, seen_a_[view]);
      }
    });
    if (!drop(seen_a_, of)) break;
  }
}

void ImageSpacePairs::sort(Blocks& of) {
  of.order.clear();
  for (int block = 0; block < of.count(); ++block)
    if (of.left[block] != 0) of.order.push_back(block);
  std::sort(of.order.begin(), of.order.end(), [&](int p, int q) {
    const float x = of.box(p).lower.x, y = of.box(q).lower.x;
    return x < y || (x == y && p < q);
  });
}

template <class Emit>
void ImageSpacePairs::pair_cells(const Blocks& a, int block_a, const Blocks& b, int block_b,
                                 float reach, const Emit& emit) {
  const Box3f& whole = b.box(block_b);
  if (!overlap(a.box(block_a), whole, reach)) return;
  for_cells(a, block_a, [&](const Box3f& box, int cell) {
    if (!overlap(box, whole, reach)) return;
    for_cells(b, block_b, [&](const Box3f& other, int other_cell) {
      if (overlap(box, other, reach)) emit(CandidatePair{cell, other_cell});
    });
  });
}

void ImageSpacePairs::find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                           std::vector<CandidateTile>& out) {
  Blocks& a = blocks_[static_cast<std::size_t>(surface_a)];
  Blocks& b = blocks_[static_cast<std::size_t>(surface_b)];
  cull(a, b, reach, team);
  sort(b);
  shared_.collect(a.count(), {Tiling(a.boxes.sides().front()), Tiling(b.boxes.sides().front())},
                  team, out, [&](int block, std::vector<CandidatePair>& mine) {
                    if (a.left[block] == 0) return;
                    for (const int other : b.order) {
                      if (b.box(other).lower.x - a.box(block).upper.x > reach) break;
                      pair_cells(a, block, b, other, reach,
                                 [&](const CandidatePair& pair) { mine.push_back(pair); });
                    }
                  });
}

void ImageSpacePairs::find_self(int surface, float reach, float slack, ThreadTeam& team,
                                std::vector<CandidateTile>& out) {
  Blocks& of = blocks_[static_cast<std::size_t>(surface)];
  UnfoldedWindows& folds = folds_[static_cast<std::size_t>(surface)];
  folds.find_unfolded(surfaces_[static_cast<std::size_t>(surface)], slack, team);
  cull_self(of, reach, team);
  sort(of);
  const auto pair_with = [&](int block, int other, std::vector<CandidatePair>& mine) {
    pair_cells(of, block, of, other, reach, [&](const CandidatePair& pair) {
      if (pair.a < pair.b || block != other) {
        const auto [first, second] = std::minmax(pair.a, pair.b);
        if (!folds.unfolded(CandidatePair{first, second})) mine.push_back({first, second});
      }
    });
  };
  const int side = of.side();
  shared_.collect(of.count(), {Tiling(of.boxes.sides().front()), Tiling(of.boxes.sides().front())},
                  team, out, [&](int block, std::vector<CandidatePair>& mine) {
                    // Neighbours, which ignore each other in the images.
                    for (int r = block / side; r <= std::min(side - 1, block / side + 1); ++r)
                      for (int c = std::max(0, block % side - 1);
                           c <= std::min(side - 1, block % side + 1); ++c)
                        if (r * side + c >= block) pair_with(block, r * side + c, mine);
                    if (of.left[block] == 0) return;
                    for (const int other : of.order) {
                      if (of.box(other).lower.x - of.box(block).upper.x > reach) break;
                      if (other > block && !touch(of, block, other)) pair_with(block, other, mine);
                    }
                  });
}

std::unique_ptr<Collider> make_collider_of(const ImageSpaceOptions& /*options*/,
                                           const Obstacles& obstacles,
                                           std::span<const CollidingCloth> cloths) {
  return make_pipeline<ImageSpacePairs>(obstacles, cloths);
}

}  // namespace weft
