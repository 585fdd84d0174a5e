#include "weft/mesh/shapes/skirt.h"

#include <array>

#include "weft/mesh/shapes/field.h"
#include "weft/mesh/shapes/mannequin.h"
#include "weft/mesh/shapes/patch.h"
#include "weft/mesh/shapes/polygonise.h"
#include "weft/mesh/shapes/remesh.h"
#include "weft/mesh/shapes/rings.h"

namespace weft {
namespace {

constexpr double hem_height = 0.50, waist_height = 1.06;
constexpr double clearance = 0.015;  // from the body, where the cloth is closest [m]

/// How the cloth hangs; where these are within the body, the body decides. The waist is narrower
/// than the hips, which carry the skirt.
constexpr std::array skirt_sections{
    Section{0.460, 0.322, 0.250, -0.290}, Section{0.560, 0.292, 0.222, -0.262},
    Section{0.660, 0.262, 0.194, -0.234}, Section{0.760, 0.234, 0.168, -0.206},
    Section{0.840, 0.213, 0.147, -0.181}, Section{0.920, 0.192, 0.130, -0.155},
    Section{1.000, 0.170, 0.120, -0.124}, Section{1.060, 0.154, 0.116, -0.101},
    Section{1.120, 0.152, 0.116, -0.096}};

double skirt_field(Vec3d p) {
  constexpr double drape = 0.03;
  return smooth_min(mannequin_body_field(p) - clearance, distance_to_sections(skirt_sections, p),
                    drape);
}

/// Negative where there is cloth; near each opening the smooth function of that opening alone.
double skirt_cut(Vec3d p) {
  constexpr double between = 0.8;
  return p.y < between ? hem_height - p.y : p.y - waist_height;
}

double edge_length(Vec3d /*place*/) { return 0.018; }

}  // namespace

TriangleMesh skirt_mesh() {
  // The box ends beyond the openings, where the clipping takes everything, and before the arms.
  Box3d box;
  box.add({-0.36, 0.470, -0.34});
  box.add({0.36, 1.090, 0.30});
  constexpr double cell = 0.018;
  return remesh(clip(polygonise(skirt_field, box, cell), skirt_cut),
                {.surface = skirt_field, .cut = skirt_cut, .edge_length = edge_length});
}

}  // namespace weft
