#include "weft/run/export/frame_files.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "weft/files.h"
#include "weft/image/io/exr_codec.h"
#include "weft/mesh/point_normals.h"
#include "weft/mesh_colours.h"
#include "weft/run/bytes.h"
#include "weft/run/export/distinct_names.h"

namespace weft {
namespace {

constexpr int max_of_a_byte = 255;

/// An appended array: its length, then its bytes.
template <class T>
std::string sized(std::span<const T> values) {
  std::string bytes;
  append_raw(bytes, static_cast<std::uint64_t>(values.size_bytes()));
  append_raw(bytes, values);
  return bytes;
}

std::span<const Vec3f> span_of(const std::vector<Vec3f>& values) { return values; }

}  // namespace

PlyFrames::PlyFrames(const ExportedSurface& surface) {
  const MeshFaces faces = surface.faces();
  // Counts of one byte are the most widely supported.
  const bool small = std::all_of(faces.sizes.begin(), faces.sizes.end(),
                                 [](int size) { return size <= max_of_a_byte; });
  triangles_ = fans_of(faces).triangles;
  for (const Vec3f colour : surface.colours()) colours_.push_back(display_bytes(colour));
  head_ = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n{}"
      "element face {}\nproperty list {} int vertex_indices\nend_header\n",
      surface.vertices(),
      colours_.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
      faces.sizes.size(), small ? "uchar" : "int");
  std::size_t first = 0;
  for (const int size : faces.sizes) {
    if (small) {
      append_raw(faces_, static_cast<std::uint8_t>(size));
    } else {
      append_raw(faces_, std::int32_t{size});
    }
    append_raw(faces_,
               std::span<const int>(faces.corners).subspan(first, static_cast<std::size_t>(size)));
    first += static_cast<std::size_t>(size);
  }
}

std::string PlyFrames::encode(const MotionFrame& frame) const {
  const std::vector<Vec3f> normals = point_normals(frame.points(), triangles_);
  std::string bytes = head_;
  bytes.reserve(head_.size() + faces_.size() + (2 * sizeof(Vec3f) + 3) * normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    append_raw(bytes, frame.points()[v]);
    append_raw(bytes, normals[v]);
    if (!colours_.empty()) append_raw(bytes, colours_[v]);
  }
  return bytes.append(faces_);
}

VtpFrames::VtpFrames(const ExportedSurface& surface, double frame_rate)
    : frame_rate_(frame_rate), vertices_(static_cast<std::size_t>(surface.vertices())) {
  const MeshFaces faces = surface.faces();
  triangles_ = fans_of(faces).triangles;
  polygons_ = faces.sizes.size();
  std::vector<std::int32_t> ends;
  std::int32_t end = 0;
  for (const int size : faces.sizes) ends.push_back(end += size);
  connectivity_ = sized(std::span<const int>(faces.corners));
  offsets_ = sized(std::span<const std::int32_t>(ends));
}

std::string VtpFrames::encode(const MotionFrame& frame) const {
  const std::string points = sized(span_of(frame.points()));
  const std::string normals = sized(span_of(point_normals(frame.points(), triangles_)));
  std::string bytes = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n"
      "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{}</DataArray></FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n",
      frame.number() / frame_rate_, vertices_, polygons_);
  std::size_t offset = 0;
  const auto array = [&](std::string_view what, const std::string& data) {
    bytes += fmt::format("<DataArray {} format=\"appended\" offset=\"{}\"/>", what, offset);
    offset += data.size();
  };
  bytes += "<Points>";
  array(R"(type="Float32" Name="Points" NumberOfComponents="3")", points);
  bytes += "</Points>\n<PointData Normals=\"Normals\">";
  array(R"(type="Float32" Name="Normals" NumberOfComponents="3")", normals);
  bytes += "</PointData>\n<Polys>";
  array(R"(type="Int32" Name="connectivity")", connectivity_);
  array(R"(type="Int32" Name="offsets")", offsets_);
  bytes += "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  for (const std::string* data : {&points, &normals, &connectivity_, &offsets_}) bytes += *data;
  return bytes += "\n</AppendedData>\n</VTKFile>\n";
}

std::string pvd_text(const std::string& folder, const std::vector<std::string>& files,
                     double frame_rate) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t k = 0; k < files.size(); ++k)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}/{}\"/>\n",
                        static_cast<double>(k) / frame_rate, folder, files[k]);
  return text += "</Collection>\n</VTKFile>\n";
}

std::string exr_frame(const MotionFrame& frame) {
  const Planes3& samples = frame.samples();
  Planes3 planes(samples.size());
  for (int s = 0; s < samples.size() * samples.size(); ++s)
    planes.set(s,
               vec_cast<float>(in_frame(vec_cast<double>(samples.at(s)), frame.surface().frame())));
  return encode_exr(planes, "positions");
}
namespace {

/// Text is written in pieces, as a whole OBJ in memory would take more than the cloth itself.
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

/// Writes a face, with texture indices only where all its corners have one.
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

/// Writes the faces, those of each panel as a group.
void write_faces(Text& text, const MeshFaces& faces, const std::vector<NamedRun>& panels,
                 DistinctNames& groups) {
  const std::span<const int> corners = faces.corners, texture = faces.texture_corners;
  std::size_t first = 0;
  auto panel = panels.begin();
  for (std::size_t f = 0; f < faces.sizes.size(); ++f) {
    while (panel != panels.end() && panel->count == 0) ++panel;
    if (panel != panels.end() && static_cast<std::size_t>(panel->first) == f)
      text.add("g {}\n", groups.add((panel++)->name));
    const auto count = static_cast<std::size_t>(faces.sizes[f]);
    write_face(text, corners.subspan(first, count),
               faces.has_texture() ? texture.subspan(first, count) : texture);
    first += count;
  }
}

/// Writes seams as lines along vertices of the faces.
void write_seams(Text& text, const std::vector<NamedRun>& seams, DistinctNames& groups) {
  for (const NamedRun& seam : seams) {
    if (seam.vertices.size() < 2) continue;
    text.add("g {}\nl", groups.add("seam_" + seam.name));
    for (const int vertex : seam.vertices) text.add(" {}", vertex + 1);
    text.add("\n");
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
    // Smooth shading also in programs that compute their own normals.
    text.add("s 1\n");
    const GarmentParts parts = surface.parts();
    DistinctNames groups;
    write_faces(text, faces, parts.panels, groups);
    write_seams(text, parts.seams, groups);
    text.flush();
  });
}

}  // namespace weft
