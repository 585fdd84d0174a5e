#include "weft/run/export/obj_writer.h"

#include <algorithm>
#include <iterator>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "weft/files.h"
#include "weft/mesh/point_normals.h"

namespace weft {
namespace {

/// A whole OBJ in memory would take more than the cloth itself: it is written in pieces.
constexpr std::size_t min_piece = 1U << 16U;

class Text {
 public:
  explicit Text(std::ostream& out) : out_(out) {}
  template <class... Values>
  void add(fmt::format_string<Values...> line, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), line, std::forward<Values>(values)...);
    if (text_.size() >= min_piece) flush();
  }
  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

 private:
  std::ostream& out_;
  fmt::memory_buffer text_;
};

/// All corners of a face have the same parts: texture where all have one.
void write_face(Text& text, std::span<const int> corners, std::span<const int> texture) {
  const bool textured = !texture.empty() && std::all_of(texture.begin(), texture.end(),
                                                        [](int index) { return index >= 0; });
  text.add("f");
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (textured) {
      text.add(" {0}/{1}/{0}", corners[k] + 1, texture[k] + 1);
    } else {
      text.add(" {0}//{0}", corners[k] + 1);
    }
  }
  text.add("\n");
}

void write_faces(Text& text, const MeshFaces& faces) {
  const std::span<const int> corners = faces.corners, texture = faces.texture_corners;
  std::size_t first = 0;
  for (const int size : faces.sizes) {
    const auto count = static_cast<std::size_t>(size);
    write_face(text, corners.subspan(first, count),
               faces.has_texture() ? texture.subspan(first, count) : texture);
    first += count;
  }
}

}  // namespace

void write_obj(const std::filesystem::path& path, const ExportedSurface& surface,
               std::span<const Vec3f> points) {
  const MeshFaces faces = surface.faces();
  const std::vector<Vec3f> normals = point_normals(points, fans_of(faces).triangles);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    for (const Vec3f p : points) text.add("v {} {} {}\n", p.x, p.y, p.z);
    for (const Vec2f uv : faces.texture) text.add("vt {} {}\n", uv.x, uv.y);
    for (const Vec3f n : normals) text.add("vn {:.5g} {:.5g} {:.5g}\n", n.x, n.y, n.z);
    // Programs that make their own normals shade smoothly, too.
    text.add("s 1\n");
    write_faces(text, faces);
    text.flush();
  });
}

}  // namespace weft
