#include "weft/convert/chart_conversion.h"

#include <span>

#include <fmt/format.h>

#include "weft/convert/fit_samples.h"
#include "weft/convert/sample.h"
#include "weft/cut/seam.h"
#include "weft/error.h"
#include "weft/param/augment.h"
#include "weft/param/border_curves.h"
#include "weft/param/border_layout.h"
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

}  // namespace

ChartConversion::ChartConversion(const Piece& piece, const RepairedMesh& input,
                                 const std::string& name, const ConvertOptions& options)
    : piece_(piece), input_(input), name_(name), options_(options), surface_(piece.mesh) {
  cut_ = lengthened_ = first_cut();
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

MappedDisk ChartConversion::mapped_along(const Cut& cut, int side) {
  MapOptions map;
  map.size = side;
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
  lengthened_ = cut_;
  if (!options_.augment || options_.seam) return;
  AugmentedCut augmented = augment_cut(
      *surface_, cut_, {.size = side, .threads = options_.threads, .progress = options_.progress});
  lengthened_ = std::move(augmented.cut);
  rounds_ = augmented.rounds;
}

CutDisk ChartConversion::opened(const Cut& cut) const {
  const FixedBorder& fixed = border_ != nullptr ? *border_ : FixedBorder{};
  return surface_ ? cut_open(*surface_, cut, fixed) : cut_open(piece_.mesh, cut, fixed);
}

void ChartConversion::share(const FixedBorder& border) {
  border_ = &border;
  const CutDisk disk = opened(lengthened_);
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

void ChartConversion::map(int side) {
  MappedDisk mapped = mapped_along(lengthened_, side);
  // The plain cut, where the longer one does not lower the stretch after all.
  if (rounds_ > 0 && is_suspicious(mapped) && has_free_path(opened(cut_))) {
    const CutSummary longer = cut_summary_;
    MappedDisk plain = mapped_along(cut_, side);
    if (plain.quality.stretch_l2 < mapped.quality.stretch_l2) {
      mapped = std::move(plain);
      lengthened_ = cut_;
      rounds_ = 0;
    } else {
      cut_summary_ = longer;
    }
  }
  mapped_ = std::make_shared<MappedDisk>(std::move(mapped));
}

void ChartConversion::sample() {
  image_ = sample_image(*mapped_);
  if (options_.fit_samples) image_ = fit_samples(*mapped_, image_, {.progress = options_.progress});
}

}  // namespace weft
