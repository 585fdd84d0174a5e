#include <cmath>

#include "fuzz/properties.h"
#include "weft/garment.h"
#include "weft/garment/edge_curve.h"

namespace weft::fuzz {
namespace {

void require_sound(const PatternPanel& panel) {
  const std::size_t count = panel.edges.size();
  require(count >= 2, "a panel has an outline");
  for (std::size_t k = 0; k < count; ++k) {
    const PatternEdge& edge = panel.edges[k];
    require(edge.to == panel.edges[(k + 1) % count].from, "the outline is closed");
    for (const Vec2d& point : edge_polyline(panel, edge)) {
      const Vec3d placed = panel.placed(point);
      require(std::isfinite(placed.x + placed.y + placed.z), "edges are finite");
    }
  }
}

void require_edge(const Pattern& pattern, PanelEdge side) {
  require(side.panel >= 0 && side.panel < static_cast<int>(pattern.panels.size()),
          "stitches join panels that there are");
  require(side.edge >= 0 && side.edge < static_cast<int>(pattern.panels[side.panel].edges.size()),
          "stitches join edges that there are");
}

}  // namespace
}  // namespace weft::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace weft;
  using namespace weft::fuzz;
  const auto pattern =
      read_or_refuse([&] { return parse_pattern(as_text(data, size), file_name); });
  if (!pattern) return 0;
  for (const PatternPanel& panel : pattern->panels) require_sound(panel);
  for (const Stitch& stitch : pattern->stitches)
    for (const PanelEdge& side : {stitch.a, stitch.b}) require_edge(*pattern, side);
  return 0;
}
