#include "weft/convert.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "weft/convert/fit_samples.h"
#include "weft/convert/sample.h"
#include "weft/core/hash.h"
#include "weft/core/stopwatch.h"
#include "weft/cut/disk_mesh.h"
#include "weft/cut/open_to_disk.h"
#include "weft/cut/seam.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image_quality.h"
#include "weft/param/augment.h"
#include "weft/param/border_layout.h"
#include "weft/param/square_map.h"

namespace weft {
namespace {

constexpr int min_suitable = 33;
/// Largest side chosen for detail alone; a larger one has to be requested.
constexpr int max_for_detail = 1025;
/// Factor on the minimum border: paths added to the cut later lengthen the border, and paths of a
/// single interval distort the map.
constexpr int spare_border = 2;

/// The smallest n = 2^k + 1 from 33 on that has twice the border that the cut needs, and at least
/// as many samples as the mesh has vertices. More than 1025 only where the cut needs it.
int suitable_size(const CutDisk& cut, int vertex_count) {
  const int border = spare_border * (min_size(cut) - 1);
  int n = min_suitable;
  const auto larger = [&] { return n = 2 * n - 1; };
  while (n < max_for_detail && n * n < vertex_count) larger();
  while (n - 1 < border && 2 * n - 1 <= largest_image_size) larger();
  return n;
}

void check_size(int size) {
  if (size == automatic_size) return;
  if (size >= min_image_size && size <= largest_image_size) return;
  throw UsageError("", fmt::format("a geometry image of side {}", size),
                   fmt::format("a side of {} .. {}", min_image_size, largest_image_size));
}

void check_texture(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.corner_uv.empty())
    throw InputError(
        name, "not every corner of its faces has texture coordinates",
        "an OBJ with vt, a PLY with s and t or u and v, or a glTF with TEXCOORD_0 is wanted");
}

std::string source_name(const std::string& name) {
  return name.starts_with("builtin:") ? name : std::filesystem::path(name).filename().string();
}

std::string hash_of(const TriangleMesh& mesh) {
  Hash hash;
  hash.add(std::span<const Vec3d>(mesh.positions));
  hash.add(std::span<const Triangle>(mesh.triangles));
  return hash.text();
}

// Seed triangles are numbered as in the input file; repair may have dropped some.
int repaired_triangle(const RepairedMesh& input, int triangle) {
  if (triangle < 0) return triangle;
  const auto& sources = input.source_triangle;
  const auto found = std::find(sources.begin(), sources.end(), triangle);
  if (found == sources.end())
    throw TopologyError("seed triangle",
                        fmt::format("{} is not in the surface that is converted", triangle),
                        "a triangle of it, counted from 0 in the order of its file, is wanted");
  return static_cast<int>(found - sources.begin());
}

Cut first_cut(Conversion& made, const ConvertOptions& options) {
  const TriangleMesh& mesh = made.input.mesh;
  const CutOptions cut{.seed_triangle = repaired_triangle(made.input, options.seed_triangle)};
  if (!options.seam) return open_to_disk(mesh, cut);
  SeamCut along = cut_along_seam(mesh, made.input.source_vertex, *options.seam, cut);
  if (along.added_edges > 0)
    made.warnings.push_back(fmt::format(
        "{}: the seam does not open the mesh to a disk, {} edge{} were added to the cut",
        options.seam->name, along.added_edges, along.added_edges == 1 ? "" : "s"));
  return std::move(along.cut);
}

// Extended cuts are evaluated on a coarse proxy, where slivers can mislead: a high stretch is a
// sign of that.
bool is_suspicious(const MappedDisk& mapped) {
  constexpr double most = 1.5;
  return mapped.parameterizer == "stretch" && mapped.quality.stretch_l2 > most;
}

// Maps the extended cut, or the plain one where the extension turns out to raise the stretch.
void cut_and_map(Conversion& made, const std::string& name, const ConvertOptions& options) {
  const TriangleMesh& mesh = made.input.mesh;
  Stopwatch watch;
  update(options.progress, "cut", 0);
  const Cut cut = first_cut(made, options);
  const int size = options.size != automatic_size
                       ? options.size
                       : suitable_size(cut_open(mesh, cut), made.input.counts.vertices);
  AugmentedCut augmented{cut, 0};
  if (options.augment && !options.seam)
    augmented = augment_cut(mesh, cut, {.size = size, .progress = options.progress});
  made.seconds.cut = watch.lap();

  MapOptions map;
  map.size = size;
  map.parameterizer = options.parameterizer;
  map.name = name;
  map.progress = options.progress;
  MappedDisk mapped = map_to_square(cut_open(mesh, augmented.cut), map);
  if (augmented.rounds > 0 && is_suspicious(mapped)) {
    MappedDisk plain = map_to_square(cut_open(mesh, cut), map);
    if (plain.quality.stretch_l2 < mapped.quality.stretch_l2) {
      mapped = std::move(plain);
      augmented = {cut, 0};
    }
  }
  made.cut = summarise(cut_open(mesh, augmented.cut));
  made.rounds = augmented.rounds;
  made.map_quality = mapped.quality;
  made.parameterizer = mapped.parameterizer;
  made.mapped = std::make_shared<MappedDisk>(std::move(mapped));
  made.seconds.map = watch.lap();
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

void sample(Conversion& made, const std::string& name, const ConvertOptions& options) {
  Stopwatch watch;
  update(options.progress, "sample", 0);
  made.image = sample_image(*made.mapped);
  if (options.fit_samples)
    made.image = fit_samples(*made.mapped, made.image, {.progress = options.progress});
  made.image.source = source_name(name);
  made.image.source_hash = hash_of(made.input.mesh);
  if (options.normal_map_size > 0)
    made.normals = sample_normals(*made.mapped, options.normal_map_size);
  if (options.keep_uv) made.texture = sample_texture(*made.mapped, made.input.mesh);
  made.quality = measure_topology(made.image);
  require_topology(made, name);
  made.seconds.sample = watch.lap();
}

}  // namespace

Conversion convert_mesh(const TriangleMesh& mesh, const std::string& name,
                        const ConvertOptions& options) {
  check_size(options.size);
  if (options.normal_map_size != 0) check_size(options.normal_map_size);
  if (options.keep_uv) check_texture(mesh, name);
  Stopwatch watch;
  Conversion made;
  update(options.progress, "repair", 0);
  made.input = repair_mesh(mesh, {.name = name, .component = options.component});
  made.seconds.load = watch.lap();
  named(name, [&] {
    cut_and_map(made, name, options);
    sample(made, name, options);
  });
  watch.lap();
  if (options.measure) {
    update(options.progress, "measure", 0);
    made.quality = measure_image(made.image, made.input.mesh,
                                 {options.threads, options.seed, options.progress});
    made.seconds.measure = watch.lap();
  }
  const StageSeconds& s = made.seconds;
  made.seconds.total = s.load + s.cut + s.map + s.sample + s.measure;
  return made;
}

CutPreview preview_cut(const TriangleMesh& mesh, const std::string& name,
                       const CutPreviewOptions& options) {
  CutPreview made;
  made.input = repair_mesh(mesh, {name, {}});
  Cut cut = open_to_disk(made.input.mesh);
  CutDisk disk = cut_open(made.input.mesh, cut);
  made.min_size = min_size(disk);
  if (options.augment)
    disk = cut_open(
        made.input.mesh,
        augment_cut(made.input.mesh, cut, {.size = options.size, .progress = options.progress})
            .cut);
  made.disk = std::make_shared<CutDisk>(std::move(disk));
  return made;
}

}  // namespace weft
