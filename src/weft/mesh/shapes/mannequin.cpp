#include "weft/mesh/shapes/mannequin.h"

#include <array>
#include <cmath>
#include <span>

#include "weft/mesh/shapes/field.h"
#include "weft/mesh/shapes/remesh.h"
#include "weft/mesh/shapes/rings.h"

namespace weft {
namespace {

// All lengths in metres; paired parts are given at x > 0.

constexpr std::array trunk_sections{
    Section{0.780, 0.120, 0.060, -0.080}, Section{0.840, 0.158, 0.080, -0.100},
    Section{0.900, 0.169, 0.092, -0.112}, Section{0.960, 0.160, 0.098, -0.104},
    Section{1.020, 0.143, 0.098, -0.086}, Section{1.080, 0.132, 0.096, -0.076},
    Section{1.140, 0.135, 0.101, -0.080}, Section{1.210, 0.147, 0.110, -0.093},
    Section{1.280, 0.158, 0.115, -0.104}, Section{1.340, 0.160, 0.104, -0.110},
    Section{1.390, 0.146, 0.078, -0.106}, Section{1.430, 0.108, 0.050, -0.094},
    Section{1.465, 0.066, 0.038, -0.076}, Section{1.500, 0.054, 0.044, -0.064},
    Section{1.545, 0.053, 0.054, -0.058}, Section{1.600, 0.053, 0.058, -0.056}};

/// A part that is joined to what came before with a fillet.
template <class Shape>
struct Part {
  Shape shape;
  double blend;
};

constexpr Vec3d shoulder{0.168, 1.398, -0.016}, elbow{0.372, 1.190, -0.022},
    wrist{0.536, 0.998, 0.026};

/// Shoulder slope, chest and seat: what makes the trunk more than a barrel.
const std::array trunk_cones{
    Part<RoundCone>{{{0.030, 1.478, -0.030}, {0.158, 1.412, -0.018}, 0.036, 0.044}, 0.040},
    Part<RoundCone>{{{0.125, 1.300, -0.040}, {0.165, 1.385, -0.020}, 0.050, 0.050}, 0.050}};
constexpr std::array trunk_ellipsoids{
    Part<Ellipsoid>{{{0.072, 1.292, 0.068}, {0.074, 0.058, 0.048}}, 0.030},
    Part<Ellipsoid>{{{0.078, 0.890, -0.062}, {0.080, 0.085, 0.068}}, 0.030}};

constexpr std::array<Limb::Joint, 9> arm_joints{{{{0.150, 1.405, -0.018}, 0.050},
                                                 {{0.196, 1.378, -0.017}, 0.055},
                                                 {{0.240, 1.326, -0.015}, 0.049},
                                                 {{0.300, 1.264, -0.012}, 0.046},
                                                 {elbow, 0.037},
                                                 {{0.414, 1.141, -0.006}, 0.039},
                                                 {{0.470, 1.075, 0.010}, 0.033},
                                                 {wrist, 0.025},
                                                 {{0.556, 0.972, 0.032}, 0.024}}};

constexpr std::array<Limb::Joint, 12> leg_joints{{{{0.086, 0.930, -0.010}, 0.072},
                                                  {{0.094, 0.850, -0.004}, 0.083},
                                                  {{0.099, 0.760, 0.002}, 0.080},
                                                  {{0.105, 0.650, 0.008}, 0.069},
                                                  {{0.111, 0.550, 0.008}, 0.056},
                                                  {{0.114, 0.480, 0.004}, 0.049},
                                                  {{0.116, 0.420, -0.008}, 0.050},
                                                  {{0.119, 0.350, -0.018}, 0.0535},
                                                  {{0.122, 0.270, -0.020}, 0.046},
                                                  {{0.125, 0.180, -0.022}, 0.035},
                                                  {{0.128, 0.100, -0.026}, 0.031},
                                                  {{0.129, 0.040, -0.036}, 0.033}}};

/// A flat hand, palm to the thigh: fingers side by side that touch, and a thumb.
const std::array hand_cones{
    Part<RoundCone>{{{0.545, 0.988, 0.044}, {0.594, 0.920, 0.068}, 0.017, 0.0150}, 0.018},
    Part<RoundCone>{{{0.544, 0.986, 0.036}, {0.592, 0.914, 0.0505}, 0.018, 0.0155}, 0.014},
    Part<RoundCone>{{{0.542, 0.984, 0.028}, {0.588, 0.912, 0.033}, 0.018, 0.0150}, 0.014},
    Part<RoundCone>{{{0.540, 0.984, 0.020}, {0.582, 0.914, 0.0165}, 0.017, 0.0140}, 0.014},
    Part<RoundCone>{{{0.594, 0.920, 0.068}, {0.624, 0.844, 0.066}, 0.0135, 0.0100}, 0.012},
    Part<RoundCone>{{{0.592, 0.914, 0.0505}, {0.624, 0.833, 0.051}, 0.0140, 0.0100}, 0.012},
    Part<RoundCone>{{{0.588, 0.912, 0.033}, {0.619, 0.836, 0.036}, 0.0135, 0.0100}, 0.012},
    Part<RoundCone>{{{0.582, 0.914, 0.0165}, {0.610, 0.850, 0.021}, 0.0125, 0.0095}, 0.012},
    Part<RoundCone>{{{0.548, 0.978, 0.048}, {0.562, 0.934, 0.084}, 0.0180, 0.0150}, 0.018},
    Part<RoundCone>{{{0.562, 0.934, 0.084}, {0.576, 0.890, 0.106}, 0.0150, 0.0110}, 0.018}};

const std::array foot_cones{
    Part<RoundCone>{{{0.129, 0.085, -0.010}, {0.140, 0.028, 0.100}, 0.036, 0.032}, 0.030},
    Part<RoundCone>{{{0.129, 0.024, -0.035}, {0.158, 0.016, 0.095}, 0.036, 0.032}, 0.030},
    Part<RoundCone>{{{0.134, 0.024, 0.090}, {0.146, 0.010, 0.168}, 0.034, 0.024}, 0.020},
    Part<RoundCone>{{{0.158, 0.018, 0.085}, {0.172, 0.008, 0.140}, 0.032, 0.022}, 0.020}};

constexpr std::array head_ellipsoids{
    Part<Ellipsoid>{{{0.000, 1.654, -0.008}, {0.077, 0.095, 0.098}}, 0.020},
    Part<Ellipsoid>{{{0.000, 1.670, 0.032}, {0.060, 0.060, 0.064}}, 0.040},
    Part<Ellipsoid>{{{0.000, 1.602, 0.028}, {0.060, 0.084, 0.070}}, 0.040}};
const std::array head_pairs{
    Part<RoundCone>{{{0.004, 1.534, 0.074}, {0.050, 1.568, 0.006}, 0.018, 0.018}, 0.030},
    Part<RoundCone>{{{0.012, 1.650, 0.090}, {0.042, 1.648, 0.074}, 0.009, 0.009}, 0.020}};
const Part<RoundCone> nose{{{0, 1.642, 0.098}, {0, 1.604, 0.110}, 0.007, 0.013}, 0.016};
constexpr Part<Ellipsoid> lips{{{0, 1.568, 0.090}, {0.024, 0.009, 0.011}}, 0.012};
constexpr Part<Ellipsoid> eye_socket{{{0.033, 1.630, 0.110}, {0.018, 0.011, 0.020}}, 0.018};
constexpr Part<Ellipsoid> ear{{{0.077, 1.612, -0.010}, {0.008, 0.032, 0.018}}, 0.008};

template <class Shape>
double joined(double field, const Part<Shape>& part, Vec3d point) {
  return smooth_min(field, distance_to(part.shape, point), part.blend);
}

template <class Parts>
double all_joined(double field, const Parts& parts, Vec3d point) {
  for (const auto& part : parts) field = joined(field, part, point);
  return field;
}

/// Both halves at once: |x|, rounded so that nothing creases in the middle.
Vec3d folded(Vec3d point) {
  constexpr double rounding = 0.006;
  return {std::sqrt(point.x * point.x + rounding * rounding), point.y, point.z};
}

/// The trunk, which ends inside the legs and inside the head.
double trunk(Vec3d point) {
  constexpr double crotch = 0.80, skull = 1.62, rounding = 0.04;
  const double beyond = std::fmax(crotch - point.y, point.y - skull);
  return smooth_max(distance_to_sections(trunk_sections, point), beyond, rounding);
}

double with_head(double field, Vec3d point) {
  const Vec3d half = folded(point);
  field = all_joined(field, head_ellipsoids, point);
  field = all_joined(field, head_pairs, half);
  field = smooth_max(field, -distance_to(eye_socket.shape, half), eye_socket.blend);
  field = joined(field, nose, point);
  field = joined(field, lips, point);
  return joined(field, ear, half);
}

/// Whether parts within a box cannot change a field at a point: a smooth minimum has no effect
/// where its values differ by more than the blend.
bool out_of_reach(const Box3d& box, double field, Vec3d point) {
  constexpr double largest_blend = 0.05;
  return distance_to(box, point) > std::fmax(field, 0) + largest_blend;
}

/// A limb that is farther than its blend makes no difference: twice that is far enough to know.
double with_limb(double field, const Limb& limb, Vec3d point, double blend) {
  return smooth_min(field, distance_to(limb, point, field + 2 * blend), blend);
}

const Limb& arm() {
  static const Limb limb(arm_joints);
  return limb;
}

const Limb& leg() {
  static const Limb limb(leg_joints);
  return limb;
}

constexpr Box3d head_box{{-0.10, 1.48, -0.12}, {0.10, 1.76, 0.14}};
constexpr Box3d hand_box{{0.50, 0.80, -0.02}, {0.66, 1.02, 0.13}};
constexpr Box3d foot_box{{0.06, -0.03, -0.09}, {0.21, 0.14, 0.20}};

}  // namespace

double mannequin_body_field(Vec3d point) {
  constexpr double armpit = 0.045, groin = 0.035, sole_edge = 0.008;  // fillets
  const Vec3d half = folded(point);
  double field = trunk(point);
  field = all_joined(field, trunk_cones, half);
  field = all_joined(field, trunk_ellipsoids, half);
  if (!out_of_reach(arm().box, field, half)) field = with_limb(field, arm(), half, armpit);
  if (!out_of_reach(leg().box, field, half)) field = with_limb(field, leg(), half, groin);
  if (!out_of_reach(hand_box, field, half)) field = all_joined(field, hand_cones, half);
  if (!out_of_reach(foot_box, field, half)) field = all_joined(field, foot_cones, half);
  return smooth_max(field, -point.y, sole_edge);
}

double mannequin_field(Vec3d point) {
  const double body = mannequin_body_field(point);
  return out_of_reach(head_box, body, point) ? body : with_head(body, point);
}

UpperArm mannequin_upper_arm() { return {shoulder, elbow}; }

namespace {

/// The wanted edge length near a place: `fine` within its reach, linear up to `coarse` at twice
/// the reach.
double finer_near(double coarse, double fine, double distance_over_reach) {
  const double t = std::fmin(1.0, std::fmax(0.0, distance_over_reach - 1));
  return fine + (coarse - fine) * t;
}

double edge_length(Vec3d p) {
  constexpr double body = 0.0255, face = 0.0105, hand = 0.0095, foot = 0.0135;
  const Vec3d half{std::abs(p.x), p.y, p.z};
  const double at_face = finer_near(body, face, length(p - Vec3d{0, 1.60, 0.07}) / 0.11);
  const double at_hand = finer_near(body, hand, length(half - Vec3d{0.59, 0.91, 0.05}) / 0.11);
  const double at_foot = finer_near(body, foot, length(half - Vec3d{0.14, 0.03, 0.06}) / 0.13);
  return std::fmin(at_face, std::fmin(at_hand, at_foot));
}

}  // namespace

namespace {

TriangleMesh made_mannequin() {
  Box3d box;
  box.add({-0.68, -0.03, -0.18});
  box.add({0.68, 1.79, 0.24});
  constexpr double cell = 0.015;
  return remesh(polygonise(mannequin_field, box, cell),
                {.surface = mannequin_field, .cut = {}, .edge_length = edge_length});
}

}  // namespace

TriangleMesh mannequin_mesh() {
  static const TriangleMesh made = made_mannequin();  // takes a second, and scenes ask twice
  return made;
}

}  // namespace weft
