#include "weft/mesh/shapes/garments.h"

#include <array>
#include <cmath>

#include "weft/mesh/shapes/field.h"
#include "weft/mesh/shapes/mannequin.h"
#include "weft/mesh/shapes/patch.h"
#include "weft/mesh/shapes/remesh.h"
#include "weft/mesh/shapes/rings.h"

namespace weft {
namespace {

constexpr double skirt_hem_height = 0.50, waist_height = 1.06;
constexpr double skirt_clearance = 0.015;  // from the body, where the cloth is closest [m]

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
  return smooth_min(mannequin_body_field(p) - skirt_clearance,
                    distance_to_sections(skirt_sections, p), drape);
}

/// Negative where there is cloth; near each opening the smooth function of that opening alone.
double skirt_cut(Vec3d p) {
  constexpr double between = 0.8;
  return p.y < between ? skirt_hem_height - p.y : p.y - waist_height;
}

double skirt_edge_length(Vec3d /*place*/) { return 0.018; }

}  // namespace

TriangleMesh skirt_mesh() {
  // The box ends beyond the openings, where the clipping takes everything, and before the arms.
  Box3d box;
  box.add({-0.36, 0.470, -0.34});
  box.add({0.36, 1.090, 0.30});
  constexpr double cell = 0.018;
  return remesh(clip(polygonise(skirt_field, box, cell), skirt_cut),
                {.surface = skirt_field, .cut = skirt_cut, .edge_length = skirt_edge_length});
}

namespace {

constexpr double clearance = 0.014;  // from the body, where the cloth is closest [m]

/// How the cloth hangs around the trunk; where these are within the body, the body decides.
constexpr std::array loose_sections{
    Section{0.780, 0.190, 0.116, -0.134}, Section{0.900, 0.185, 0.118, -0.134},
    Section{1.000, 0.175, 0.118, -0.122}, Section{1.100, 0.163, 0.118, -0.108},
    Section{1.200, 0.162, 0.122, -0.110}, Section{1.300, 0.164, 0.120, -0.116},
    Section{1.380, 0.146, 0.086, -0.108}, Section{1.430, 0.100, 0.045, -0.090},
    Section{1.470, 0.055, 0.025, -0.062}, Section{1.500, 0.020, 0.010, -0.040}};

/// Along the arm, where the cut of the sleeve ends.
constexpr double sleeve_length = 0.185, hem_height = 0.865;

Vec3d mirrored(Vec3d p) { return {std::abs(p.x), p.y, p.z}; }

Vec3d arm_direction() {
  const UpperArm arm = mannequin_upper_arm();
  return normalized(arm.elbow - arm.shoulder);
}

const Limb& sleeve() {
  static const Limb limb = [] {
    const UpperArm arm = mannequin_upper_arm();
    const std::array<Limb::Joint, 2> joints{{{arm.shoulder, 0.056}, {arm.elbow, 0.076}}};
    return Limb(joints);
  }();
  return limb;
}

double tshirt_field(Vec3d p) {
  constexpr double drape = 0.045;
  const double trunk = smooth_min(mannequin_body_field(p) - clearance,
                                  distance_to_sections(loose_sections, p), drape);
  return smooth_min(trunk, distance_to(sleeve(), mirrored(p)), drape);
}

/// What is cut away around the neck.
constexpr Ellipsoid neck_opening{{0, 1.492, -0.002}, {0.098, 0.075, 0.098}};

/// Negative where there is cloth. Near each opening it is the smooth function of that opening
/// alone.
double tshirt_cut(Vec3d p) {
  constexpr double beyond_trunk = 0.22, below_neck = 1.38;
  const Vec3d half = mirrored(p);
  if (half.x > beyond_trunk)
    return dot(half - mannequin_upper_arm().shoulder, arm_direction()) - sleeve_length;
  return p.y < below_neck ? hem_height - p.y : -distance_to(neck_opening, p);
}

double tshirt_edge_length(Vec3d /*place*/) { return 0.0165; }

}  // namespace

TriangleMesh tshirt_mesh() {
  // The box ends outside the openings: what it cuts off would be clipped anyway.
  Box3d box;
  box.add({-0.42, 0.840, -0.20});
  box.add({0.42, 1.515, 0.20});
  constexpr double cell = 0.015;
  return remesh(clip(polygonise(tshirt_field, box, cell), tshirt_cut),
                {.surface = tshirt_field, .cut = tshirt_cut, .edge_length = tshirt_edge_length});
}

}  // namespace weft
