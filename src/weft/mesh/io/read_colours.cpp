#include <algorithm>
#include <utility>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/coloured_files.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/texture_picture.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& path) {
  return !path.empty() && !path.is_absolute() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

SurfaceColours colours_by_ending(const std::string& bytes, const fs::path& path) {
  const std::string ending = ending_of(path), name = path.string();
  NeighbourFiles files(path.parent_path(), name);
  if (ending == ".ply") return ply_colours(bytes, name, files);
  if (ending == ".obj") return obj_colours(bytes, name, files);
  if (ending == ".glb" || ending == ".gltf") return gltf_colours(bytes, name, path.parent_path());
  throw InputError(name, "a format without colours", "PLY, OBJ, GLB or glTF is wanted");
}

}  // namespace

fs::path NeighbourFiles::place_of(std::string file) const {
  std::replace(file.begin(), file.end(), '\\', '/');
  const fs::path path(file);
  if (!is_below(path) || file.find('\0') != file.npos)
    throw InputError(name_, "names the file " + in_quotes(file),
                     "one in the mesh's folder or below is wanted");
  return folder_ / path;
}

std::string NeighbourFiles::read(const std::string& file) const {
  return read_file(place_of(file));
}

int NeighbourFiles::picture(const std::string& file, SurfaceColours& colours) {
  const auto [known, is_new] = pictures_.try_emplace(file, colours.pictures.size());
  if (is_new) {
    colours.pictures.push_back(decode_texture(read(file), (folder_ / file).string()));
    colours.files.push_back(place_of(file));
  }
  return known->second;
}

std::vector<Vec3f> linear_colours(const std::vector<Vec3f>& displays) {
  float most = 0;
  for (const Vec3f c : displays) most = std::max({most, c.x, c.y, c.z});
  std::vector<Vec3f> linear;
  for (const Vec3f c : displays) {
    const bool known = std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
    linear.push_back(known ? linear_colour((most > 1 ? 1 / 255.0F : 1.0F) * c) : Vec3f{1, 1, 1});
  }
  return linear;
}

SurfaceColours read_colours(const fs::path& path) {
  const std::string bytes = read_file(path);
  SurfaceColours colours = colours_by_ending(bytes, path);
  if (colours.parts.empty() && colours.corners.empty())
    throw InputError(path.string(), "has no colours",
                     "vertex colours, or materials with colours or pictures, are wanted");
  return colours;
}

}  // namespace weft
