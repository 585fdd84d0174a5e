#include "weft/mesh/shapes/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "weft/core/assert.h"

namespace weft {
namespace {

/// Corners of a cube by bits: 1 for x, 2 for y, 4 for z.
constexpr int corners = 8;
/// The six tetrahedra that share the diagonal from corner 0 to corner 7, each with positive volume.
constexpr std::array<std::array<int, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};

/// Even permutations of a tetrahedron's corners that begin with the corners inside: one, or two.
constexpr std::array<std::array<int, 4>, 4> one_first{
    {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};
constexpr std::array<std::array<int, 4>, 6> two_first{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

class Polygoniser {
 public:
  Polygoniser(const Field& field, const Box3d& box, double cell);
  TriangleMesh run();

 private:
  [[nodiscard]] int point(int i, int j, int k) const { return (k * ny_ + j) * nx_ + i; }
  [[nodiscard]] Vec3d place(int point) const;
  [[nodiscard]] bool inside(int point) const { return values_[point] < 0; }
  int vertex(int cube, int corner_a, int corner_b);
  void add_tetrahedron(int cube, const std::array<int, 4>& corner);

  Vec3d lower_;
  double cell_;
  int nx_, ny_, nz_;
  std::array<int, corners> step_;  // from a cube's first point to its corners
  std::vector<double> values_;     // [points]
  std::vector<int> vertex_of_;  // [points * corners] by the lower end and the direction of an edge
  TriangleMesh mesh_;
};

int points_along(double extent, double cell) { return static_cast<int>(extent / cell) + 2; }

Polygoniser::Polygoniser(const Field& field, const Box3d& box, double cell)
    : lower_(box.lower),
      cell_(cell),
      nx_(points_along(box.extent().x, cell)),
      ny_(points_along(box.extent().y, cell)),
      nz_(points_along(box.extent().z, cell)),
      step_{},
      values_(static_cast<std::size_t>(nx_) * ny_ * nz_),
      vertex_of_(values_.size() * corners, -1) {
  for (int c = 0; c < corners; ++c) step_[c] = point(c & 1, c >> 1 & 1, c >> 2);
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = field(place(static_cast<int>(i)));
}

Vec3d Polygoniser::place(int point) const {
  const int i = point % nx_, j = point / nx_ % ny_, k = point / (nx_ * ny_);
  return lower_ +
         cell_ * Vec3d{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
}

int Polygoniser::vertex(int cube, int corner_a, int corner_b) {
  const auto [low, high] = std::minmax(corner_a, corner_b);
  const int a = cube + step_[low], b = cube + step_[high];
  int& known = vertex_of_[static_cast<std::size_t>(a) * corners + (high - low)];
  if (known < 0) {
    // Kept off the ends, where many vertices would meet in one point.
    const double t = std::clamp(values_[a] / (values_[a] - values_[b]), 0.05, 0.95);
    known = static_cast<int>(mesh_.positions.size());
    mesh_.positions.push_back((1 - t) * place(a) + t * place(b));
  }
  return known;
}

void Polygoniser::add_tetrahedron(int cube, const std::array<int, 4>& corner) {
  std::array<bool, 4> is_inside{};
  for (int i = 0; i < 4; ++i) is_inside[i] = inside(cube + step_[corner[i]]);
  const auto count = std::count(is_inside.begin(), is_inside.end(), true);
  if (count == 0 || count == 4) return;
  const auto cut = [&](const std::array<int, 4>& order, int i, int j) {
    return vertex(cube, corner[order[i]], corner[order[j]]);
  };
  if (count == 2) {
    for (const auto& o : two_first) {
      if (!is_inside[o[0]] || !is_inside[o[1]]) continue;
      const int a = cut(o, 0, 2), b = cut(o, 0, 3), c = cut(o, 1, 3), d = cut(o, 1, 2);
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    }
    return;
  }
  const bool lone_is_inside = count == 1;
  const auto lone =
      std::find(is_inside.begin(), is_inside.end(), lone_is_inside) - is_inside.begin();
  const auto& o = one_first[lone];
  const int a = cut(o, 0, 1), b = cut(o, 0, 2), c = cut(o, 0, 3);
  mesh_.triangles.push_back(lone_is_inside ? Triangle{a, b, c} : Triangle{a, c, b});
}

TriangleMesh Polygoniser::run() {
  for (int k = 0; k + 1 < nz_; ++k)
    for (int j = 0; j + 1 < ny_; ++j)
      for (int i = 0; i + 1 < nx_; ++i)
        for (const auto& tetrahedron : tetrahedra) add_tetrahedron(point(i, j, k), tetrahedron);
  return std::move(mesh_);
}

constexpr int newton_steps = 12;
constexpr double close_enough = 1e-9;  // [m]

}  // namespace

RoundCone::RoundCone(Vec3d a_end, Vec3d b_end, double radius_at_a, double radius_at_b)
    : a(a_end),
      b(b_end),
      radius_a(radius_at_a),
      radius_b(radius_at_b),
      axis(b - a),
      axis_length(length(axis)),
      slope((radius_a - radius_b) / axis_length),
      cosine(std::sqrt(1 - slope * slope)) {}

double distance_to(const RoundCone& cone, Vec3d point) {
  const Vec3d from_a = point - cone.a;
  const double along = dot(from_a, cone.axis) / cone.axis_length;
  const double beside = std::sqrt(std::max(0.0, squared_length(from_a) - along * along));
  // The ball nearest to the point: |point - centre(t)| - radius(t) is convex in t, and stationary
  // here.
  const double t = std::clamp(along - beside * cone.slope / cone.cosine, 0.0, cone.axis_length);
  return std::sqrt(beside * beside + (along - t) * (along - t)) - (cone.radius_a - cone.slope * t);
}

double distance_to(const Ellipsoid& ellipsoid, Vec3d point) {
  const Vec3d r = ellipsoid.radii, p = point - ellipsoid.centre;
  const Vec3d scaled{p.x / r.x, p.y / r.y, p.z / r.z};
  const double level = length(scaled);
  const double slope = length(Vec3d{scaled.x / r.x, scaled.y / r.y, scaled.z / r.z});
  if (slope == 0) return -std::min({r.x, r.y, r.z});
  return level * (level - 1) / slope;
}

Limb::Limb(std::span<const Joint> joints) {
  WEFT_ASSERT(joints.size() >= 2 && joints.size() <= max_joints);
  const auto blend = [](double wa, const Joint& a, double wb, const Joint& b) {
    return Joint{wa * a.centre + wb * b.centre, wa * a.radius + wb * b.radius};
  };
  const int last = static_cast<int>(joints.size()) - 1;
  Joint before = joints[0];
  for (int i = 0; i < last; ++i) {
    const Joint &a = joints[i], &b = joints[i + 1];
    const Joint slope_a = blend(0.5, b, -0.5, joints[std::max(i - 1, 0)]);
    const Joint slope_b = blend(0.5, joints[std::min(i + 2, last)], -0.5, a);
    for (int part = 1; part <= parts; ++part) {
      const double t = static_cast<double>(part) / parts, rest = 1 - t;
      const Joint here = blend(1, blend(rest * rest * (1 + 2 * t), a, t * t * (1 + 2 * rest), b), 1,
                               blend(t * rest * rest, slope_a, -t * t * rest, slope_b));
      cones.emplace_back(before.centre, here.centre, before.radius, here.radius);
      before = here;
    }
  }
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const RoundCone& cone = cones[i];
    const Vec3d middle = 0.5 * (cone.a + cone.b);
    const double radius = std::max(cone.radius_a, cone.radius_b);
    balls.x[i] = middle.x;
    balls.y[i] = middle.y;
    balls.z[i] = middle.z;
    balls.radius[i] = 0.5 * length(cone.b - cone.a) + radius;
    for (const Vec3d end : {cone.a, cone.b}) {
      box.add(end + Vec3d{radius, radius, radius});
      box.add(end - Vec3d{radius, radius, radius});
    }
  }
}

double distance_to(const Limb& limb, Vec3d point, double enough) {
  constexpr double rounding = 1e-9;  // more than sums round, so that the least is found to the bit
  const int count = static_cast<int>(limb.cones.size());
  std::array<double, Limb::max_cones> squared;  // from the balls' centres
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double x = point.x - limb.balls.x[i], y = point.y - limb.balls.y[i],
                 z = point.z - limb.balls.z[i];
    squared[i] = x * x + y * y + z * z;
  }
  int first = 0;  // near enough for a bound by which most of the others are left out
  for (int i = Limb::parts; i < count; i += Limb::parts)
    if (squared[i] < squared[first]) first = i;
  double min = std::min(enough, distance_to(limb.cones[first], point));
  for (int i = 0; i < count; ++i) {
    const double nearer = min + limb.balls.radius[i] + rounding;
    if (i != first && nearer > 0 && squared[i] < nearer * nearer)
      min = std::min(min, distance_to(limb.cones[i], point));
  }
  return min;
}

double distance_to(const Box3d& box, Vec3d point) {
  return length(max(max(box.lower - point, point - box.upper), Vec3d{}));
}

double smooth_min(double a, double b, double blend) {
  const double overlap = std::max(0.0, blend - std::abs(a - b));
  return std::min(a, b) - overlap * overlap / (4 * blend);
}

double smooth_max(double a, double b, double blend) { return -smooth_min(-a, -b, blend); }

Vec3d gradient(const Field& field, Vec3d point) {
  constexpr double step = 1e-4;
  const auto slope = [&](Vec3d d) { return (field(point + d) - field(point - d)) / (2 * step); };
  return {slope({step, 0, 0}), slope({0, step, 0}), slope({0, 0, step})};
}

Vec3d project_to_surface(const Field& field, Vec3d point) {
  for (int i = 0; i < newton_steps; ++i) {
    const double value = field(point);
    if (std::abs(value) < close_enough) break;
    const Vec3d slope = gradient(field, point);
    const double squared = squared_length(slope);
    if (squared == 0) break;
    point -= (value / squared) * slope;
  }
  return point;
}

Vec3d project_to_curve(const Field& first, const Field& second, Vec3d point) {
  for (int i = 0; i < newton_steps; ++i) {
    const double f = first(point), g = second(point);
    if (std::abs(f) < close_enough && std::abs(g) < close_enough) break;
    const Vec3d df = gradient(first, point), dg = gradient(second, point);
    // The shortest step that brings both to zero lies in the plane of the two gradients.
    const double ff = squared_length(df), fg = dot(df, dg), gg = squared_length(dg);
    const double determinant = ff * gg - fg * fg;
    if (determinant <= 1e-6 * ff * gg) break;
    point -= ((f * gg - g * fg) / determinant) * df + ((g * ff - f * fg) / determinant) * dg;
  }
  return point;
}

TriangleMesh polygonise(const Field& field, const Box3d& box, double cell) {
  WEFT_ASSERT(cell > 0 && !box.empty());
  return Polygoniser(field, box, cell).run();
}

}  // namespace weft
