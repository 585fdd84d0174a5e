#include "weft/run/export/surface_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/geometry_image.h"

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

constexpr std::streamoff header_bytes = 32;

}  // namespace

PointFrames::PointFrames(const std::filesystem::path& path)
    : path_(path), in_(path, std::ios::binary) {
  std::array<char, header_bytes> header{};
  if (!in_ || !in_.read(header.data(), header.size()) ||
      std::string_view(header.data(), 11) != "POINTCACHE2")
    throw InputError(path.string(), "no point cache", "a PC2 file is wanted");
  std::int32_t points = 0, frames = 0;
  std::memcpy(&points, header.data() + 16, 4);
  std::memcpy(&frames, header.data() + 28, 4);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  const auto wanted = static_cast<std::uintmax_t>(header_bytes) +
                      12 * static_cast<std::uintmax_t>(std::max(points, 0)) * std::max(frames, 0);
  if (points < 1 || frames < 0 || error || bytes != wanted)
    throw InputError(path.string(),
                     fmt::format("{} bytes for {} points and {} frames", bytes, points, frames),
                     fmt::format("{} bytes are wanted", wanted));
  points_ = points;
  frames_ = frames;
}

std::vector<Vec3f> PointFrames::read(int frame) {
  WEFT_ASSERT(frame >= 0 && frame < frames_);
  std::vector<Vec3f> points(static_cast<std::size_t>(points_));
  const auto bytes = static_cast<std::streamoff>(points.size() * sizeof(Vec3f));
  in_.clear();
  in_.seekg(header_bytes + frame * bytes);
  if (!in_.read(reinterpret_cast<char*>(points.data()), bytes))
    throw InputError(path_.string(), "ends early", "a whole point cache is wanted");
  return points;
}

}  // namespace weft
