#include "weft/param/square_map.h"

#include <algorithm>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/param/chords.h"
#include "weft/param/interior_map.h"
#include "weft/param/rotation.h"

namespace weft {
namespace {

/// Border vertices placed, all others at the origin.
std::vector<Vec2d> place_border(const CutDisk& cut, int size, std::span<const double> t) {
  std::vector<Vec2d> uv(cut.disk.positions.size());
  for (std::size_t b = 0; b < t.size(); ++b) uv[cut.disk.border[b]] = border_point(size, t[b]);
  return uv;
}

}  // namespace

MappedDisk map_to_square(const CutDisk& cut, const MapOptions& options) {
  MappedDisk mapped{.cut = cut, .layout = {}, .map = {}, .quality = {}, .parameterizer = "stretch"};
  if (std::holds_alternative<FloaterOptions>(options.parameterizer))
    mapped.parameterizer = "floater";
  update(options.progress, "map", 0.0);
  const LayoutOptions layout{options.size, choose_rotation(cut, options.size, options.rotations)};
  mapped.layout = lay_out_border(cut, layout);
  split_at_corners(mapped.cut, mapped.layout);
  split_chords(mapped.cut.disk);

  mapped.map.size = options.size;
  const std::vector<double> t = border_positions(mapped.cut, mapped.layout);
  mapped.map.uv = place_border(mapped.cut, options.size, t);
  const std::vector<BorderFreedom> freedoms = border_freedoms(mapped.cut, mapped.layout, t);
  const bool found = map_interior(mapped.cut.disk, mapped.map.uv, options.parameterizer,
                                  {.freedoms = freedoms, .progress = options.progress});
  mapped.quality = measure_map(mapped.cut.disk, mapped.map);
  if (!found)
    throw TopologyError(options.name,
                        fmt::format("no valid map was found: {} triangles flipped, {} without area",
                                    mapped.quality.flipped, mapped.quality.degenerate),
                        "a mesh with fewer or better shaped triangles");
  update(options.progress, "map", 1.0);
  return mapped;
}

}  // namespace weft
