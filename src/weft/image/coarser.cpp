#include <optional>

#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image_quality.h"

namespace weft {
namespace {

/// Whether charts and seams lie at multiples of a step.
bool are_aligned(const BorderMates& mates, int step) {
  const auto whole = [step](int value) { return value % step == 0; };
  if (!whole(mates.size() - 1)) return false;
  for (const Chart& chart : mates.charts())
    if (!whole(chart.row) || !whole(chart.col) || !whole(chart.rows - 1) ||
        !whole(chart.cols - 1) || (chart.rows - 1) / step + 1 < min_image_size ||
        (chart.cols - 1) / step + 1 < min_image_size)
      return false;
  for (const MateInterval& run : mates.intervals())
    if (!whole(run.first) || !whole(run.mate) || !whole(run.count)) return false;
  return true;
}

BorderMates coarser_mates(const GeometryImage& image, int step) {
  std::vector<Chart> charts = image.mates.charts();
  for (Chart& chart : charts)
    chart = {chart.name, chart.row / step, chart.col / step, (chart.rows - 1) / step + 1,
             (chart.cols - 1) / step + 1};
  // Borders of charts are whole numbers of steps long, so that all positions scale alike.
  std::vector<MateInterval> runs = image.mates.intervals();
  for (MateInterval& run : runs)
    run = {run.first / step, run.mate / step, run.count / step, run.turned};
  const int size = (image.size() - 1) / step + 1;
  if (image.has_one_chart()) return {size, std::move(runs)};
  return {size, std::move(charts), std::move(runs)};
}

/// Of few samples a handle may close so far that its triangles meet along an edge: no level.
bool have_same_topology(const GeometryImage& image, const GeometryImage& coarse) {
  const ImageQuality fine = measure_topology(image);
  try {
    const ImageQuality found = measure_topology(coarse);
    return fine.euler == found.euler && fine.boundaries == found.boundaries;
  } catch (const TopologyError&) {
    return false;
  }
}

}  // namespace

std::optional<GeometryImage> coarser_image(const GeometryImage& image, int level) {
  constexpr int deepest = 12;
  if (level < 0 || level > deepest) return std::nullopt;
  const int step = 1 << level;
  if ((image.size() - 1) / step + 1 < min_image_size) return std::nullopt;
  if (image.mates.size() == 0 || !are_aligned(image.mates, step)) return std::nullopt;
  GeometryImage coarse;
  coarse.world = image.world;
  coarse.source = image.source;
  coarse.source_hash = image.source_hash;
  coarse.mates = coarser_mates(image, step);
  const int size = coarse.mates.size();
  coarse.cube = Planes3(size);
  if (image.has_colours()) coarse.colours = Planes3(size);
  for (int s = 0; s < size * size; ++s) {
    const int from = coarse.mates.representative(s);
    const int row = step * (from / size), col = step * (from % size);
    coarse.cube.set(s, image.cube.at(row, col));
    if (image.has_colours()) coarse.colours.set(s, image.colours.at(row, col));
  }
  if (!have_same_topology(image, coarse)) return std::nullopt;
  return coarse;
}

int coarsest_level(const GeometryImage& image) {
  int level = 0;
  for (int k = 1; (image.size() - 1) >> k >= min_image_size - 1; ++k)
    if (coarser_image(image, k)) level = k;
  return level;
}

}  // namespace weft
