#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh/io/coloured_files.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/ply_format.h"
#include "weft/mesh/io/polygon.h"

namespace weft {
namespace {

/// Reads a list's values; a false count ends in an error at the end of the file.
void read_list(PlyValues& values, const PlyProperty& property, std::vector<double>& list) {
  const double count = values.next(property.count_type);
  if (count < 0) values.fail("a list of negative length", "a count is wanted");
  list.clear();
  for (double i = 0; i < count; ++i) list.push_back(values.next(property.type));
}

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  for (const PlyElement& element : header.elements)
    if (element.name == name) return &element;
  return nullptr;
}

bool is_face_list(const PlyProperty& property) {
  return property.is_list() &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// The elements that may hold the surface: polygons, and strips of triangles as of Stanford's
/// scans.
constexpr std::string_view faces = "face", strips = "tristrips";

void check_lists(const PlyHeader& header, std::string_view kind, std::string_view name) {
  const PlyElement* element = find_element(header, kind);
  if (element == nullptr) return;
  const auto found =
      std::count_if(element->properties.begin(), element->properties.end(), is_face_list);
  if (found != 1)
    throw InputError(
        name,
        fmt::format("its {} have {} lists of vertices", kind == faces ? "faces" : "strips", found),
        "one list vertex_indices is wanted");
}

void check_layout(const PlyHeader& header, std::string_view name) {
  const PlyElement* vertex = find_element(header, "vertex");
  if (vertex == nullptr) throw InputError(name, "has no element vertex", "a mesh is wanted");
  int found = 0;
  for (const PlyProperty& p : vertex->properties)
    found += !p.is_list() && (p.name == "x" || p.name == "y" || p.name == "z") ? 1 : 0;
  if (found != 3) throw InputError(name, "its vertices lack x, y or z", "all three are wanted");
  check_lists(header, faces, name);
  check_lists(header, strips, name);
}

/// 0 for u, 1 for v, -1 for a property that is no texture coordinate; programs use several names.
int texture_axis(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 4>, 2> names{
      {{"u", "s", "texture_u", "texture_s"}, {"v", "t", "texture_v", "texture_t"}}};
  for (int axis = 0; axis < 2; ++axis)
    if (std::find(names[axis].begin(), names[axis].end(), name) != names[axis].end()) return axis;
  return -1;
}

/// 0 for red, 1 for green, 2 for blue, -1 for a property that is no colour of the surface.
int colour_axis(std::string_view name) {
  constexpr std::array<std::string_view, 3> names{"red", "green", "blue"};
  if (name.starts_with("diffuse_")) name.remove_prefix(8);
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

/// What the number of full light is: those of a type of their own size go up to its largest, other
/// whole numbers to 255, and fractions to 1.
double full_light(PlyType type) {
  if (type == PlyType::float32 || type == PlyType::float64) return 1;
  return type == PlyType::uint16 ? 65535 : 255;
}

/// A file's mesh, and what its vertices have besides.
struct PlyMesh {
  TriangleMesh mesh;
  std::vector<Vec2f> texture;   ///< [V] zeros where there are none
  std::vector<Vec3f> displays;  ///< [V] display colours, the same
};

bool has_colours(const PlyElement& vertex) {
  std::array<int, 3> found{};
  for (const PlyProperty& p : vertex.properties)
    if (const int axis = colour_axis(p.name); axis >= 0 && !p.is_list()) ++found[axis];
  return found == std::array{1, 1, 1};
}

bool has_texture(const PlyElement& vertex) {
  std::array<int, 2> found{};
  for (const PlyProperty& p : vertex.properties)
    if (const int axis = texture_axis(p.name); axis >= 0 && !p.is_list()) ++found[axis];
  return found[0] == 1 && found[1] == 1;
}

void read_vertex(PlyValues& values, const PlyElement& element, PlyMesh& read) {
  Vec3d p;
  std::array<double, 2> uv{};
  std::array<double, 3> display{};
  std::vector<double> ignored;
  for (const PlyProperty& property : element.properties) {
    if (property.is_list()) {
      read_list(values, property, ignored);
      continue;
    }
    const double value = values.next(property.type);
    if (const int axis = texture_axis(property.name); axis >= 0) uv[axis] = value;
    if (const int axis = colour_axis(property.name); axis >= 0)
      display[axis] = value / full_light(property.type);
    if (property.name != "x" && property.name != "y" && property.name != "z") continue;
    const std::string_view fault = coordinate_fault(value);
    if (!fault.empty())
      values.fail(fmt::format("coordinate {} {}", property.name, fault),
                  "a finite number is wanted");
    (property.name == "x" ? p.x : property.name == "y" ? p.y : p.z) = value;
  }
  read.mesh.positions.push_back(p);
  read.texture.push_back({static_cast<float>(uv[0]), static_cast<float>(uv[1])});
  read.displays.push_back(vec_cast<float>(Vec3d{display[0], display[1], display[2]}));
}

/// Copies the vertices' texture coordinates to the corners.
TriangleMesh textured(PlyMesh read, bool has_texture) {
  if (!has_texture) return std::move(read.mesh);
  for (const auto& [a, b, c] : read.mesh.triangles)
    read.mesh.corner_uv.push_back({read.texture[a], read.texture[b], read.texture[c]});
  keep_whole_texture(read.mesh);
  return std::move(read.mesh);
}

/// Checks the index of a face's corner.
int vertex_of(const PlyValues& values, double index, std::int64_t vertices) {
  if (!(index >= 0 && index < static_cast<double>(vertices) && index == std::floor(index)))
    values.fail(fmt::format("a face uses vertex {} of {}", index, vertices),
                "an existing vertex, counted from 0, is wanted");
  return static_cast<int>(index);
}

void add_face(const PlyValues& values, std::span<const double> list, std::int64_t vertices,
              TriangleMesh& mesh) {
  if (list.size() < 3)
    values.fail(fmt::format("a face with {} corners", list.size()), "at least 3 are wanted");
  std::vector<int> polygon;
  polygon.reserve(list.size());
  for (const double index : list) polygon.push_back(vertex_of(values, index, vertices));
  add_polygon(mesh, polygon);
}

/// Adds the strips of one list, apart by -1; each turns its second triangle over, wherever it
/// begins.
void add_strips(const PlyValues& values, std::span<const double> list, std::int64_t vertices,
                TriangleMesh& mesh) {
  std::vector<int> strip;
  for (const double index : list) {
    if (index != -1) {
      strip.push_back(vertex_of(values, index, vertices));
      continue;
    }
    add_strip(mesh.triangles, strip);
    strip.clear();
  }
  add_strip(mesh.triangles, strip);
}

/// Reads a face or strips, or skips an item of an element that is not part of the surface.
void read_other(PlyValues& values, const PlyElement& element, std::int64_t vertices,
                TriangleMesh& mesh) {
  std::vector<double> list;
  for (const PlyProperty& property : element.properties) {
    if (!property.is_list()) {
      values.next(property.type);
      continue;
    }
    read_list(values, property, list);
    if (!is_face_list(property)) continue;
    if (element.name == faces) add_face(values, list, vertices, mesh);
    if (element.name == strips) add_strips(values, list, vertices, mesh);
  }
}

/// All of a file.
struct PlyFile {
  PlyMesh read;
  PlyElement vertex;
};

PlyFile parse_whole(std::string_view bytes, std::string_view name) {
  if (bytes.empty()) throw InputError(name, "is empty", "a PLY mesh is wanted");
  std::string decoded;
  LineReader reader(plain_text(bytes, decoded), name);
  const PlyHeader header = read_ply_header(reader);
  check_layout(header, name);
  PlyFile file{{}, *find_element(header, "vertex")};
  const PlyElement& vertex = file.vertex;
  PlyMesh& read = file.read;
  read.mesh.positions.reserve(vertex.count);
  PlyValues values(reader, header.format, name);
  for (const PlyElement& element : header.elements)
    for (std::int64_t i = 0; i < element.count; ++i) {
      values.begin_item(element, i);
      if (element.name == "vertex")
        read_vertex(values, element, read);
      else
        read_other(values, element, vertex.count, read.mesh);
      values.end_item();
    }
  values.expect_end();
  const PlyElement* edge = find_element(header, "edge");
  require_surface(read.mesh, name, edge != nullptr && edge->count > 0);
  return file;
}

/// The picture that a header names in a comment, as scanners and their programs write it.
std::string picture_name(std::string_view bytes) {
  constexpr std::string_view mark = "comment TextureFile ";
  const std::size_t at = bytes.substr(0, bytes.find("end_header")).find(mark);
  if (at == bytes.npos) return {};
  const std::string_view line = bytes.substr(at + mark.size());
  return std::string(line.substr(0, line.find_first_of("\r\n")));
}

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, std::string_view name) {
  PlyFile file = parse_whole(bytes, name);
  return textured(std::move(file.read), has_texture(file.vertex));
}

SurfaceColours ply_colours(std::string_view bytes, std::string_view name, NeighbourFiles& files) {
  std::string decoded;
  const std::string_view plain = plain_text(bytes, decoded);
  const PlyFile file = parse_whole(plain, name);
  const TriangleMesh& mesh = file.read.mesh;
  const std::string picture = picture_name(plain);
  const bool textured = !picture.empty() && has_texture(file.vertex);
  SurfaceColours colours;
  colours.part_of.assign(mesh.triangles.size(), textured ? 0 : -1);
  if (textured) colours.parts.push_back({{1, 1, 1}, files.picture(picture, colours), false});
  const std::vector<Vec3f> lights =
      has_colours(file.vertex) ? linear_colours(file.read.displays) : std::vector<Vec3f>();
  for (const auto& [a, b, c] : mesh.triangles) {
    const PlyMesh& read = file.read;
    if (textured) colours.uv.push_back({read.texture[a], read.texture[b], read.texture[c]});
    if (!lights.empty()) colours.corners.push_back({lights[a], lights[b], lights[c]});
  }
  return colours;
}

}  // namespace weft
