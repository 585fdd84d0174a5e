#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "weft/convert/automatic_size.h"
#include "weft/core/progress.h"
#include "weft/cut/open_to_disk.h"
#include "weft/cut/seam.h"
#include "weft/image/geometry_image.h"
#include "weft/image/image_quality.h"
#include "weft/mesh/repair.h"
#include "weft/mesh/units.h"
#include "weft/param/square_map.h"

namespace weft {

struct ConvertOptions {
  int size = 257;  ///< or automatic_size; the image tells which it was
  Parameterizer parameterizer = StretchOptions{};
  ComponentChoice component;
  int seed_triangle = -1;    ///< of the input, before repair; -1: choose
  std::optional<Seam> seam;  ///< cut here, and elsewhere only as far as it must be for a disk
  bool augment = true;
  int normal_map_size = 0;   ///< 0: none
  bool keep_uv = false;      ///< sample the mesh's own texture coordinates too
  bool keep_places = false;  ///< tell where on the mesh each sample lies (load_surface)
  bool keep_source = false;  ///< keep the mesh and where its vertices lie (load_surface)
  MeshFrame files;           ///< what the numbers of mesh files mean (load_surface)
  bool fit_samples =
      false;               ///< move samples so that the triangles between them fit, see fit_samples
  bool measure = true;     ///< stage 11
  std::uint64_t seed = 1;  ///< of the samples that stage 11 measures by
  int threads = 1;
  Progress* progress = nullptr;
};

/// Wall-clock seconds of `convert_mesh`; `load` is checking and repairing (reading is the
/// caller's).
struct StageSeconds {
  double load = 0, cut = 0, map = 0, sample = 0, measure = 0, total = 0;
};

/// Everything that a conversion made and found.
struct Conversion {
  RepairedMesh input;
  std::vector<std::string> warnings;  ///< what was not done as asked for
  CutSummary cut;
  int rounds = 0;
  MappedDisk mapped;
  GeometryImage image;
  std::optional<NormalMap> normals;
  std::optional<Planes3> texture;  ///< with keep_uv: x = u, y = v (see sample_texture)
  ImageQuality quality;
  StageSeconds seconds;
};

/// The whole way from a mesh to its geometry image. The image's mates are bit-equal and the
/// topology of the rebuilt mesh is the input's, or it throws.
/// @param name  what errors and the image's metadata call the mesh: a path or builtin:NAME
/// The seam's vertices are those of `mesh`, before repair.
/// @throws InputError, TopologyError as the stages, InputError when texture coordinates are to be
///         kept and the mesh lacks them; UsageError for a size that no image may have
Conversion convert_mesh(const TriangleMesh& mesh, const std::string& name,
                        const ConvertOptions& options);

}  // namespace weft
