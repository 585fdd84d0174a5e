#include <cmath>

#include "weft/garment.h"
#include "weft/garment/edge_curve.h"
#include "weft/mesh.h"

namespace weft {

PanelMeasures measure_panel(const PatternPanel& panel) {
  PanelMeasures measures;
  Box3d box;
  double twice_area = 0;
  for (const PatternEdge& edge : panel.edges) {
    const std::vector<Vec2d> line = edge_polyline(panel, edge);
    measures.edge_lengths.push_back(length_of(line));
    for (std::size_t k = 0; k + 1 < line.size(); ++k) twice_area += cross(line[k], line[k + 1]);
    for (const Vec2d p : line) box.add({p.x, p.y, 0});
  }
  measures.area = std::abs(twice_area) / 2;
  if (!box.empty()) measures.extent = {box.extent().x, box.extent().y};
  return measures;
}

}  // namespace weft
