#include "weft/sim/sewing/panel_moves.h"

namespace weft {

Vec3d outer_side(const Chart& chart, const Planes3& placed) {
  Vec3d sum;
  for (int r = chart.row; r + 1 < chart.row + chart.rows; ++r)
    for (int c = chart.col; c + 1 < chart.col + chart.cols; ++c) {
      const Vec3d along = vec_cast<double>(placed.at(r + 1, c + 1) - placed.at(r, c));
      const Vec3d across = vec_cast<double>(placed.at(r + 1, c) - placed.at(r, c + 1));
      sum += cross(along, across);
    }
  return normalized(sum);
}

int panel_of(const BorderMates& mates, int sample) {
  const std::vector<int>& charts = mates.chart_of();
  return charts.empty() ? 0 : charts[mates.is_hole(sample) ? mates.representative(sample) : sample];
}

void move_panels(const BorderMates& mates, const std::vector<Vec3d>& shift, Planes3& placed) {
  for (int s = 0; s < placed.size() * placed.size(); ++s)
    placed.set(s, placed.at(s) + vec_cast<float>(shift[panel_of(mates, s)]));
}

Vec3d mean_of(const Planes3& planes, std::span<const int> samples) {
  Vec3d sum;
  for (const int s : samples) sum += vec_cast<double>(planes.at(s));
  return (1 / static_cast<double>(samples.size())) * sum;
}

}  // namespace weft
