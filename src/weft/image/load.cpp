#include <cctype>
#include <filesystem>

#include "weft/image/builtin.h"
#include "weft/image/convert.h"
#include "weft/image/io/image_file.h"
#include "weft/image/surface_places.h"
#include "weft/mesh/io/read_mesh.h"
#include "weft/mesh/shapes.h"

namespace weft {
namespace {

constexpr std::string_view builtin_prefix = "builtin:";

SampleBlends blends_of(const Conversion& made, int vertices) {
  const TriangleMesh& mesh = made.input.mesh;
  const std::vector<SurfacePlace> places =
      surface_places(made.mapped, mesh.triangles, made.image.size());
  SampleBlends follows{vertices, std::vector<BlendedVertex>(places.size())};
  for (std::size_t s = 0; s < places.size(); ++s) {
    // On the cut, mates lie in different triangles: one of them speaks for all.
    const SurfacePlace& place =
        places[static_cast<std::size_t>(made.image.mates.representative(static_cast<int>(s)))];
    const Triangle& corners = mesh.triangles[place.triangle];
    for (int k = 0; k < 3; ++k)
      follows.blends[s].vertices[k] = made.input.source_vertex[corners[k]];
    follows.blends[s].weights = place.weights;
  }
  return follows;
}

}  // namespace

bool is_image_name(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return !name.starts_with(builtin_prefix) && (ending == ".exr" || ending == ".png");
}

TriangleMesh load_mesh(const std::string& name) {
  if (name.starts_with(builtin_prefix)) return make_shape(name.substr(builtin_prefix.size()));
  return read_mesh(name);
}

LoadedSurface load_surface(const std::string& name, const ConvertOptions& options) {
  if (is_image_name(name)) return {read_image(name), {}, {}, {}};
  if (name.starts_with(builtin_prefix)) {
    const std::string shape = name.substr(builtin_prefix.size());
    const int size = options.size == automatic_size ? ConvertOptions{}.size : options.size;
    if (is_image_by_nature(shape)) return {make_image_shape(shape, size), {}, {}, {}};
  }
  ConvertOptions quick = options;
  quick.measure = false;
  const TriangleMesh mesh = load_mesh(name);
  Conversion made = convert_mesh(mesh, name, quick);
  std::optional<SampleBlends> follows;
  if (options.keep_places) follows = blends_of(made, static_cast<int>(mesh.positions.size()));
  return {std::move(made.image), std::move(made.normals), std::move(made.input.repairs),
          std::move(follows)};
}

}  // namespace weft
