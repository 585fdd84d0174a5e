#include "weft/param/progressive_embedding.h"

#include "weft/param/collapse_passes.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/reinsertion.h"

namespace weft {

bool embed_progressively(const DiskMesh& disk, std::span<Vec2d> uv, Progress* progress) {
  constexpr StarTriangle equal_sides{{1, 0.5, 1, 0.4330127018922193}};
  CollapseHierarchy mesh(disk);
  collapse_in_passes(mesh, min_valence_first(), {.triangles = 0, .first_cost = 6, .growth = 1.25});

  Box3d box;
  for (const int v : disk.border) box.add({uv[v].x, uv[v].y, 0});
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_inner(v)) uv[v] = {box.centre().x, box.centre().y};
  ReinsertionOptions options;
  options.triangle = [&](const Triangle&) { return equal_sides; };
  options.progress = progress;
  return bring_back(mesh, uv, options) && is_valid_map(disk.triangles, uv);
}

}  // namespace weft
