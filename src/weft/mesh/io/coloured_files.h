#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weft/mesh_colours.h"

namespace weft {

/// What a mesh's file names beside it: materials and pictures, from its folder or below.
class NeighbourFiles {
 public:
  /// @param name  of the mesh, for errors, kept as a view
  NeighbourFiles(std::filesystem::path folder, std::string_view name)
      : folder_(std::move(folder)), name_(name) {}
  /// @param file  as the mesh's file names it; backslashes part folders, too
  /// @throws InputError for one elsewhere, or that cannot be read
  [[nodiscard]] std::string read(const std::string& file) const;
  /// The number of a picture among those of `colours`, to which it is added once.
  int picture(const std::string& file, SurfaceColours& colours);

 private:
  [[nodiscard]] std::filesystem::path place_of(std::string file) const;

  std::filesystem::path folder_;
  std::string_view name_;
  std::map<std::string, int> pictures_;
};

/// Display colours of vertices as linear light. Where one is above 1, all go up to 255; one that is
/// not finite, as of a vertex without colour where others have one, is white.
std::vector<Vec3f> linear_colours(const std::vector<Vec3f>& displays);

/// Colours of a file that parse_ply, parse_obj or parse_gltf reads; without parts and corners where
/// it has none. @throws InputError as those
SurfaceColours ply_colours(std::string_view bytes, std::string_view name, NeighbourFiles& files);
SurfaceColours obj_colours(std::string_view bytes, std::string_view name, NeighbourFiles& files);
SurfaceColours gltf_colours(std::string_view bytes, std::string_view name,
                            const std::filesystem::path& folder);

/// A material of an OBJ file: its picture lies where texture coordinates, scaled and then moved,
/// say.
struct ObjMaterial {
  SurfaceColours::Part part;
  Vec2f scale{1, 1}, offset{};
};
using ObjMaterials = std::map<std::string, ObjMaterial, std::less<>>;
/// The materials of an OBJ file's library by their names: of each the picture of `map_Kd`, or the
/// colour of `Kd`.
/// @param name  what errors call it
/// @throws InputError for numbers that are none, and for pictures with turbulence
ObjMaterials parse_materials(std::string_view text, std::string_view name, NeighbourFiles& files,
                             SurfaceColours& colours);

}  // namespace weft
