#include "weft/convert/chart_conversion.h"

#include <span>

#include <fmt/format.h>

#include "weft/convert/fit_samples.h"
#include "weft/convert/sample.h"
#include "weft/convert/unfold_samples.h"
#include "weft/cut/seam.h"
#include "weft/error.h"
#include "weft/param/augment.h"
#include "weft/param/border_curves.h"
#include "weft/param/border_layout.h"
#include "weft/param/four_corners.h"
#include "weft/param/rotation.h"
#include "weft/param/square_map.h"

namespace weft {
namespace {

constexpr int min_suitable = 33;
/// More samples than this for detail alone are to be asked for.
constexpr int max_for_detail = 1025;
/// The paths that better the map later lengthen the border, and one interval a path distorts.
constexpr int spare_border = 2;

// Users count the triangles of their file, of which repair may have dropped some.
int seed_in_piece(const Piece& piece, const RepairedMesh& input, int triangle) {
  if (triangle < 0) return triangle;
  for (std::size_t t = 0; t < piece.triangle.size(); ++t)
    if (input.source_triangle[piece.triangle[t]] == triangle) return static_cast<int>(t);
  throw TopologyError("seed triangle",
                      fmt::format("{} is not in the surface that is converted", triangle),
                      "a triangle of it, counted from 0 in the order of its file, is wanted");
}

// Longer cuts are judged on a coarse proxy, which slivers can mislead.
bool is_suspicious(const MappedDisk& mapped) {
  constexpr double most = 1.5;
  return mapped.parameterizer == "stretch" && mapped.quality.stretch_l2 > most;
}

// What stretches such a chart is its taper, which no cut takes away.
bool is_flat_with_four_corners(const CutDisk& cut) {
  return is_flat(cut.disk) && four_corners(cut);
}

}  // namespace

ChartConversion::ChartConversion(const Piece& piece, const RepairedMesh& input,
                                 const std::string& name, const ConvertOptions& options)
    : piece_(piece), input_(input), name_(name), options_(options), surface_(piece.mesh) {
  cut_ = square_.cut = first_cut();
  min_side_ = min_size(cut_open(*surface_, cut_));
}

Cut ChartConversion::first_cut() {
  const CutOptions cut{.seed_triangle = seed_in_piece(piece_, input_, options_.seed_triangle)};
  if (!options_.seam) return open_to_disk(*surface_, cut);
  std::vector<int> source_vertex;
  for (const int v : piece_.vertex) source_vertex.push_back(input_.source_vertex[v]);
  SeamCut along = cut_along_seam(piece_.mesh, source_vertex, *options_.seam, cut);
  if (along.added_edges > 0)
    warnings_.push_back(fmt::format(
        "{}: the seam does not open the mesh to a disk, {} edge{} were added to the cut",
        options_.seam->name, along.added_edges, along.added_edges == 1 ? "" : "s"));
  return std::move(along.cut);
}

int ChartConversion::suitable_side() const {
  const int border = spare_border * (min_side_ - 1);
  const auto vertices = static_cast<int>(piece_.mesh.positions.size());
  int n = min_suitable;
  const auto larger = [&] { return n = 2 * n - 1; };
  while (n < max_for_detail && n * n < vertices) larger();
  while (n - 1 < border && 2 * n - 1 <= largest_image_size) larger();
  return n;
}

MappedDisk ChartConversion::mapped_along(const Cut& cut, ChartSize size, int unit) {
  MapOptions map;
  map.size = size;
  map.rotation_unit = unit;
  map.parameterizer = options_.parameterizer;
  map.name = name_;
  map.threads = options_.threads;
  map.progress = options_.progress;
  CutDisk disk = opened(cut);
  cut_summary_ = summarise(disk);
  surface_.reset();  // a map takes enough memory as it is
  return map_to_square(std::move(disk), map);
}

void ChartConversion::lengthen_cut(int side) {
  if (!options_.augment || options_.seam || is_flat_with_four_corners(opened(cut_))) return;
  AugmentedCut augmented = augment_cut(
      *surface_, cut_, {.size = side, .threads = options_.threads, .progress = options_.progress});
  square_ = {std::move(augmented.cut), augmented.rounds, {}};
}

void ChartConversion::choose_shape(int side) {
  // A smaller square has no cells for a rectangle; and what gains less in the stretch of trial maps
  // may lose as much by its corners and by what is lost between charts.
  constexpr int min_side = 9;
  constexpr double min_gain = 0.4;
  const ShapeOptions options{.cells = static_cast<double>(side - 1) * (side - 1),
                             .threads = options_.threads,
                             .progress = options_.progress};
  square_.trial.energy = 0;
  rectangle_ = square_;
  if (side < min_side) return;
  const CutDisk disk = shape_proxy(piece_.mesh, square_.cut, options);
  square_.trial = try_aspect(disk, 1, options);
  rectangle_ = {square_.cut, square_.rounds, best_aspect(disk, options)};
  if (square_.rounds > 0) {
    // Paths that a square needs are seams for nothing in a rectangle that does as well without.
    constexpr double worth_of_paths = 0.1;
    const ShapeTrial plain = best_aspect(shape_proxy(piece_.mesh, cut_, options), options);
    if (plain.energy < (1 + worth_of_paths) * rectangle_.trial.energy)
      rectangle_ = {cut_, 0, plain};
  }
  const bool gains = rectangle_.trial.energy < (1 - min_gain) * square_.trial.energy;
  if (!gains) rectangle_ = square_;
}

bool ChartConversion::reject_rectangle(ChartSize size) {
  constexpr double min_gain = 0.2;
  const TrialMap trial = try_chart(opened(rectangle_.cut), {size, options_.threads});
  const double energy = trial.energy * (size.rows - 1) * (size.cols - 1);
  if (energy < (1 - min_gain) * square_.trial.energy) return false;
  rectangle_ = square_;
  return true;
}

void ChartConversion::take_rectangle(bool taken) {
  takes_rectangle_ = taken;
  if (border_ == nullptr) min_side_ = min_size(opened(shape().cut));
}

CutDisk ChartConversion::opened(const Cut& cut) const {
  const FixedBorder& fixed = border_ != nullptr ? *border_ : FixedBorder{};
  return surface_ ? cut_open(*surface_, cut, fixed) : cut_open(piece_.mesh, cut, fixed);
}

void ChartConversion::share(const FixedBorder& border) {
  border_ = &border;
  const CutDisk disk = opened(shape().cut);
  min_side_ = min_size(disk);
  shared_curves_.clear();
  min_free_intervals_ = 0;
  for (const BorderPath& path : disk.paths)
    if (path.curve >= 0) shared_curves_.push_back(path.curve);
  border_length_ = 0;
  for (const BorderCurve& curve : border_curves(disk))
    border_length_ += curve.weight * curve.length;
  for (const BorderCurve& curve : border_curves(disk))
    if (disk.paths[curve.path].curve < 0) min_free_intervals_ += curve.weight * curve.least;
}

void ChartConversion::map(ChartSize size, int unit) {
  MappedDisk mapped = mapped_along(shape().cut, size, unit);
  // The plain cut, where the longer one does not lower the stretch after all.
  if (shape().rounds > 0 && is_suspicious(mapped) && has_free_path(opened(cut_))) {
    const CutSummary longer = cut_summary_;
    MappedDisk plain = mapped_along(cut_, size, unit);
    if (plain.quality.stretch_l2 < mapped.quality.stretch_l2) {
      mapped = std::move(plain);
      shape() = {cut_, 0, shape().trial};
    } else {
      cut_summary_ = longer;
    }
  }
  mapped_ = std::make_shared<MappedDisk>(std::move(mapped));
}

void ChartConversion::sample(Progress* progress) {
  mapped_->map.sample_places = unfolded_places(*mapped_, progress);
  image_ = sample_image(*mapped_);
  if (options_.fit_samples) image_ = fit_samples(*mapped_, image_, {.progress = progress});
}

}  // namespace weft
