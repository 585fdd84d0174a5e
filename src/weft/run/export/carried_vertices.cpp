// The vertices of input meshes in memory, as exports on the input write them.
#include <optional>
#include <string>
#include <utility>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/run.h"
#include "weft/run/export/exported_surface.h"
#include "weft/run/export/surface_points.h"

namespace weft {

/// What the binding refers to, kept here so that it needs no simulation.
struct CarriedVertices::Parts {
  Parts(const SimulatedCloth& cloth, const Placement& placement)
      : image(cloth.image),
        source(*cloth.source),
        rest(cloth.model->start_positions()),
        grid(surface_points(image, false)),
        surface(grid, ExportedSurface::Source{&image, &source, &rest, placement_map(placement)},
                MeshFrame{}) {}

  GeometryImage image;
  SourceMesh source;
  Planes3 rest;
  SurfacePoints grid;
  ExportedSurface surface;
};

CarriedVertices::CarriedVertices(const Simulation& simulation, std::size_t cloth,
                                 const Placement& placement) {
  const SimulatedCloth& carrying = simulation.cloths()[cloth];
  if (!carrying.source)
    throw UsageError("", "cloth '" + carrying.name + "' is a geometry image",
                     "a cloth that was made from a mesh is wanted");
  parts_ = std::make_unique<Parts>(carrying, placement);
}

CarriedVertices::~CarriedVertices() = default;

std::vector<Vec3f> CarriedVertices::positions(const Planes3& samples) const {
  return parts_->surface.points(samples);
}

}  // namespace weft
