#include "weft/convert/fit_samples.h"

#include <algorithm>
#include <vector>

#include "weft/convert/rasterise.h"
#include "weft/core/ordered_sum.h"
#include "weft/image/diagonals.h"

namespace weft {
namespace {

/// Surface points per sample interval, in each direction.
constexpr int fineness = 3;

/// A target of the fit: a surface point on a grid `fineness` times as fine as the image's.
struct SurfacePoint {
  Vec3d position;
  Vec3d normal;
  double weight = 0;  ///< surface area per unit of the square, 0 where the grid has no point [m^2]
};

std::vector<SurfacePoint> surface_points(const MappedDisk& mapped) {
  const DiskMesh& disk = mapped.cut.disk;
  const ChartSize size = refined(mapped.map.size, fineness);
  std::vector<SurfacePoint> points(static_cast<std::size_t>(size.rows) * size.cols);
  rasterise(disk, mapped.map, size, [&](int row, int col, int index) {
    const Triangle& t = disk.triangles[index];
    const CornerUv corners = corner_uv(mapped.map, t);
    const std::array<double, 3> w =
        corner_weights(corners, sample_place(row, col, size, mapped.map));
    const Vec3d &a = disk.positions[t[0]], b = disk.positions[t[1]], c = disk.positions[t[2]];
    const Vec3d twice_area = cross(b - a, c - a);
    const double in_square = cross(corners[1] - corners[0], corners[2] - corners[0]);
    points[static_cast<std::size_t>(row) * size.cols + col] = {
        w[0] * a + w[1] * b + w[2] * c, normalized(twice_area), length(twice_area) / in_square};
  });
  return points;
}

/// [n * n] the unknown of each sample: the lowest sample of its mates, or -1 on the true border.
std::vector<int> unknowns(const MappedDisk& mapped, const GeometryImage& image) {
  const int n = image.size();
  const ChartSize size = mapped.map.size;
  std::vector<int> unknown(static_cast<std::size_t>(n) * n);
  std::vector<bool> fixed(unknown.size(), false);
  for (std::size_t p = 0; p < mapped.cut.paths.size(); ++p)
    for (int k = 0; k <= mapped.layout.intervals[p] && mapped.cut.paths[p].mate < 0; ++k)
      fixed[image.mates.representative(
          chart_sample(size, (mapped.layout.first[p] + k) % size.around(), n))] = true;
  for (int s = 0; s < n * n; ++s) {
    const int own = image.mates.representative(s);
    unknown[s] = fixed[own] ? -1 : own;
  }
  return unknown;
}

/// The matrix-free normal equations of the fit for given diagonals.
class Fit {
 public:
  Fit(ChartSize size, const std::vector<SurfacePoint>& points, const std::vector<int>& unknown,
      const Grid<Diagonal>& diagonals, double along_surface)
      : fine_(refined(size, fineness)),
        points_(points),
        unknown_(unknown),
        diagonals_(diagonals),
        along_(along_surface) {}

  /// The weighted residual of every unknown, and an isotropic diagonal for the preconditioner.
  struct Pull {
    std::vector<Vec3d> force;
    std::vector<double> stiffness;
  };
  [[nodiscard]] Pull pull(const std::vector<Vec3d>& samples) const {
    Pull found{std::vector<Vec3d>(samples.size()), std::vector<double>(samples.size(), 0.0)};
    for_each_point([&](const SurfacePoint& point, const std::array<int, 3>& corner,
                       const std::array<double, 3>& w) {
      Vec3d apart = point.position;
      for (int k = 0; k < 3; ++k) apart = apart - w[k] * samples[corner[k]];
      const Vec3d force = weighed(point, apart);
      for (int k = 0; k < 3; ++k) {
        const int own = unknown_[corner[k]];
        if (own < 0) continue;
        found.force[own] += w[k] * force;
        found.stiffness[own] += w[k] * w[k] * point.weight;
      }
    });
    return found;
  }
  /// The matrix times a direction, both by unknowns.
  [[nodiscard]] std::vector<Vec3d> multiply(const std::vector<Vec3d>& direction) const {
    std::vector<Vec3d> product(direction.size());
    for_each_point([&](const SurfacePoint& point, const std::array<int, 3>& corner,
                       const std::array<double, 3>& w) {
      Vec3d value{};
      for (int k = 0; k < 3; ++k)
        if (unknown_[corner[k]] >= 0) value += w[k] * direction[unknown_[corner[k]]];
      const Vec3d force = weighed(point, value);
      for (int k = 0; k < 3; ++k)
        if (unknown_[corner[k]] >= 0) product[unknown_[corner[k]]] += w[k] * force;
    });
    return product;
  }

 private:
  [[nodiscard]] Vec3d weighed(const SurfacePoint& point, Vec3d v) const {
    const Vec3d across = dot(point.normal, v) * point.normal;
    return point.weight * (along_ * v + (1 - along_) * across);
  }
  template <class Visit>
  void for_each_point(const Visit& visit) const {
    const int n = diagonals_.rows() + 1;
    for (int row = 1; row < fine_.rows - 1; ++row)
      for (int col = 1; col < fine_.cols - 1; ++col) {
        const SurfacePoint& point = points_[static_cast<std::size_t>(row) * fine_.cols + col];
        if (point.weight <= 0) continue;
        const int r = row / fineness;
        const int c = col / fineness;
        const double u = static_cast<double>(col % fineness) / fineness;
        const double v = static_cast<double>(row % fineness) / fineness;
        const int a = r * n + c;  // then b, c, d around the quad
        if (diagonals_(r, c) == Diagonal::rising) {
          if (u >= v) {
            visit(point, {a, a + 1, a + n + 1}, {1 - u, u - v, v});
          } else {
            visit(point, {a, a + n + 1, a + n}, {1 - v, u, v - u});
          }
        } else if (u + v <= 1) {
          visit(point, {a, a + 1, a + n}, {1 - u - v, u, v});
        } else {
          visit(point, {a + 1, a + n + 1, a + n}, {1 - v, u + v - 1, 1 - u});
        }
      }
  }

  ChartSize fine_;
  const std::vector<SurfacePoint>& points_;
  const std::vector<int>& unknown_;
  const Grid<Diagonal>& diagonals_;
  double along_;
};

double product(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  return lane_sum(static_cast<int>(a.size()), [&](int i) { return dot(a[i], b[i]); });
}

/// Conjugate gradients with a diagonal preconditioner, starting at the given samples.
void solve(const Fit& fit, std::vector<Vec3d>& samples, const std::vector<int>& unknown,
           int iterations) {
  const std::size_t count = samples.size();
  auto [residual, stiffness] = fit.pull(samples);
  std::vector<Vec3d> change(count), scaled(count);
  const auto precondition = [&] {
    for (std::size_t i = 0; i < count; ++i)
      scaled[i] = stiffness[i] > 0 ? (1 / stiffness[i]) * residual[i] : Vec3d{};
  };
  precondition();
  std::vector<Vec3d> direction = scaled;
  double square = product(residual, scaled);
  for (int k = 0; k < iterations && square > 0; ++k) {
    const std::vector<Vec3d> image = fit.multiply(direction);
    const double curvature = product(direction, image);
    if (!(curvature > 0)) break;
    const double step = square / curvature;
    for (std::size_t i = 0; i < count; ++i) {
      change[i] += step * direction[i];
      residual[i] = residual[i] - step * image[i];
    }
    precondition();
    const double next = product(residual, scaled);
    for (std::size_t i = 0; i < count; ++i)
      direction[i] = scaled[i] + (next / square) * direction[i];
    square = next;
  }
  for (std::size_t s = 0; s < count; ++s)
    if (unknown[s] >= 0) samples[s] += change[unknown[s]];
}

/// The image with the given samples, in a cube that contains them all: fitted ones may lie outside
/// the bounding box of the surface.
GeometryImage with_samples(const GeometryImage& image, const std::vector<Vec3d>& samples) {
  Box3d box;
  for (const Vec3d p : samples) box.add(p);
  const Vec3d extent = box.extent();
  GeometryImage fitted = image;
  fitted.world = {box.lower, std::max({extent.x, extent.y, extent.z})};
  if (!(fitted.world.scale > 0)) return image;
  for (int s = 0; s < static_cast<int>(samples.size()); ++s) {
    const Vec3d p = (1 / fitted.world.scale) * (samples[s] - box.lower);
    const auto clamped = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
    fitted.cube.set(s, {clamped(p.x), clamped(p.y), clamped(p.z)});
  }
  return fitted;
}

}  // namespace

GeometryImage fit_samples(const MappedDisk& mapped, const GeometryImage& image,
                          const FitOptions& options) {
  const int n = image.size();
  const std::vector<SurfacePoint> points = surface_points(mapped);
  const std::vector<int> unknown = unknowns(mapped, image);
  GeometryImage fitted = image;
  std::vector<Vec3d> samples;
  for (int s = 0; s < n * n; ++s) samples.push_back(image.world.to_world(image.cube.at(s)));
  for (int round = 0; round < options.rounds; ++round) {
    update(options.progress, "fit", static_cast<double>(round) / options.rounds);
    const Grid<Diagonal> diagonals = choose_diagonals(fitted);
    const Fit fit(mapped.map.size, points, unknown, diagonals, options.along_surface);
    solve(fit, samples, unknown, options.iterations);
    fitted = with_samples(image, samples);
  }
  return fitted;
}

}  // namespace weft
