#include <iterator>
#include <ostream>

#include <fmt/format.h>

#include "weft/files.h"
#include "weft/mesh/point_normals.h"
#include "weft/run/export/motion_writer.h"

namespace weft {
namespace {

/// A prim's name: letters, digits and '_', no digit first.
std::string prim_name(const std::string& name) {
  std::string prim = name;
  for (char& c : prim)
    if (c == '-' || c == '.') c = '_';
  if (prim[0] >= '0' && prim[0] <= '9') prim.insert(prim.begin(), '_');
  return prim;
}

template <class Values, class Format>
void write_list(std::ostream& out, const Values& values, const Format& format) {
  fmt::memory_buffer text;
  text.push_back('[');
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) fmt::format_to(std::back_inserter(text), ", ");
    format(std::back_inserter(text), values[i]);
  }
  text.push_back(']');
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

const auto number = [](auto out, const auto& x) { fmt::format_to(out, "{}", x); };
const auto pair = [](auto out, const Vec2f& p) { fmt::format_to(out, "({}, {})", p.x, p.y); };
const auto triple = [](auto out, const Vec3f& p) {
  fmt::format_to(out, "({}, {}, {})", p.x, p.y, p.z);
};

template <class Values>
void write_samples(std::ostream& out, int frames, const Values& values_of) {
  out << " = {\n";
  for (int frame = 0; frame < frames; ++frame) {
    out << fmt::format("            {}: ", frame);
    write_list(out, values_of(frame), triple);
    out << ",\n";
  }
  out << "        }\n";
}

void write_texture(std::ostream& out, const MeshFaces& faces) {
  for (const int index : faces.texture_corners)
    if (index < 0) return;  // not every corner has one
  if (!faces.has_texture()) return;
  out << "        texCoord2f[] primvars:st = ";
  write_list(out, faces.texture, pair);
  out << " (\n            interpolation = \"faceVarying\"\n        )\n"
      << "        int[] primvars:st:indices = ";
  write_list(out, faces.texture_corners, number);
  out << '\n';
}

void write_head(std::ostream& out, const FinishedMotion& motion) {
  const MeshFrame& frame = motion.surface->frame();
  const std::string prim = prim_name(motion.name);
  out << fmt::format(
      "#usda 1.0\n(\n    defaultPrim = \"{}\"\n    metersPerUnit = {}\n    upAxis = \"{}\"\n"
      "    startTimeCode = 0\n    endTimeCode = {}\n    timeCodesPerSecond = {}\n"
      "    framesPerSecond = {}\n)\n\ndef Xform \"{}\"\n{{\n    def Mesh \"surface\"\n    {{\n",
      prim, frame.unit.metres, frame.z_up ? "Z" : "Y", motion.frames - 1, motion.frame_rate,
      motion.frame_rate, prim);
}

}  // namespace

void write_usda(const std::filesystem::path& path, const FinishedMotion& motion) {
  const MeshFaces faces = motion.surface->faces();
  const std::vector<Triangle> triangles = fans_of(faces).triangles;
  write_file(path, [&](std::ostream& out) {
    write_head(out, motion);
    out << "        uniform token subdivisionScheme = \"none\"\n"
        << "        uniform bool doubleSided = 1\n        int[] faceVertexCounts = ";
    write_list(out, faces.sizes, number);
    out << "\n        int[] faceVertexIndices = ";
    write_list(out, faces.corners, number);
    out << '\n';
    write_texture(out, faces);
    out << "        point3f[] points.timeSamples";
    write_samples(out, motion.frames, motion.points);
    out << "        normal3f[] normals (\n            interpolation = \"vertex\"\n        )\n"
        << "        normal3f[] normals.timeSamples";
    write_samples(out, motion.frames,
                  [&](int frame) { return point_normals(motion.points(frame), triangles); });
    out << "    }\n}\n";
  });
}

}  // namespace weft
