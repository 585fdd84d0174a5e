#include "weft/convert/image_conversion.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "weft/convert/joined_normals.h"
#include "weft/convert/sample.h"
#include "weft/core/hash.h"
#include "weft/core/share_out.h"
#include "weft/core/stopwatch.h"
#include "weft/error.h"
#include "weft/image_quality.h"
#include "weft/param/square_map.h"
#include "weft/shapes.h"

namespace weft {
namespace {

/// So that two coarser levels can have the nodes of cuts, too.
constexpr int rotation_unit = 4;

std::string source_name(const std::string& name) {
  return is_builtin(name) ? name : std::filesystem::path(name).filename().string();
}

std::string hash_of(const TriangleMesh& mesh) {
  Hash hash;
  hash.add(std::span<const Vec3d>(mesh.positions));
  hash.add(std::span<const Triangle>(mesh.triangles));
  return hash.text();
}

/// Of several charts: together as one map, each weighed by its area.
MapQuality joined_quality(const std::vector<ConvertedChart>& charts,
                          const std::vector<Piece>& pieces) {
  if (charts.size() == 1) return charts[0].mapped->quality;
  MapQuality whole;
  double area = 0;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const MapQuality& own = charts[k].mapped->quality;
    whole.flipped += own.flipped;
    whole.degenerate += own.degenerate;
    whole.stretch_l2 += pieces[k].area * own.stretch_l2 * own.stretch_l2;
    whole.stretch_linf = std::max(whole.stretch_linf, own.stretch_linf);
    area += pieces[k].area;
  }
  whole.stretch_l2 = std::sqrt(whole.stretch_l2 / area);
  return whole;
}

/// Copies what was sampled of a chart into its rectangle, `scale` times as finely as positions.
void insert(const Planes3& own, const Chart& chart, int scale, Planes3& whole) {
  for (int r = 0; r <= scale * (chart.rows - 1); ++r)
    for (int c = 0; c <= scale * (chart.cols - 1); ++c)
      whole.set(scale * chart.row + r, scale * chart.col + c, own.at(r, c));
}

std::vector<Piece> pieces_for(const RepairedMesh& input) {
  const bool is_one = input.counts.components == 1 && input.joined.empty();
  return is_one ? std::vector{whole_piece(input.mesh)} : pieces_of(input.mesh);
}

}  // namespace

ImageConversion::ImageConversion(Conversion& made, const std::string& name,
                                 const ConvertOptions& options)
    : made_(made), name_(name), options_(options), pieces_(pieces_for(made.input)) {
  if (pieces_.size() > 1 && (options.seam || options.seed_triangle >= 0))
    throw TopologyError(name, fmt::format("{} pieces", pieces_.size()),
                        "to cut by hand, one is wanted, or --component K");
}

int ImageConversion::place(int most) {
  Stopwatch watch;
  cut(most);
  made_.seconds.cut = watch.lap();
  return places_.size;
}

void ImageConversion::run() {
  Stopwatch watch;
  // Images of squares alone keep the bits that they have always had.
  const bool squares =
      std::all_of(charts_.begin(), charts_.end(),
                  [](const ChartConversion& chart) { return chart.aspect() <= 1; });
  const int unit = squares ? 1 : rotation_unit;
  for (std::size_t k = 0; k < charts_.size(); ++k) charts_[k].map(size_of(k), unit);
  made_.seconds.map = watch.lap();
  tell("sample");
  share_out(static_cast<int>(charts_.size()), options_.threads, options_.progress, "sample",
            [&](int k, Progress* progress) { charts_[k].sample(progress); });
  gather();
  made_.seconds.sample = watch.lap();
}

void ImageConversion::cut(int most) {
  charts_.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    tell("cut");
    charts_.emplace_back(piece, made_.input, name_, options_);
  }
  std::vector<std::string> warnings;
  places_ = placed_as_squares(warnings);
  if (places_.size > most) return;
  for (std::size_t k = 0; k < charts_.size(); ++k) charts_[k].lengthen_cut(size_of(k).rows);
  const bool joined = !made_.input.joined.empty();
  if (charts_.size() > 1 || joined)
    for (std::size_t k = 0; k < charts_.size(); ++k) charts_[k].choose_shape(size_of(k).rows);
  if (joined) {
    share_borders();
    places_ = placed_as_squares(warnings);
  }
  if (has_rectangles()) try_rectangles();
  for (FixedBorder& border : curves_.borders) border.intervals = places_.intervals;
  made_.warnings.insert(made_.warnings.end(), warnings.begin(), warnings.end());
}

/// Takes those that are better, where the image does not grow by them and they are worth it.
void ImageConversion::try_rectangles() {
  constexpr double min_gain = 0.15;
  std::vector<std::string> warnings;
  const double stretch = stretch_in(places_);
  std::optional<Placement> with = placed_as_rectangles(warnings);
  while (with && reject_rectangles(*with)) with = placed_as_rectangles(warnings);
  if (with && stretch_in(*with) < (1 - min_gain) * stretch)
    places_ = *std::move(with);
  else
    take_shapes(false);
}

bool ImageConversion::has_rectangles() const {
  return std::any_of(charts_.begin(), charts_.end(),
                     [](const ChartConversion& chart) { return chart.has_rectangle(); });
}

/// Every chart takes its rectangle, if it has one, or its square.
void ImageConversion::take_shapes(bool rectangles) {
  for (ChartConversion& chart : charts_) chart.take_rectangle(rectangles && chart.has_rectangle());
  if (!made_.input.joined.empty()) share_borders();
}

/// In an image no larger than that of the squares.
std::optional<Placement> ImageConversion::placed_as_rectangles(std::vector<std::string>& warnings) {
  take_shapes(true);
  return place_charts(pieces_, charts_, curves_, options_.size, places_.size, warnings);
}

Placement ImageConversion::placed_as_squares(std::vector<std::string>& warnings) const {
  warnings.clear();
  std::optional<Placement> found =
      place_charts(pieces_, charts_, curves_, options_.size, largest_image_size, warnings);
  if (!found)
    throw TopologyError(
        "", fmt::format("{} pieces that need more samples than an image has", charts_.size()),
        "fewer or simpler pieces, or --component K, are wanted");
  return *std::move(found);
}

/// Of charts that share curves with others. @return whether any was given up
bool ImageConversion::reject_rectangles(const Placement& placement) {
  bool rejected = false;
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    ChartConversion& chart = charts_[k];
    if (!chart.has_rectangle() || chart.shared_curves().empty()) continue;
    curves_.borders[k].intervals = placement.intervals;
    if (chart.reject_rectangle({placement.charts[k].rows, placement.charts[k].cols}))
      rejected = true;
  }
  return rejected;
}

/// What the stretch of all charts is worth together, in proportion to their area.
double ImageConversion::stretch_in(const Placement& placement) const {
  double sum = 0;
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    const Chart& chart = placement.charts[k];
    const double rows = chart.rows - 1, cols = chart.cols - 1;
    // How much more densely the chart has samples across than along: that is paid for on top.
    const double density = charts_[k].aspect() * rows / cols;
    sum += 0.5 * (density + 1 / density) * charts_[k].energy() / (rows * cols);
  }
  return sum;
}

/// Once all cuts are known: where they meet a border, curves end.
void ImageConversion::share_borders() {
  std::vector<Cut> cuts;
  for (const ChartConversion& chart : charts_) cuts.push_back(chart.lengthened_cut());
  curves_ = find_seam_curves(made_.input, pieces_, cuts);
  for (std::size_t k = 0; k < charts_.size(); ++k) charts_[k].share(curves_.borders[k]);
}

void ImageConversion::gather() {
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    const ChartConversion& chart = charts_[k];
    made_.cut.paths += chart.cut().paths;
    made_.cut.nodes += chart.cut().nodes;
    made_.cut.length += chart.cut().length;
    made_.rounds += chart.rounds();
    made_.warnings.insert(made_.warnings.end(), chart.warnings().begin(), chart.warnings().end());
    made_.charts.push_back({chart.mapped(), places_.charts[k]});
  }
  made_.parameterizer = made_.charts[0].mapped->parameterizer;
  made_.map_quality = joined_quality(made_.charts, pieces_);
  const bool is_one = charts_.size() == 1 && curves_.length.empty();
  made_.image = is_one ? charts_[0].image() : joined_image();
  made_.image.source = source_name(name_);
  made_.image.source_hash = hash_of(made_.input.mesh);
  if (options_.normal_map_size > 0) sample_normal_map();
  if (options_.keep_uv) sample_textures();
  for (std::size_t k = 0; k < pieces_.size(); ++k)
    made_.charts[k].piece = std::make_shared<const Piece>(std::move(pieces_[k]));
}

/// The charts beside each other in one unit cube.
GeometryImage ImageConversion::joined_image() const {
  GeometryImage image;
  image.world = unit_cube_map(made_.input.mesh.positions);
  image.cube = Planes3(places_.size);
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    const Chart& chart = places_.charts[k];
    const GeometryImage& own = charts_[k].image();
    for (int r = 0; r < chart.rows; ++r)
      for (int c = 0; c < chart.cols; ++c)
        image.cube.set(chart.row + r, chart.col + c,
                       to_cube(image.world, own.world_position(r, c)));
  }
  image.mates = BorderMates(places_.size, places_.charts, seams());
  join_mates(image);
  return image;
}

/// Those within the charts, and of each curve between charts its first border with every other.
std::vector<MateInterval> ImageConversion::seams() const {
  struct Run {
    int chart_first, around, first;
    bool forward;
  };
  std::vector<MateInterval> intervals;
  std::vector<std::vector<Run>> runs(curves_.length.size());
  int first = 0;
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    const MappedDisk& mapped = *charts_[k].mapped();
    const int around = places_.charts[k].border_length();
    for (const MateInterval& own : charts_[k].image().mates.intervals())
      intervals.push_back({first + own.first, first + own.mate, own.count, own.turned});
    for (std::size_t p = 0; p < mapped.cut.paths.size(); ++p)
      if (const BorderPath& path = mapped.cut.paths[p]; path.curve >= 0)
        runs[path.curve].push_back({first, around, mapped.layout.first[p], path.forward});
    first += around;
  }
  for (std::size_t c = 0; c < runs.size(); ++c)
    for (std::size_t i = 1; i < runs[c].size(); ++i) {
      const Run &one = runs[c][0], &other = runs[c][i];
      const int count = places_.intervals[c];
      const bool turned = one.forward == other.forward;
      const int mate = turned ? other.first : (other.first + count) % other.around;
      intervals.push_back({one.chart_first + one.first, other.chart_first + mate, count, turned});
    }
  return intervals;
}

/// Of several charts a whole number of times as fine as positions are, so that charts begin at
/// samples of both.
void ImageConversion::sample_normal_map() {
  if (made_.image.has_one_chart() && size_of(0) == ChartSize(places_.size)) {
    made_.normals = sample_normals(*charts_[0].mapped(), options_.normal_map_size);
    return;
  }
  const int scale = std::max(1, (options_.normal_map_size - 1) / (places_.size - 1));
  made_.normals = NormalMap{Planes3(scale * (places_.size - 1) + 1)};
  made_.normals->normal.y.fill(1);
  const JoinedNormals normals(made_.input);
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    const MappedDisk& mapped = *charts_[k].mapped();
    insert(
        sample_normals(mapped, refined(size_of(k), scale), normals.of(mapped.cut.disk, pieces_[k]))
            .normal,
        places_.charts[k], scale, made_.normals->normal);
  }
}

void ImageConversion::sample_textures() {
  made_.texture = Planes3(places_.size);
  for (std::size_t k = 0; k < charts_.size(); ++k)
    insert(sample_texture(*charts_[k].mapped(), pieces_[k].mesh), places_.charts[k], 1,
           *made_.texture);
}

}  // namespace weft
