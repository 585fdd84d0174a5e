#include "weft/param/square_map.h"

#include <vector>

#include <fmt/format.h>

#include "weft/core/orientation.h"
#include "weft/error.h"
#include "weft/mesh/stretch.h"
#include "weft/param/border_layout.h"
#include "weft/param/chords.h"
#include "weft/param/four_corners.h"
#include "weft/param/interior_map.h"
#include "weft/param/rotation.h"

namespace weft {

namespace {

/// Positions with the border vertices placed and all others at the origin.
std::vector<Vec2d> place_border(const CutDisk& cut, ChartSize size, std::span<const double> t) {
  std::vector<Vec2d> uv(cut.disk.positions.size());
  for (std::size_t b = 0; b < t.size(); ++b) uv[cut.disk.border[b]] = border_point(size, t[b]);
  return uv;
}

/// Corners of the border lie at those of the chart, where it has four: a cloth's rows and columns
/// then run along its sides. The others are laid out by trial maps.
void lay_out(MappedDisk& mapped, const MapOptions& options) {
  LayoutOptions layout{options.size};
  if (const std::optional<std::array<int, 4>> corners = four_corners(mapped.cut))
    mapped.cut = parted_at(*corners, std::move(mapped.cut), options.size);
  else
    layout.rotation = choose_rotation(mapped.cut, {.size = options.size,
                                                   .count = options.rotations,
                                                   .unit = options.rotation_unit,
                                                   .threads = options.threads});
  mapped.layout = lay_out_border(mapped.cut, layout);
}

}  // namespace

MappedDisk map_to_square(CutDisk cut, const MapOptions& options) {
  MappedDisk mapped{
      .cut = std::move(cut), .layout = {}, .map = {}, .quality = {}, .parameterizer = "stretch"};
  if (std::holds_alternative<FloaterOptions>(options.parameterizer))
    mapped.parameterizer = "floater";
  update(options.progress, "map", 0.0);
  lay_out(mapped, options);
  split_at_corners(mapped.cut, mapped.layout);
  split_chords(mapped.cut.disk);

  mapped.map.size = options.size;
  const std::vector<double> t = border_positions(mapped.cut, mapped.layout);
  mapped.map.uv = place_border(mapped.cut, options.size, t);
  const std::vector<BorderFreedom> freedoms = border_freedoms(mapped.cut, mapped.layout, t);
  const bool found = map_interior(
      mapped.cut.disk, mapped.map.uv, options.parameterizer,
      {.freedoms = freedoms, .threads = options.threads, .progress = options.progress});
  mapped.quality = measure_map(mapped.cut.disk, mapped.map);
  if (!found)
    throw TopologyError(options.name,
                        fmt::format("no valid map was found: {} triangles flipped, {} without area",
                                    mapped.quality.flipped, mapped.quality.degenerate),
                        "a mesh with fewer or better shaped triangles is wanted");
  update(options.progress, "map", 1.0);
  return mapped;
}

MapQuality measure_map(const DiskMesh& disk, const SquareMap& map) {
  MapQuality quality;
  for (const auto& [a, b, c] : disk.triangles) {
    const int sign = orientation(map.uv[a], map.uv[b], map.uv[c]);
    quality.flipped += sign < 0 ? 1 : 0;
    quality.degenerate += sign == 0 ? 1 : 0;
  }
  const Stretch stretch =
      measure_stretch(surface_triangles(disk.positions, disk.triangles), disk.triangles, map.uv);
  quality.stretch_l2 = stretch.l2;
  quality.stretch_linf = stretch.linf;
  return quality;
}

}  // namespace weft
