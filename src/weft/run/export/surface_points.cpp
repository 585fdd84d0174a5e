#include "weft/run/export/surface_points.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/mesh/io/pc2_header.h"

namespace weft {

std::vector<Vec3f> SurfacePoints::gather(const Planes3& positions) const {
  std::vector<Vec3f> points;
  points.reserve(sample_of.size());
  for (const int sample : sample_of) points.push_back(positions.at(sample));
  return points;
}

SurfacePoints surface_points(const GeometryImage& image, bool unwelded) {
  SurfacePoints points;
  points.size = image.size();
  points.triangles = grid_triangles(image);
  if (unwelded) {
    points.sample_of.resize(static_cast<std::size_t>(points.size) * points.size);
    std::iota(points.sample_of.begin(), points.sample_of.end(), 0);
    points.vertex_of = points.sample_of;
  } else {
    RebuiltMesh rebuilt = rebuild_mesh(image);
    points.sample_of = std::move(rebuilt.sample_of);
    points.vertex_of = std::move(rebuilt.vertex_of);
  }
  return points;
}

namespace {

/// The corners of a triangle as particles, ascending.
Triangle particles_of(const Triangle& t, const BorderMates& mates) {
  Triangle points{mates.representative(t[0]), mates.representative(t[1]),
                  mates.representative(t[2])};
  std::sort(points.begin(), points.end());
  return points;
}

/// The triangles that are left once mates are joined. Two of the same corners, as a dart makes them
/// at its tip, lie on each other and go together.
std::vector<Triangle> unfolded(const std::vector<Triangle>& all, const BorderMates& mates) {
  std::map<Triangle, int> uses;
  for (const Triangle& t : all) ++uses[particles_of(t, mates)];
  std::vector<Triangle> kept;
  for (const Triangle& t : all) {
    const Triangle points = particles_of(t, mates);
    if (points[0] != points[1] && points[1] != points[2] && uses[points] == 1) kept.push_back(t);
  }
  return kept;
}

}  // namespace

SurfacePoints sewn_points(const GeometryImage& image, const BorderMates& sewn) {
  SurfacePoints points;
  points.size = image.size();
  points.triangles = unfolded(grid_triangles(image), sewn);
  const std::vector<int>& chart = sewn.chart_of();
  if (!chart.empty())
    std::stable_sort(
        points.triangles.begin(), points.triangles.end(),
        [&](const Triangle& a, const Triangle& b) { return chart[a[0]] < chart[b[0]]; });
  const int samples = points.size * points.size;
  std::vector<bool> used(static_cast<std::size_t>(samples), false);
  for (const Triangle& t : points.triangles)
    for (const int corner : t) used[sewn.representative(corner)] = true;
  points.vertex_of.assign(used.size(), -1);
  for (int s = 0; s < samples; ++s) {
    if (!used[s]) continue;
    points.vertex_of[s] = static_cast<int>(points.sample_of.size());
    points.sample_of.push_back(s);
  }
  for (int s = 0; s < samples; ++s) points.vertex_of[s] = points.vertex_of[sewn.representative(s)];
  return points;
}

PointFrames::PointFrames(const std::filesystem::path& path)
    : path_(path), in_(path, std::ios::binary) {
  Pc2Header header;
  if (!in_ || !in_.read(reinterpret_cast<char*>(&header), sizeof(header)) || !header.is_known())
    throw InputError(path.string(), "no point cache", "a PC2 file is wanted");
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  const Pc2Header counted{.points = std::max(header.points, 0)};
  const std::uintmax_t wanted = counted.file_bytes(std::max(header.samples, 0));
  if (header.points < 1 || header.samples < 0 || error || bytes != wanted)
    throw InputError(
        path.string(),
        fmt::format("{} bytes for {} points and {} frames", bytes, header.points, header.samples),
        fmt::format("{} bytes are wanted", wanted));
  points_ = header.points;
  frames_ = header.samples;
}

std::vector<Vec3f> PointFrames::read(int frame) {
  WEFT_ASSERT(frame >= 0 && frame < frames_);
  std::vector<Vec3f> points(static_cast<std::size_t>(points_));
  const auto bytes = static_cast<std::streamoff>(points.size() * sizeof(Vec3f));
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(Pc2Header{.points = points_}.file_bytes(frame)));
  if (!in_.read(reinterpret_cast<char*>(points.data()), bytes))
    throw InputError(path_.string(), "ends early", "a whole point cache is wanted");
  return points;
}

}  // namespace weft
