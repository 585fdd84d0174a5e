#include "weft/mesh.h"
#include "weft/mesh/io/gltf_surface.h"
#include "weft/mesh/io/polygon.h"
#include "weft/repair.h"

namespace weft {

TriangleMesh parse_gltf(std::string_view bytes, std::string_view name,
                        const std::optional<std::filesystem::path>& folder) {
  GltfDocument document(bytes, name, folder);
  TriangleMesh mesh = read_gltf_surface(document).mesh;
  require_surface(mesh, name);
  keep_whole_texture(mesh);
  return weld_exact(mesh);
}

}  // namespace weft
