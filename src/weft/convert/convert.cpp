#include "weft/convert.h"

#include <fmt/format.h>

#include "weft/convert/bake_colours.h"
#include "weft/convert/chart_packing.h"
#include "weft/convert/image_conversion.h"
#include "weft/convert/more_charts.h"
#include "weft/convert/pieces.h"
#include "weft/core/stopwatch.h"
#include "weft/cut/disk_mesh.h"
#include "weft/cut/open_to_disk.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image_quality.h"
#include "weft/param/augment.h"
#include "weft/param/border_layout.h"

namespace weft {
namespace {

void check_size(int size) {
  if (size == automatic_size) return;
  if (size >= min_image_size && size <= largest_image_size) return;
  throw UsageError("", fmt::format("a geometry image of side {}", size),
                   fmt::format("a side of {} .. {}", min_image_size, largest_image_size));
}

void check_charts(const ConvertOptions& options) {
  if (options.charts != ChartChoice::regions) return;
  if (options.max_charts >= 1 && options.max_charts <= largest_chart_count) return;
  throw UsageError("", fmt::format("{} charts", options.max_charts),
                   fmt::format("1 .. {} charts", largest_chart_count));
}

void check_texture(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.corner_uv.empty())
    throw InputError(
        name, "not every corner of its faces has texture coordinates",
        "an OBJ with vt, a PLY with s and t or u and v, or a glTF with TEXCOORD_0 is wanted");
}

void require_topology(const Conversion& made, const std::string& name) {
  const TopologyCounts& input = made.input.counts;
  if (made.quality.euler == input.euler && made.quality.boundaries == input.boundaries) return;
  const int n = made.image.size();
  throw TopologyError(
      name,
      fmt::format(
          "an image of {0} x {0} with Euler number {1} and {2} borders, the mesh has {3} and {4}",
          n, made.quality.euler, made.quality.boundaries, input.euler, input.boundaries),
      fmt::format("a larger size, for example {}", 2 * n - 1));
}

// The stages do not know the name of the mesh: it is put in front of their errors.
template <class Stage>
void named(const std::string& name, const Stage& stage) {
  try {
    stage();
  } catch (const TopologyError& error) {
    if (std::string_view(error.what()).starts_with(name)) throw;
    throw TopologyError(name, error.what(), "");
  }
}

ComponentChoice components_of(const ConvertOptions& options) {
  const bool many = options.charts != ChartChoice::one;
  if (options.component.kind == ComponentChoice::Kind::only && many)
    return {ComponentChoice::Kind::all, 0};
  return options.component;
}

PartChoice parts_of(const ConvertOptions& options) {
  return {.at_texture_seams = options.charts == ChartChoice::texture,
          .regions = options.charts == ChartChoice::regions ? options.max_charts : 0};
}

void measure(Conversion& made, const ConvertOptions& options) {
  Stopwatch watch;
  update(options.progress, "measure", 0);
  made.quality =
      measure_image(made.image, made.input.mesh, {options.threads, options.seed, options.progress});
  made.seconds.measure += watch.lap();
}

/// With one way of parting. @return nothing where the charts need a larger image than `most`
std::optional<Conversion> convert_parted(const TriangleMesh& mesh, const std::string& name,
                                         const ConvertOptions& options, const PartChoice& parts,
                                         int most) {
  Stopwatch watch;
  Conversion made;
  update(options.progress, "repair", 0);
  made.input =
      repair_mesh(mesh, {.name = name, .component = components_of(options), .part = parts});
  made.seconds.load = watch.lap();
  bool fits = true;
  named(name, [&] {
    ImageConversion conversion(made, name, options);
    fits = conversion.place(most) <= most;
    if (!fits) return;
    conversion.run();
    made.quality = measure_topology(made.image);
    require_topology(made, name);
  });
  if (!fits) return std::nullopt;
  if (options.measure) measure(made, options);
  return made;
}

/// The same, where it is of use and no cut is given by hand, in more charts.
/// What it takes does not depend on whether the caller measures: what decides is measured.
Conversion improved(Conversion first, const TriangleMesh& mesh, const std::string& name,
                    ConvertOptions options) {
  const MoreCharts more = more_charts_for(first);
  if (more.most < 2 || options.seam || options.seed_triangle >= 0) return first;
  if (!options.measure) {
    const Stopwatch watch;
    const ImageQuality folds = measure_folds(first.image, first.input.mesh);
    first.seconds.measure += watch.seconds();
    first.quality.area_ratio = folds.area_ratio;
    first.quality.reversed_area = folds.reversed_area;
    if (!is_poor(first)) return first;
    measure(first, options);
  }
  if (!is_poor(first)) return first;
  options.size = first.image.size();
  options.measure = true;
  const auto convert = [&](int charts) {
    return convert_parted(mesh, name, options, {.regions = charts, .divisible = more.divisible},
                          options.size);
  };
  return with_more_charts(std::move(first), more, convert);
}

}  // namespace

Conversion convert_mesh(const TriangleMesh& mesh, const std::string& name,
                        const ConvertOptions& options) {
  check_size(options.size);
  if (options.normal_map_size != 0) check_size(options.normal_map_size);
  check_charts(options);
  if (options.keep_uv || options.charts == ChartChoice::texture) check_texture(mesh, name);
  Conversion made = *convert_parted(mesh, name, options, parts_of(options), largest_image_size);
  if (options.charts == ChartChoice::automatic)
    made = improved(std::move(made), mesh, name, options);
  if (options.colours) {
    const Stopwatch watch;
    bake_colours(mesh, *options.colours, made);
    made.seconds.sample += watch.seconds();
  }
  if (options.measure && is_poor(made))
    made.warnings.push_back(
        fmt::format("the image is poor: {}; a larger size may help", folds_of(made)));
  StageSeconds& s = made.seconds;
  s.total = s.load + s.cut + s.map + s.sample + s.measure;
  return made;
}

CutPreview preview_cut(const TriangleMesh& mesh, const std::string& name,
                       const CutPreviewOptions& options) {
  CutPreview made;
  made.input = repair_mesh(mesh, {name, {ComponentChoice::Kind::all, 0}});
  std::vector<ChartShare> shares;
  for (const Piece& piece : pieces_of(made.input.mesh)) {
    const Cut cut = open_to_disk(piece.mesh);
    CutDisk disk = cut_open(piece.mesh, cut);
    shares.push_back({min_size(disk), 1});
    if (options.augment)
      disk = cut_open(
          piece.mesh,
          augment_cut(piece.mesh, cut, {.size = options.size, .progress = options.progress}).cut);
    made.disks.push_back(std::make_shared<CutDisk>(std::move(disk)));
  }
  made.may_be_split = made.input.mesh.triangles.size() >= 2 * min_triangles_of_more_charts;
  made.min_size = shares[0].min_side;
  if (shares.size() > 1)
    while (!pack_charts(shares, made.min_size)) ++made.min_size;
  return made;
}

}  // namespace weft
