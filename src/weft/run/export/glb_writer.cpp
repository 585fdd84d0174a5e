#include <limits>
#include <ostream>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/point_normals.h"
#include "weft/run/bytes.h"
#include "weft/run/export/glb_layout.h"

namespace weft {
namespace {

constexpr std::uint64_t header_bytes = 12, chunk_header_bytes = 8;
constexpr std::uint64_t max_bytes = std::numeric_limits<std::uint32_t>::max();

std::vector<Vec3f> copies(const std::vector<Vec3f>& values, const std::vector<int>& source) {
  std::vector<Vec3f> copied;
  copied.reserve(source.size());
  for (const int v : source) copied.push_back(values[static_cast<std::size_t>(v)]);
  return copied;
}

std::vector<Vec3f> differences(const std::vector<Vec3f>& values, const std::vector<Vec3f>& base) {
  std::vector<Vec3f> left(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) left[i] = values[i] - base[i];
  return left;
}

class Writer {
 public:
  Writer(const FinishedMotion& motion, const GlbMesh& mesh)
      : motion_(motion),
        mesh_(mesh),
        triangles_(fans_of(motion.surface->faces()).triangles),
        positions_(motion.points(0)),
        normals_(point_normals(positions_, triangles_)) {}

  [[nodiscard]] std::vector<Extremes> ranges() const {
    std::vector<Extremes> found{extremes(positions_)};
    for (int k = 1; k < motion_.frames; ++k)
      found.push_back(extremes(differences(motion_.points(k), positions_)));
    return found;
  }

  void write(std::ostream& out) const {
    put(out, positions_);
    put(out, normals_);
    write_raw(out, std::span<const Vec2f>(mesh_.uv));
    write_raw(out, std::span<const Vec3f>(mesh_.colours));
    write_raw(out, std::span<const Triangle>(mesh_.triangles));
    for (int k = 1; k < motion_.frames; ++k) {
      const std::vector<Vec3f> points = motion_.points(k);
      put(out, differences(points, positions_));
      put(out, differences(point_normals(points, triangles_), normals_));
    }
    if (motion_.frames > 1) write_animation(out);
  }

 private:
  void put(std::ostream& out, const std::vector<Vec3f>& values) const {
    const std::vector<Vec3f> all = copies(values, mesh_.source);
    write_raw(out, std::span<const Vec3f>(all));
  }

  /// Writes times and weights: at the time of a frame its own target has weight 1, all others 0.
  void write_animation(std::ostream& out) const {
    const auto frames = static_cast<std::size_t>(motion_.frames);
    std::vector<float> row;
    for (std::size_t k = 0; k < frames; ++k)
      row.push_back(static_cast<float>(static_cast<double>(k) / motion_.frame_rate));
    write_raw(out, std::span<const float>(row));
    row.assign(frames - 1, 0);
    for (std::size_t k = 0; k < frames; ++k) {
      if (k > 0) row[k - 1] = 1;
      if (k > 1) row[k - 2] = 0;
      write_raw(out, std::span<const float>(row));
    }
  }

  const FinishedMotion& motion_;
  const GlbMesh& mesh_;
  std::vector<Triangle> triangles_;         // of the surface's vertices
  std::vector<Vec3f> positions_, normals_;  // of frame 0
};

std::string chunk_header(std::uint64_t bytes, std::string_view type) {
  std::string header;
  append_raw(header, static_cast<std::uint32_t>(bytes));
  return header.append(type);
}

}  // namespace

void write_glb(const std::filesystem::path& path, const FinishedMotion& motion) {
  const GlbMesh mesh = glb_mesh(*motion.surface);
  const GlbLayout layout(mesh, motion);
  const auto check = [&](std::uint64_t bytes) {
    if (bytes > max_bytes)
      throw OutputError(
          path.string(),
          fmt::format("{} frames take {} bytes, GLB holds 4 GB", motion.frames, bytes),
          "fewer frames, a smaller size, or pc2 are wanted");
  };
  check(layout.bytes());
  const Writer writer(motion, mesh);
  std::string json = layout.json(writer.ranges());
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::uint64_t bytes = header_bytes + 2 * chunk_header_bytes + json.size() + layout.bytes();
  check(bytes);
  write_file(path, [&](std::ostream& out) {
    std::string header = "glTF";
    append_raw(header, std::uint32_t{2});
    append_raw(header, static_cast<std::uint32_t>(bytes));
    out << header << chunk_header(json.size(), "JSON") << json
        << chunk_header(layout.bytes(), std::string_view("BIN\0", 4));
    writer.write(out);
  });
}

}  // namespace weft
