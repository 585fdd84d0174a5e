#include <algorithm>
#include <set>

#include "weft/drawing.h"
#include "weft/param/square_map.h"
#include "weft/picture.h"

namespace weft {
namespace {

constexpr Vec3f true_border{0.25F, 0.26F, 0.28F};

/// [P] the number of each path's pair of mates, in order of the lower path; -1 for true borders.
std::vector<int> pair_numbers(const CutDisk& cut) {
  std::vector<int> numbers(cut.paths.size(), -1);
  int count = 0;
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    const int mate = cut.paths[p].mate;
    if (mate >= 0 && numbers[p] < 0) numbers[p] = numbers[mate] = count++;
  }
  return numbers;
}

Vec3f colour_of_pair(int number) { return number < 0 ? true_border : curve_colour(number); }

std::vector<int> vertices_of(const CutDisk& cut, const BorderPath& path) {
  std::vector<int> vertices;
  for (int i = 0; i <= path.edges; ++i)
    vertices.push_back(cut.disk.border[(path.first + i) % cut.disk.border.size()]);
  return vertices;
}

/// The pixel rectangle of a piece of border, outside the square.
struct Strip {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The rectangle of the border positions `from` to `to`, which are on one side, in a frame `margin`
/// wide around a square of `side` pixels.
Strip strip_of(double from, double to, int size, int side, int margin) {
  const int n = size - 1;
  const int which = std::min(3, static_cast<int>(from / n));
  const auto pixel = [&](double t) {
    return static_cast<int>(std::clamp((t - which * n) / n, 0.0, 1.0) * side);
  };
  const int a = pixel(from), b = std::max(pixel(to), a + 1);
  const int band = margin * 2 / 3, gap = margin - band;
  switch (which) {
    case 0:
      return {margin + a, 0, b - a, band};
    case 1:
      return {margin + side + gap, margin + a, band, b - a};
    case 2:
      return {margin + side - b, margin + side + gap, b - a, band};
    default:
      return {0, margin + side - b, band, b - a};
  }
}

void fill(Picture& picture, const Strip& strip, Vec3f colour) {
  for (int y = strip.y; y < strip.y + strip.height; ++y)
    for (int x = strip.x; x < strip.x + strip.width; ++x) set_pixel(picture, x, y, colour);
}

}  // namespace

std::vector<BorderBand> border_bands(const BorderMates& mates) {
  std::vector<MateInterval> pairs = mates.intervals();
  const auto other_first = [&](const MateInterval& pair) {
    return mates.along_border(pair.mate, pair.turned ? 0 : -pair.count);
  };
  const auto min = [&](const MateInterval& pair) {
    return std::min(pair.first, other_first(pair));
  };
  std::sort(pairs.begin(), pairs.end(),
            [&](const MateInterval& a, const MateInterval& b) { return min(a) < min(b); });
  std::vector<BorderBand> bands;
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    bands.push_back({pairs[i].first, pairs[i].count, curve_colour(i)});
    bands.push_back({other_first(pairs[i]), pairs[i].count, curve_colour(i)});
  }
  return bands;
}

Picture marked_by_mates(const Picture& picture, const BorderMates& mates) {
  Picture marked = picture;
  const int n = mates.size(), scale = picture.width / n;
  for (const BorderBand& band : border_bands(mates))
    for (int k = 0; k <= band.count; ++k) {
      const int sample = mates.sample_at(mates.along_border(band.first, k));
      for (int y = 0; y < scale; ++y)
        for (int x = 0; x < scale; ++x)
          set_pixel(marked, scale * (sample % n) + x, scale * (sample / n) + y, band.colour);
    }
  return marked;
}

std::vector<BorderBand> border_bands(const MappedDisk& mapped) {
  const std::vector<int> numbers = pair_numbers(mapped.cut);
  std::vector<BorderBand> bands;
  for (std::size_t p = 0; p < numbers.size(); ++p)
    bands.push_back(
        {mapped.layout.first[p], mapped.layout.intervals[p], colour_of_pair(numbers[p])});
  return bands;
}

Picture framed_by_mates(const Picture& square, const std::vector<BorderBand>& bands, int size) {
  const int side = square.width, margin = std::max(6, side / 24);
  Picture framed = blank_picture(side + 2 * margin, side + 2 * margin, {1, 1, 1});
  paste(framed, square, margin, margin);
  const int around = 4 * (size - 1);
  for (const BorderBand& band : bands) {
    for (int k = 0; k < band.count; ++k) {
      const int t = (band.first + k) % around;
      fill(framed, strip_of(t, t + 1, size, side, margin), band.colour);
    }
    // A white gap separates each band from the previous one.
    const double interval_pixels = static_cast<double>(side) / (size - 1);
    const double gap = std::min(0.4 * band.count, std::max(1.0, side / 300.0) / interval_pixels);
    fill(framed, strip_of(band.first, band.first + gap, size, side, margin), {1, 1, 1});
  }
  return framed;
}

void add_cut(SurfaceDrawing& drawing, const CutDisk& cut) {
  const std::vector<int> numbers = pair_numbers(cut);
  std::set<int> nodes;
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    const BorderPath& path = cut.paths[p];
    const std::vector<int> vertices = vertices_of(cut, path);
    if (path.mate >= 0) nodes.insert(cut.disk.surface_vertex[vertices.front()]);
    if (path.mate >= 0 && path.mate < static_cast<int>(p)) continue;
    DrawnCurve curve{{}, colour_of_pair(numbers[p])};
    for (const int v : vertices) curve.points.push_back(cut.disk.positions[v]);
    drawing.curves.push_back(curve);
  }
  for (std::size_t v = 0; v < cut.disk.positions.size(); ++v)
    if (nodes.erase(cut.disk.surface_vertex[v]) > 0) drawing.nodes.push_back(cut.disk.positions[v]);
}

void add_cut(SurfaceDrawing& drawing, const MappedDisk& mapped) { add_cut(drawing, mapped.cut); }

void add_cut(SurfaceDrawing& drawing, const GeometryImage& image) {
  const int n = image.size();
  const BorderMates& mates = image.mates;
  std::vector<bool> mated(static_cast<std::size_t>(mates.border_length()), false);
  const auto point = [&](int from, int steps) {
    const int sample = mates.sample_at(mates.along_border(from, steps));
    return image.world_position(sample / n, sample % n);
  };
  const std::vector<BorderBand> bands = border_bands(mates);
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const BorderBand& band = bands[i];
    for (int k = 0; k < band.count; ++k) mated[mates.along_border(band.first, k)] = true;
    if (i % 2 == 1) continue;  // the mate of the one before
    DrawnCurve curve{{}, band.colour};
    for (int k = 0; k <= band.count; ++k) curve.points.push_back(point(band.first, k));
    drawing.nodes.push_back(curve.points.front());
    drawing.nodes.push_back(curve.points.back());
    drawing.curves.push_back(curve);
  }
  for (int t = 0; t < mates.border_length(); ++t)
    if (!mated[t]) drawing.curves.push_back({{point(t, 0), point(t, 1)}, true_border});
}

}  // namespace weft
