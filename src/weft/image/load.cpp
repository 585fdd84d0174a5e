#include <cctype>
#include <filesystem>

#include "weft/image/builtin.h"
#include "weft/image/convert.h"
#include "weft/image/io/image_file.h"
#include "weft/mesh/io/read_mesh.h"
#include "weft/mesh/shapes.h"

namespace weft {
namespace {

constexpr std::string_view builtin_prefix = "builtin:";

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
  if (is_image_name(name)) return {read_image(name), {}, {}};
  if (name.starts_with(builtin_prefix)) {
    const std::string shape = name.substr(builtin_prefix.size());
    const int size = options.size == automatic_size ? ConvertOptions{}.size : options.size;
    if (is_image_by_nature(shape)) return {make_image_shape(shape, size), {}, {}};
  }
  ConvertOptions quick = options;
  quick.measure = false;
  Conversion made = convert_mesh(load_mesh(name), name, quick);
  return {std::move(made.image), std::move(made.normals), std::move(made.input.repairs)};
}

}  // namespace weft
