#include <array>
#include <cctype>
#include <string>
#include <utility>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh.h"

namespace weft {
namespace {

using Parser = TriangleMesh (*)(std::string_view, std::string_view);

TriangleMesh parse_by_ending(std::string_view bytes, const std::filesystem::path& path) {
  constexpr std::array<std::pair<std::string_view, Parser>, 4> parsers{
      {{".obj", parse_obj}, {".off", parse_off}, {".ply", parse_ply}, {".stl", parse_stl}}};
  const std::string ending = ending_of(path);
  for (const auto& [known, parser] : parsers)
    if (known == ending) return parser(bytes, path.string());
  if (ending == ".glb" || ending == ".gltf")
    return parse_gltf(bytes, path.string(), path.parent_path());
  throw InputError(path.string(), "the ending '" + ending + "' is not that of a mesh",
                   ".obj, .off, .ply, .stl, .glb or .gltf is wanted");
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path) {
  // What is missing or a folder is told before what has a wrong ending.
  const std::string bytes = read_file(path);
  return parse_by_ending(bytes, path);
}

}  // namespace weft
