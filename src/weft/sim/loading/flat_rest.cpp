#include "weft/sim/loading/flat_rest.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/garment.h"

namespace weft {
namespace {

/// Parts of the mean area of a triangle below which one has none: in the texture, where the
/// surface has some.
constexpr double no_texture = 1e-9, some_surface = 1e-6;

/// Coordinates that differ by less, in parts of the texture's extent, are the same.
constexpr double same_place = 1e-5;

struct Areas {
  double surface = 0, texture = 0;  // [m^2], [units^2]
};

Areas areas_of(const SourceMesh& mesh, const PlacementMap& placement, const Triangle& corners) {
  std::array<Vec3d, 3> p;
  std::array<Vec2d, 3> uv;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto place = static_cast<std::size_t>(corners[k]);
    p[k] = placement.point(mesh.positions[mesh.faces.corners[place]]);
    const Vec2f corner = mesh.faces.texture[mesh.faces.texture_corners[place]];
    uv[k] = {corner.x, corner.y};
  }
  const Vec2d a = uv[1] - uv[0], b = uv[2] - uv[0];
  return {0.5 * length(cross(p[1] - p[0], p[2] - p[0])), 0.5 * std::abs(a.x * b.y - a.y * b.x)};
}

/// @throws SceneError for triangles without area in the texture
Areas total_areas(const SourceMesh& mesh, const PlacementMap& placement) {
  WEFT_ASSERT(mesh.faces.has_texture());
  std::vector<Areas> all;
  Areas total;
  for (const Triangle& corners : fans_of(mesh.faces).places) {
    all.push_back(areas_of(mesh, placement, corners));
    total.surface += all.back().surface;
    total.texture += all.back().texture;
  }
  const auto count = static_cast<double>(all.size());
  const auto flat = std::count_if(all.begin(), all.end(), [&](const Areas& area) {
    return area.surface * count > some_surface * total.surface &&
           area.texture * count <= no_texture * total.texture;
  });
  if (flat > 0)
    throw SceneError(
        "rest", fmt::format("{} of {} triangles have no area in the texture", flat, all.size()),
        "texture coordinates that lay the whole mesh flat are wanted");
  return total;
}

/// Lays each chart round its own middle, where floats are finest.
Planes3 lay_flat(const BorderMates& mates, const Planes3& texture, double scale) {
  const int n = texture.size();
  const std::size_t charts = std::max<std::size_t>(1, mates.charts().size());
  const auto chart_at = [&](int s) { return mates.chart_of().empty() ? 0 : mates.chart_of()[s]; };
  std::vector<Vec2d> middle(charts);
  std::vector<int> counts(charts);
  for (int s = 0; s < n * n; ++s) {
    if (mates.is_hole(s)) continue;
    const Vec3d uv = vec_cast<double>(texture.at(s));
    middle[chart_at(s)] = middle[chart_at(s)] + Vec2d{uv.x, uv.y};
    ++counts[chart_at(s)];
  }
  Planes3 rest(n);
  for (int s = 0; s < n * n; ++s) {
    // A hole lies where the sample is that shelters it.
    const int at = mates.is_hole(s) ? mates.representative(s) : s;
    const int chart = chart_at(at);
    const Vec3d uv = vec_cast<double>(texture.at(at));
    const Vec2d place = scale * (Vec2d{uv.x, uv.y} - (1.0 / counts[chart]) * middle[chart]);
    rest.set(s, {static_cast<float>(place.x), static_cast<float>(place.y),
                 flat_distance * static_cast<float>(chart)});
  }
  return rest;
}

double extent_of(const Planes3& rest) {
  const Box3d box = box_of(rest);
  return std::max(box.upper.x - box.lower.x, box.upper.y - box.lower.y);
}

/// The runs of mates that lie at the same places of one island, as on both sides of a cut through
/// it.
BorderMates mates_in_islands(const BorderMates& mates, const Planes3& rest) {
  const double hair = same_place * extent_of(rest);
  std::vector<MateInterval> kept;
  for (const MateInterval& run : mates.intervals()) {
    bool same = true;
    for (int k = 0; k <= run.count; ++k) {
      const int a = mates.sample_at(mates.along_border(run.first, k));
      const int b = mates.sample_at(mates.along_border(run.mate, run.turned ? k : -k));
      same = same && length(vec_cast<double>(rest.at(a) - rest.at(b))) <= hair;
    }
    if (same) kept.push_back(run);
  }
  if (mates.chart_of().empty()) return {mates.size(), std::move(kept)};
  return {mates.size(), mates.charts(), std::move(kept)};
}

}  // namespace

Planes3 even_warp(int size, Vec3f direction) {
  Planes3 warp(size);
  for (int s = 0; s < size * size; ++s) warp.set(s, direction);
  return warp;
}

FlatRest flat_rest(const LoadedSurface& loaded, const PlacementMap& placement,
                   const TextureRest& wanted) {
  WEFT_ASSERT(loaded.source && loaded.texture);
  const Areas areas = total_areas(*loaded.source, placement);
  FlatRest flat;
  flat.scale = wanted.scale.value_or(std::sqrt(areas.surface / areas.texture));
  flat.rest = lay_flat(loaded.image.mates, *loaded.texture, flat.scale);
  flat.warp = even_warp(flat.rest.size(), {1, 0, 0});
  flat.bent = mates_in_islands(loaded.image.mates, flat.rest);
  return flat;
}

}  // namespace weft
