#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh/io/coloured_files.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"

// tinyobjloader splits the face lines. It accepts invalid input (cut lines, words as zeros, indices
// out of range), does not round decimals correctly, and reports no line numbers. So every vertex
// and face line is checked here first, and the positions are read here.

namespace weft {
namespace {

/// A face corner that refers to a vertex of a later line.
struct ForwardReference {
  std::int64_t index = 0;
  int line = 0;
};

struct ObjScan {
  std::vector<Vec3d> positions;
  std::vector<Vec2f> texture;  ///< not finite where a line is not u and v
  std::vector<ForwardReference> forward;
  std::size_t faces = 0;
  bool lines = false;
  std::vector<Vec3f> displays;  ///< [V] colours behind positions; not finite where there is none
  std::vector<std::string> libraries;      ///< files of materials
  std::vector<std::string> materials{""};  ///< in the order in which they are used, none first
  std::vector<int> material_of;            ///< [faces] into materials
};

void scan_vertex(LineReader& reader, ObjScan& scan) {
  const double x = reader.coordinate();
  const double y = reader.coordinate();
  const double z = reader.coordinate();
  scan.positions.push_back({x, y, z});
  // A weight or a colour may follow.
  std::vector<float> more;
  for (std::string_view field = reader.next_field(); !field.empty(); field = reader.next_field()) {
    const std::optional<double> number = to_number(field);
    if (!number) reader.fail(in_quotes(field) + " is not a number", "v x y z is wanted");
    more.push_back(static_cast<float>(*number));
  }
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  scan.displays.push_back(more.size() == 3 ? Vec3f{more[0], more[1], more[2]}
                                           : Vec3f{none, none, none});
}

/// Reads a line of texture coordinates. Nothing is refused: the surface does not depend on them,
/// and exporters differ in what they write.
void scan_texture(LineReader& reader, ObjScan& scan) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  const double u = to_number(reader.next_field()).value_or(missing);
  const double v = to_number(reader.next_field()).value_or(missing);
  scan.texture.push_back({static_cast<float>(u), static_cast<float>(v)});
}

/// Checks one corner: v, v/t, v//n or v/t/n.
/// @return the parts that are present, as bits; all corners of a face have the same
int scan_corner(LineReader& reader, std::string_view corner, ObjScan& scan) {
  int form = 0;
  std::string_view rest = corner;
  for (int part = 0; part < 3; ++part) {
    const std::size_t slash = rest.find('/');
    const std::string_view text = rest.substr(0, slash);
    const std::optional<std::int64_t> index = to_integer(text);
    if ((part == 0 || !text.empty()) && (!index || *index == 0))
      reader.fail("face corner " + in_quotes(corner),
                  "indices from 1, or negative ones, are wanted");
    if (part == 0) {
      const auto count = static_cast<std::int64_t>(scan.positions.size());
      if (*index < -count)
        reader.fail(fmt::format("face corner {} goes back beyond the first of {} vertices",
                                in_quotes(corner), count),
                    "an existing vertex is wanted");
      if (*index > count) scan.forward.push_back({*index, reader.line_number()});
    }
    form |= (text.empty() ? 1 : 2) << (2 * part);
    if (slash == rest.npos) return form;
    rest.remove_prefix(slash + 1);
  }
  reader.fail("face corner " + in_quotes(corner) + " has more than two slashes", "v/t/n is wanted");
}

void scan_face(LineReader& reader, ObjScan& scan) {
  int corners = 0, form = 0;
  for (std::string_view field = reader.next_field(); !field.empty(); field = reader.next_field()) {
    const int this_form = scan_corner(reader, field, scan);
    if (corners++ > 0 && this_form != form)
      reader.fail("face corner " + in_quotes(field) + " has other parts than the one before",
                  "the same form in all corners of a face is wanted");
    form = this_form;
  }
  if (corners < 3)
    reader.fail(fmt::format("a face with {} corners", corners), "at least 3 are wanted");
  ++scan.faces;
  scan.material_of.push_back(static_cast<int>(scan.materials.size()) - 1);
}

ObjScan scan_obj(std::string_view bytes, std::string_view name) {
  ObjScan scan;
  LineReader reader(bytes, name);
  while (reader.next_line()) {
    const std::string_view keyword = reader.next_field();
    if (keyword == "v") scan_vertex(reader, scan);
    if (keyword == "vt") scan_texture(reader, scan);
    if (keyword == "f") scan_face(reader, scan);
    if (keyword == "l") scan.lines = true;
    if (keyword == "usemtl") scan.materials.push_back(reader.rest_as_name());
    if (keyword == "mtllib") scan.libraries.push_back(reader.rest_as_name());
  }
  for (const ForwardReference& reference : scan.forward)
    if (reference.index > static_cast<std::int64_t>(scan.positions.size()))
      throw InputError(
          fmt::format("{}:{}", name, reference.line),
          fmt::format("a face uses vertex {} of {}", reference.index, scan.positions.size()),
          "an existing vertex is wanted");
  return scan;
}

/// Joins lines that end in a backslash with their next lines, which tinyobjloader does not support.
/// As many empty lines follow the joined line as were joined, so that line numbers stay.
std::string join_continued_lines(std::string_view bytes) {
  std::string joined;
  joined.reserve(bytes.size());
  std::size_t taken = 0;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(end == bytes.npos ? bytes.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    // Not behind a comment or a name: a path may end like that.
    const std::size_t start = std::min(line.find_first_not_of(" \t"), line.size());
    const bool may_go_on =
        taken > 0 || line.substr(start, 1) == "f" || line.substr(start, 1) == "v";
    const bool goes_on = may_go_on && line.ends_with('\\');
    joined.append(line.substr(0, line.size() - (goes_on ? 1 : 0)));
    joined.append(goes_on ? " " : "\n");
    taken += goes_on ? 1 : 0;
    if (goes_on) continue;
    joined.append(taken, '\n');
    taken = 0;
  }
  return joined;
}

/// Receives the faces from tinyobjloader's callbacks.
struct FaceSink {
  TriangleMesh* mesh = nullptr;
  MeshFaces* faces = nullptr;  ///< may be null
  std::span<const Vec2f> all_texture;
  int vertices = 0, texture = 0;  ///< so far, which negative indices count back from
  std::vector<int> polygon;
  std::vector<int> polygon_texture;
  std::vector<Vec2f> polygon_uv;

  void add(std::span<const tinyobj::index_t> corners) {
    polygon.clear();
    polygon_texture.clear();
    polygon_uv.clear();
    for (const tinyobj::index_t& corner : corners) {
      // No checked index is zero: a zero is the start of a comment behind the face.
      if (corner.vertex_index == 0) break;
      polygon.push_back(corner.vertex_index > 0 ? corner.vertex_index - 1
                                                : vertices + corner.vertex_index);
      polygon_texture.push_back(texture_index(corner.texcoord_index));
      polygon_uv.push_back(texture_of(polygon_texture.back()));
    }
    std::vector<Triangle> ears = add_polygon(*mesh, polygon, polygon_uv);
    if (faces == nullptr || polygon.size() < 3) return;
    if (!ears.empty()) faces->ears.emplace(static_cast<int>(faces->sizes.size()), std::move(ears));
    faces->sizes.push_back(static_cast<int>(polygon.size()));
    faces->corners.insert(faces->corners.end(), polygon.begin(), polygon.end());
    faces->texture_corners.insert(faces->texture_corners.end(), polygon_texture.begin(),
                                  polygon_texture.end());
  }

  /// A texture index from 0; -1 where the corner has none, index 0, or one that does not exist.
  [[nodiscard]] int texture_index(int index) const {
    const std::int64_t place = index > 0 ? std::int64_t{index} - 1 : std::int64_t{texture} + index;
    const bool exists = index != 0 && place >= 0 && std::cmp_less(place, all_texture.size());
    return exists ? static_cast<int>(place) : -1;
  }
  /// The texture coordinates of an index; not finite for -1.
  [[nodiscard]] Vec2f texture_of(int index) const {
    constexpr float missing = std::numeric_limits<float>::quiet_NaN();
    return index >= 0 ? all_texture[static_cast<std::size_t>(index)] : Vec2f{missing, missing};
  }
};

void load_faces(const std::string& text, std::span<const Vec2f> texture, TriangleMesh& mesh,
                MeshFaces* faces) {
  FaceSink sink{&mesh, faces, texture, 0, 0, {}, {}, {}};
  tinyobj::callback_t callback;
  callback.vertex_cb = [](void* user, float, float, float, float) {
    ++static_cast<FaceSink*>(user)->vertices;
  };
  callback.texcoord_cb = [](void* user, float, float, float) {
    ++static_cast<FaceSink*>(user)->texture;
  };
  callback.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
    static_cast<FaceSink*>(user)->add({corners, static_cast<std::size_t>(count)});
  };
  std::istringstream stream(text);
  tinyobj::LoadObjWithCallback(stream, callback, &sink);
}

/// Moves texture coordinates to the faces. Malformed lines count in the numbering, but no corner
/// may use them.
void keep_texture(std::vector<Vec2f> texture, MeshFaces& faces) {
  const auto usable = [&](int index) {
    const Vec2f uv = index < 0 ? Vec2f{} : texture[static_cast<std::size_t>(index)];
    return index >= 0 && std::isfinite(uv.x) && std::isfinite(uv.y);
  };
  bool any = false;
  for (int& index : faces.texture_corners) {
    if (!usable(index)) index = -1;
    any = any || index >= 0;
  }
  if (!any) return faces.texture_corners.clear();
  for (Vec2f& uv : texture)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = {};
  faces.texture = std::move(texture);
}

/// What a file holds besides its mesh.
struct ObjExtras {
  MeshFaces* faces = nullptr;  ///< receives polygons and texture indices as they are in the file
  ObjScan* scan = nullptr;     ///< receives colours and materials
};

TriangleMesh parse(std::string_view bytes, std::string_view name, const ObjExtras& extras = {}) {
  MeshFaces* faces = extras.faces;
  std::string decoded;
  const std::string_view plain = plain_text(bytes, decoded);
  require_text(plain, name, "an OBJ text file");
  const std::string text = join_continued_lines(plain);
  ObjScan scan = scan_obj(text, name);
  if (scan.positions.empty())
    throw InputError(name, "has no vertex lines (v x y z)", "an OBJ mesh is wanted");
  TriangleMesh mesh{std::move(scan.positions), {}};
  mesh.triangles.reserve(scan.faces);
  load_faces(text, scan.texture, mesh, faces);
  if (faces != nullptr) keep_texture(std::move(scan.texture), *faces);
  keep_whole_texture(mesh);
  require_surface(mesh, name, scan.lines);
  if (extras.scan != nullptr) *extras.scan = std::move(scan);
  return mesh;
}

ObjMaterials materials_of(const ObjScan& scan, NeighbourFiles& files, SurfaceColours& colours) {
  ObjMaterials all;
  for (const std::string& library : scan.libraries)
    all.merge(parse_materials(files.read(library), library, files, colours));
  return all;
}

/// The materials that faces use, one for each part of the colours.
struct UsedMaterials {
  std::vector<ObjMaterial> of_part;
  std::vector<int> part_of;  ///< [materials of the scan] the part of each; -1: none
};

UsedMaterials used_materials(const ObjScan& scan, const ObjMaterials& known) {
  UsedMaterials used;
  for (const std::string& material : scan.materials) {
    const auto found = known.find(material);
    used.part_of.push_back(found == known.end() ? -1 : static_cast<int>(used.of_part.size()));
    if (found != known.end()) used.of_part.push_back(found->second);
  }
  return used;
}

/// Where a picture is at texture coordinates.
Vec2f placed(const ObjMaterial& material, Vec2f uv) {
  return {material.scale.x * uv.x + material.offset.x, material.scale.y * uv.y + material.offset.y};
}

std::array<Vec2f, 3> corners_in(const MeshFaces& faces, const Triangle& places) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  std::array<Vec2f, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const int index = faces.texture_corners[static_cast<std::size_t>(places[k])];
    corners[k] = index < 0 ? Vec2f{none, none} : faces.texture[static_cast<std::size_t>(index)];
  }
  return corners;
}

}  // namespace

TriangleMesh parse_obj(std::string_view bytes, std::string_view name) { return parse(bytes, name); }

SurfaceColours obj_colours(std::string_view bytes, std::string_view name, NeighbourFiles& files) {
  MeshFaces faces;
  ObjScan scan;
  parse(bytes, name, {&faces, &scan});
  SurfaceColours colours;
  const UsedMaterials used = used_materials(scan, materials_of(scan, files, colours));
  for (const ObjMaterial& material : used.of_part) colours.parts.push_back(material.part);
  for (std::size_t f = 0; f < faces.sizes.size(); ++f)
    colours.part_of.insert(colours.part_of.end(), static_cast<std::size_t>(faces.sizes[f] - 2),
                           used.part_of[static_cast<std::size_t>(scan.material_of[f])]);
  const FanCorners fans = fans_of(faces);
  if (std::any_of(scan.displays.begin(), scan.displays.end(),
                  [](Vec3f c) { return std::isfinite(c.x); })) {
    const std::vector<Vec3f> linear = linear_colours(scan.displays);
    for (const auto& [a, b, c] : fans.triangles)
      colours.corners.push_back({linear[a], linear[b], linear[c]});
  }
  if (faces.has_texture())
    for (std::size_t t = 0; t < fans.places.size(); ++t) {
      colours.uv.push_back(corners_in(faces, fans.places[t]));
      if (const int part = colours.part_of[t]; part >= 0)
        for (Vec2f& uv : colours.uv.back()) uv = placed(used.of_part[part], uv);
    }
  return colours;
}

MeshFile parse_obj_file(std::string_view bytes, std::string_view name) {
  MeshFile file;
  file.mesh = parse(bytes, name, {&file.faces, nullptr});
  return file;
}

}  // namespace weft
