#include "weft/convert/bake_colours.h"

#include <algorithm>

#include <fmt/format.h>

#include "weft/convert/pieces.h"
#include "weft/convert/surface_places.h"
#include "weft/error.h"

namespace weft {
namespace {

/// Between two samples of the image lie so many of the colour map, while it stays below a side.
constexpr int finest_scale = 4, largest_map = 4097;

int scale_for(int size) { return std::clamp((largest_map - 1) / (size - 1), 1, finest_scale); }

/// Reads colours at places of the repaired mesh, whose triangles may have their corners in another
/// order than those of the given one.
class ColourReader {
 public:
  ColourReader(const TriangleMesh& given, const SurfaceColours& colours, const RepairedMesh& input)
      : given_(given), colours_(colours), input_(input) {}

  [[nodiscard]] Vec3f at(int triangle, const std::array<double, 3>& weights) const {
    const int source = input_.source_triangle[triangle];
    std::array<double, 3> reordered{};
    for (std::size_t k = 0; k < 3; ++k)
      reordered[corner_of(source, input_.source_vertex[input_.mesh.triangles[triangle][k]])] =
          weights[k];
    return colours_.at(source, reordered);
  }

 private:
  /// @param vertex  of the given mesh
  [[nodiscard]] std::size_t corner_of(int triangle, int vertex) const {
    const Triangle& corners = given_.triangles[triangle];
    for (std::size_t k = 0; k < 2; ++k) {
      const int corner = corners[k];
      if ((input_.welded.empty() ? corner : input_.welded[corner]) == vertex) return k;
    }
    return 2;
  }

  const TriangleMesh& given_;
  const SurfaceColours& colours_;
  const RepairedMesh& input_;
};

/// Samples a chart into its rectangle of the map.
void sample_chart(const ConvertedChart& chart, const ColourReader& reader, int scale,
                  Planes3& map) {
  const ChartSize fine = refined(chart.mapped->map.size, scale);
  const std::vector<SurfacePlace> places =
      surface_places(*chart.mapped, chart.piece->mesh.triangles, fine);
  for (int s = 0; s < fine.rows * fine.cols; ++s)
    map.set(scale * chart.place.row + s / fine.cols, scale * chart.place.col + s % fine.cols,
            reader.at(chart.piece->triangle[places[s].triangle], places[s].weights));
}

/// The mean of the map about a sample, which weighs less the farther away, within its chart.
Vec3f mean_at(const Planes3& map, const Chart& chart, int row, int col, int scale) {
  Vec3d sum;
  double whole = 0;
  for (int i = 1 - scale; i < scale; ++i)
    for (int j = 1 - scale; j < scale; ++j) {
      const int r = scale * row + i, c = scale * col + j;
      if (r < 0 || c < 0 || r > scale * (chart.rows - 1) || c > scale * (chart.cols - 1)) continue;
      const double weight = (scale - std::abs(i)) * (scale - std::abs(j));
      sum += weight * vec_cast<double>(map.at(scale * chart.row + r, scale * chart.col + c));
      whole += weight;
    }
  return vec_cast<float>((1 / whole) * sum);
}

/// Of all samples of a point the mean, so that seams do not show.
void join_colours(const BorderMates& mates, Planes3& colours) {
  for (int k = 0; k < mates.class_count(); ++k) {
    const std::span<const int> copies = mates.copies(k);
    Vec3d sum;
    for (const int sample : copies) sum += vec_cast<double>(colours.at(sample));
    const Vec3f mean = vec_cast<float>((1 / static_cast<double>(copies.size())) * sum);
    for (const int sample : mates.mates(k)) colours.set(sample, mean);
  }
}

/// What lies between charts gets the colour of a sample beside it.
void fill_holes(const GeometryImage& image, int scale, Planes3& map) {
  if (image.mates.chart_of().empty()) return;
  for (int r = 0; r < map.size(); ++r)
    for (int c = 0; c < map.size(); ++c) {
      const int sample = (r + scale / 2) / scale * image.size() + (c + scale / 2) / scale;
      if (image.mates.is_hole(sample)) map.set(r, c, image.colours.at(sample));
    }
}

}  // namespace

void bake_colours(const TriangleMesh& given, const SurfaceColours& colours, Conversion& made) {
  if (colours.part_of.size() != given.triangles.size())
    throw UsageError("", fmt::format("colours of {} triangles", colours.part_of.size()),
                     fmt::format("those of {} are wanted", given.triangles.size()));
  const int n = made.image.size(), scale = scale_for(n);
  const ColourReader reader(given, colours, made.input);
  Planes3 map(scale * (n - 1) + 1);
  made.image.colours = Planes3(n);
  for (const ConvertedChart& chart : made.charts) {
    sample_chart(chart, reader, scale, map);
    for (int r = 0; r < chart.place.rows; ++r)
      for (int c = 0; c < chart.place.cols; ++c)
        made.image.colours.set(chart.place.row + r, chart.place.col + c,
                               mean_at(map, chart.place, r, c, scale));
  }
  join_colours(made.image.mates, made.image.colours);
  fill_holes(made.image, scale, map);
  made.colour_map = std::move(map);
}

}  // namespace weft
