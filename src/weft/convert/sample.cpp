#include "weft/convert/sample.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "weft/convert/border_walk.h"
#include "weft/convert/rasterise.h"
#include "weft/convert/surface_places.h"
#include "weft/core/assert.h"
#include "weft/core/math.h"
#include "weft/cut/disk_mesh.h"
#include "weft/error.h"

namespace weft {
namespace {

BorderMates mates_of(const MappedDisk& mapped) {
  std::vector<MateInterval> intervals;
  const int around = mapped.layout.size.around();
  for (int p = 0; p < static_cast<int>(mapped.cut.paths.size()); ++p) {
    const int mate = mapped.cut.paths[p].mate;
    if (mate <= p) continue;  // a true border, or a pair added already
    const int count = mapped.layout.intervals[p];
    intervals.push_back(
        {mapped.layout.first[p], (mapped.layout.first[mate] + count) % around, count});
  }
  const auto [rows, cols] = mapped.layout.size;
  if (rows == cols) return {rows, std::move(intervals)};
  return {std::max(rows, cols), {{"", 0, 0, rows, cols}}, std::move(intervals)};
}

template <class Value>
Value weighted(const std::array<double, 3>& w, const Value& a, const Value& b, const Value& c) {
  return w[0] * a + w[1] * b + w[2] * c;
}

std::array<double, 3> weights_at(const MappedDisk& mapped, const Triangle& triangle, Vec2d point) {
  return corner_weights(corner_uv(mapped.map, triangle), point);
}

Vec3f unit_normal(Vec3d sum) {
  return squared_length(sum) > 0 ? vec_cast<float>(normalized(sum)) : Vec3f{0, 1, 0};
}

void require_cover(const Grid<int>& times) {
  int bad = 0;
  for (int row = 1; row < times.rows() - 1; ++row)
    for (int col = 1; col < times.cols() - 1; ++col) bad += times(row, col) != 1;
  if (bad > 0)
    throw TopologyError("",
                        fmt::format("a map that leaves {} samples not covered exactly once", bad),
                        "a map without flipped triangles is wanted");
}

}  // namespace

WorldMap unit_cube_map(std::span<const Vec3d> positions) {
  Box3d box;
  for (const Vec3d p : positions) box.add(p);
  const Vec3d extent = box.extent();
  const double side = std::max({extent.x, extent.y, extent.z});
  return {box.lower, side > 0 ? side : 1.0};
}

Vec3f to_cube(const WorldMap& world, Vec3d position) {
  const auto clamped = [](double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); };
  const Vec3d p = position - world.lower;
  return {clamped(p.x / world.scale), clamped(p.y / world.scale), clamped(p.z / world.scale)};
}

void join_mates(GeometryImage& image) {
  for (int k = 0; k < image.mates.class_count(); ++k)
    for (const int sample : image.mates.mates(k))
      image.cube.set(sample, image.cube.at(image.mates.mates(k)[0]));
}

namespace {

/// Calls use(v, normal) for each corner of each triangle, at vertex v, its normal as long as its
/// angle.
template <class Use>
void for_corner_normals(std::span<const Vec3d> positions, std::span<const Triangle> triangles,
                        const Use& use) {
  for (const Triangle& t : triangles) {
    const std::array<Vec3d, 3> p{positions[t[0]], positions[t[1]], positions[t[2]]};
    const Vec3d normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    for (int k = 0; k < 3; ++k) {
      const Vec3d to_next = normalized(p[(k + 1) % 3] - p[k]);
      const Vec3d to_last = normalized(p[(k + 2) % 3] - p[k]);
      use(t[k], arc_cosine(dot(to_next, to_last)) * normal);
    }
  }
}

}  // namespace

std::vector<Vec3d> angle_weighted_normals(std::span<const Vec3d> positions,
                                          std::span<const Triangle> triangles) {
  std::vector<Vec3d> sums(positions.size());
  for_corner_normals(positions, triangles, [&](int v, Vec3d normal) { sums[v] += normal; });
  return sums;
}

std::vector<Vec3d> disk_vertex_normals(const DiskMesh& disk) {
  int count = 0;
  for (const int s : disk.surface_vertex) count = std::max(count, s + 1);
  std::vector<Vec3d> sums(static_cast<std::size_t>(count));
  for_corner_normals(disk.positions, disk.triangles,
                     [&](int v, Vec3d normal) { sums[disk.surface_vertex[v]] += normal; });
  for (Vec3d& sum : sums) sum = squared_length(sum) > 0 ? normalized(sum) : Vec3d{0, 1, 0};
  std::vector<Vec3d> normals;
  normals.reserve(disk.surface_vertex.size());
  for (const int s : disk.surface_vertex) normals.push_back(sums[s]);
  return normals;
}

GeometryImage sample_image(const MappedDisk& mapped) {
  const DiskMesh& disk = mapped.cut.disk;
  const ChartSize size = mapped.map.size;
  const int n = std::max(size.rows, size.cols);
  GeometryImage image;
  image.cube = Planes3(n);
  image.mates = mates_of(mapped);
  image.world = unit_cube_map(disk.positions);
  const BorderWalk border(mapped);
  for (int t = 0; t < size.around(); ++t) {
    const EdgePoint point = border.at(t, size);
    const Vec3d p = interpolate(point, disk.positions[point.from], disk.positions[point.to]);
    image.cube.set(chart_sample(size, t, n), to_cube(image.world, p));
  }
  Grid<int> times(size.rows, size.cols);
  rasterise(disk, mapped.map, size, [&](int row, int col, int index) {
    const Triangle& t = disk.triangles[index];
    const std::array<double, 3> w = weights_at(mapped, t, sample_place(row, col, size, mapped.map));
    const Vec3d p = weighted(w, disk.positions[t[0]], disk.positions[t[1]], disk.positions[t[2]]);
    image.cube.set(row, col, to_cube(image.world, p));
    ++times(row, col);
  });
  require_cover(times);
  join_mates(image);
  return image;
}

NormalMap sample_normals(const MappedDisk& mapped, ChartSize size) {
  return sample_normals(mapped, size, disk_vertex_normals(mapped.cut.disk));
}

NormalMap sample_normals(const MappedDisk& mapped, ChartSize size, std::span<const Vec3d> normals) {
  const DiskMesh& disk = mapped.cut.disk;
  const int n = std::max(size.rows, size.cols);
  NormalMap map{Planes3(n)};
  const BorderWalk border(mapped);
  for (int t = 0; t < size.around(); ++t) {
    const EdgePoint point = border.at(t, size);
    const Vec3d normal = interpolate(point, normals[point.from], normals[point.to]);
    map.normal.set(chart_sample(size, t, n), unit_normal(normal));
  }
  rasterise(disk, mapped.map, size, [&](int row, int col, int index) {
    const Triangle& t = disk.triangles[index];
    const Vec2d place = sample_place(row, col, size, mapped.map);
    const Vec3d normal =
        weighted(weights_at(mapped, t, place), normals[t[0]], normals[t[1]], normals[t[2]]);
    map.normal.set(row, col, unit_normal(normal));
  });
  return map;
}

Planes3 sample_texture(const MappedDisk& mapped, const TriangleMesh& surface) {
  WEFT_ASSERT(surface.corner_uv.size() == surface.triangles.size());
  const ChartSize size = mapped.map.size;
  Planes3 texture(std::max(size.rows, size.cols));
  const std::vector<SurfacePlace> places = surface_places(mapped, surface.triangles, size);
  for (int sample = 0; sample < size.rows * size.cols; ++sample) {
    const SurfacePlace& place = places[sample];
    Vec2d uv;
    for (int k = 0; k < 3; ++k) {
      const Vec2f corner = surface.corner_uv[place.triangle][k];
      uv = uv + place.weights[k] * Vec2d{corner.x, corner.y};
    }
    texture.set(sample / size.cols, sample % size.cols,
                {static_cast<float>(uv.x), static_cast<float>(uv.y), 0});
  }
  return texture;
}

Grid<int> coverage(const MappedDisk& mapped) {
  Grid<int> times(mapped.map.size.rows, mapped.map.size.cols);
  rasterise(mapped.cut.disk, mapped.map, mapped.map.size,
            [&](int row, int col, int) { ++times(row, col); });
  return times;
}

}  // namespace weft
