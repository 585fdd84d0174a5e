#include "weft/sim/export/surface_points.h"

#include <iterator>
#include <numeric>
#include <ostream>

#include <fmt/format.h>

#include "weft/core/files.h"
#include "weft/image/rebuild.h"

namespace weft {
namespace {

/// A whole OBJ in memory would take more than the cloth itself: it is written in pieces.
constexpr std::size_t least_piece = 1U << 16U;

void write_piece(fmt::memory_buffer& text, std::ostream& out, std::size_t least) {
  if (text.size() < least) return;
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  text.clear();
}

void write_obj_lines(const SurfacePoints& points, const Planes3& positions, std::ostream& out) {
  fmt::memory_buffer text;
  const auto end = std::back_inserter(text);
  for (const int sample : points.sample_of) {
    const Vec3f p = positions.at(sample);
    fmt::format_to(end, "v {} {} {}\n", p.x, p.y, p.z);
    write_piece(text, out, least_piece);
  }
  const double steps = points.size - 1;
  for (int r = 0; r < points.size; ++r) {
    for (int c = 0; c < points.size; ++c) fmt::format_to(end, "vt {} {}\n", c / steps, r / steps);
    write_piece(text, out, least_piece);
  }
  for (const auto& [a, b, c] : points.triangles) {
    fmt::format_to(end, "f {}/{} {}/{} {}/{}\n", points.vertex_of[a] + 1, a + 1,
                   points.vertex_of[b] + 1, b + 1, points.vertex_of[c] + 1, c + 1);
    write_piece(text, out, least_piece);
  }
  write_piece(text, out, 0);
}

}  // namespace

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

void write_obj(const std::filesystem::path& path, const SurfacePoints& points,
               const Planes3& positions) {
  write_file(path, [&](std::ostream& file) { write_obj_lines(points, positions, file); });
}

}  // namespace weft
