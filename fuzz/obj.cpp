#include "fuzz/mesh_properties.h"
#include "weft/mesh.h"

namespace weft::fuzz {
namespace {

/// The polygons of an OBJ are its triangles' fans, and their texture coordinates exist.
void check_faces(std::string_view bytes) {
  const auto file = read_or_refuse([&] { return parse_obj_file(bytes, file_name); });
  if (!file) return;
  const MeshFaces& faces = file->faces;
  require(fans_of(faces).triangles == file->mesh.triangles, "polygons split into the triangles");
  require(faces.texture_corners.empty() || faces.texture_corners.size() == faces.corners.size(),
          "all corners have an index, or none has");
  for (const int index : faces.texture_corners)
    require(index >= -1 && index < static_cast<int>(faces.texture.size()),
            "corners use existing texture coordinates");
}

}  // namespace
}  // namespace weft::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  weft::fuzz::check_faces(weft::fuzz::as_text(data, size));
  return weft::fuzz::check_mesh(weft::fuzz::as_text(data, size), weft::parse_obj);
}
