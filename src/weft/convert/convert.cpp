#include "weft/convert.h"

#include <fmt/format.h>

#include "weft/convert/chart_packing.h"
#include "weft/convert/image_conversion.h"
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

/// A map may be valid and the image of little use: thin triangles of it fold where samples miss
/// them.
void warn_of_folds(Conversion& made) {
  constexpr double max_stretch = 5, max_area_ratio = 1.05, max_reversed = 0.02;
  const ImageQuality& q = made.quality;
  const double stretch = made.map_quality.stretch_l2;
  if (stretch <= max_stretch && q.area_ratio <= max_area_ratio && q.reversed_area <= max_reversed)
    return;
  made.warnings.push_back(fmt::format(
      "the image is poor: stretch {:.3g} (L2), {:.3g} times the mesh's area, {:.2g} % of "
      "it facing the wrong way; a larger size may help",
      stretch, q.area_ratio, 100 * q.reversed_area));
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

}  // namespace

Conversion convert_mesh(const TriangleMesh& mesh, const std::string& name,
                        const ConvertOptions& options) {
  check_size(options.size);
  if (options.normal_map_size != 0) check_size(options.normal_map_size);
  check_charts(options);
  if (options.keep_uv || options.charts == ChartChoice::texture) check_texture(mesh, name);
  Stopwatch watch;
  Conversion made;
  update(options.progress, "repair", 0);
  made.input = repair_mesh(
      mesh, {.name = name, .component = components_of(options), .part = parts_of(options)});
  made.seconds.load = watch.lap();
  named(name, [&] {
    ImageConversion(made, name, options).run();
    made.quality = measure_topology(made.image);
    require_topology(made, name);
  });
  watch.lap();
  if (options.measure) {
    update(options.progress, "measure", 0);
    made.quality = measure_image(made.image, made.input.mesh,
                                 {options.threads, options.seed, options.progress});
    warn_of_folds(made);
    made.seconds.measure = watch.lap();
  }
  const StageSeconds& s = made.seconds;
  made.seconds.total = s.load + s.cut + s.map + s.sample + s.measure;
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
  made.min_size = shares[0].min_side;
  if (shares.size() > 1)
    while (!pack_charts(shares, made.min_size)) ++made.min_size;
  return made;
}

}  // namespace weft
