#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "weft/convert.h"
#include "weft/convert/pieces.h"
#include "weft/convert/surface_places.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/garment.h"
#include "weft/image/builtin.h"
#include "weft/image_file.h"
#include "weft/mesh.h"
#include "weft/shapes.h"

namespace weft {
namespace {

/// The triangle of the mesh that each sample lies in; none of holes. [n * n]
std::vector<SurfacePlace> sample_places(const Conversion& made) {
  const int n = made.image.size();
  std::vector<SurfacePlace> places(static_cast<std::size_t>(n) * n);
  for (const ConvertedChart& chart : made.charts) {
    const std::vector<SurfacePlace> own =
        surface_places(*chart.mapped, chart.piece->mesh.triangles, chart.mapped->map.size);
    for (int s = 0; s < chart.place.rows * chart.place.cols; ++s) {
      const int row = chart.place.row + s / chart.place.cols;
      const int col = chart.place.col + s % chart.place.cols;
      places[row * n + col] = {chart.piece->triangle[own[s].triangle], own[s].weights};
    }
  }
  return places;
}

SampleBlends blends_of(const Conversion& made, int vertices) {
  const TriangleMesh& mesh = made.input.mesh;
  const std::vector<SurfacePlace> places = sample_places(made);
  SampleBlends follows{vertices, std::vector<BlendedVertex>(places.size())};
  for (std::size_t s = 0; s < places.size(); ++s) {
    // On the cut, mates lie in different triangles; all get the place of their representative.
    const SurfacePlace& place =
        places[static_cast<std::size_t>(made.image.mates.representative(static_cast<int>(s)))];
    const Triangle& corners = mesh.triangles[place.triangle];
    for (int k = 0; k < 3; ++k)
      follows.blends[s].vertices[k] = made.input.source_vertex[corners[k]];
    follows.blends[s].weights = place.weights;
  }
  return follows;
}

/// The direction in which u grows on a triangle; 0 where its texture has no area.
Vec3d direction_of_u(const TriangleMesh& mesh, int triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3d first = mesh.positions[t[1]] - mesh.positions[t[0]];
  const Vec3d second = mesh.positions[t[2]] - mesh.positions[t[0]];
  const auto& [a, b, c] = mesh.corner_uv[triangle];
  const Vec2d to_b{double{b.x} - a.x, double{b.y} - a.y},
      to_c{double{c.x} - a.x, double{c.y} - a.y};
  const double area = to_b.x * to_c.y - to_b.y * to_c.x;
  return normalized(area * (to_c.y * first - to_b.y * second));
}

Planes3 warp_of(const Conversion& made) {
  Planes3 warp(made.image.size());
  const std::vector<SurfacePlace> places = sample_places(made);
  for (std::size_t s = 0; s < places.size(); ++s)
    if (places[s].triangle >= 0)
      warp.set(static_cast<int>(s),
               vec_cast<float>(direction_of_u(made.input.mesh, places[s].triangle)));
  return warp;
}

/// Where the vertices of the file lie in the image.
std::vector<Vec2d> places_of(const Conversion& made, int vertices) {
  std::vector<Vec2d> places(static_cast<std::size_t>(vertices), {NAN, NAN});
  for (const ConvertedChart& chart : made.charts) {
    std::vector<int> source;
    for (const int v : chart.piece->vertex) source.push_back(made.input.source_vertex[v]);
    const std::vector<Vec2d> own = vertex_places(*chart.mapped, source, vertices);
    for (std::size_t v = 0; v < own.size(); ++v)
      if (std::isfinite(own[v].x) && !std::isfinite(places[v].x))
        places[v] = own[v] + Vec2d{double(chart.place.col), double(chart.place.row)};
  }
  if (const std::vector<int>& welded = made.input.welded; !welded.empty())
    for (std::size_t v = 0; v < places.size(); ++v)
      if (!std::isfinite(places[v].x)) places[v] = places[welded[v]];
  return places;
}

/// Built-in shapes are in metres with y up; files are what their user says.
MeshFile load_mesh_file(const std::string& name, const MeshFrame& files) {
  if (is_builtin(name)) {
    MeshFile made{make_shape(name.substr(builtin_prefix.size())), {}};
    made.faces = faces_of(made.mesh);
    return made;
  }
  MeshFile file = read_mesh_file(name);
  file.mesh = in_metres_y_up(std::move(file.mesh), files);
  return file;
}

LoadedSurface image_alone(GeometryImage image) {
  LoadedSurface loaded;
  loaded.image = std::move(image);
  return loaded;
}

void check_texture_size(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.corner_uv.empty() || mesh.corner_uv.size() == mesh.triangles.size()) return;
  throw InputError(name,
                   fmt::format("texture coordinates for {} of {} triangles", mesh.corner_uv.size(),
                               mesh.triangles.size()),
                   "three a triangle, or none at all, are wanted");
}

}  // namespace

bool is_image_name(const std::string& name) {
  const std::string ending = ending_of(name);
  return !is_builtin(name) && (ending == ".exr" || ending == ".png" || ending == ".weft");
}

TriangleMesh load_mesh(const std::string& name) {
  if (is_builtin(name)) return make_shape(name.substr(builtin_prefix.size()));
  return read_mesh(name);
}

namespace {

/// Of panels with no room for two intervals. @return empty where there are none
std::string note_of_coarse(const Pattern& pattern, double spacing) {
  std::size_t coarse = 0;
  for (const PatternPanel& panel : pattern.panels) {
    const Vec2d extent = measure_panel(panel).extent;
    coarse += std::min(extent.x, extent.y) < 2 * spacing ? 1 : 0;
  }
  if (coarse == 0) return "";
  return fmt::format("{} of {} panels are narrower than two spacings of samples, {:.3g} mm each",
                     coarse, pattern.panels.size(), 1000 * spacing);
}

}  // namespace

bool is_image_surface(const Surface& surface) {
  if (surface.in_memory()) return surface.image != nullptr;
  const std::string& name = surface.name;
  return is_image_name(name) ||
         (is_builtin(name) && is_image_by_nature(name.substr(builtin_prefix.size())));
}

LoadedSurface load_surface(const Surface& surface, const ConvertOptions& options) {
  const std::string& name = surface.name;
  if (surface.image) {
    check_image(*surface.image, name);
    return image_alone(*surface.image);
  }
  if (!surface.mesh && is_image_name(name)) return image_alone(read_image(name));
  if (is_image_surface(surface)) {
    const int size = options.size == automatic_size ? ConvertOptions{}.size : options.size;
    return image_alone(make_image_shape(name.substr(builtin_prefix.size()), size));
  }
  if (!surface.mesh && is_pattern_name(name)) {
    const Pattern pattern = read_pattern(name);
    LoadedSurface loaded;
    loaded.garment = std::make_shared<const Garment>(
        make_garment(pattern, name, options.spacing, options.progress));
    loaded.image = loaded.garment->image;
    loaded.notes = pattern.notes;
    if (std::string note = note_of_coarse(pattern, options.spacing); !note.empty())
      loaded.notes.push_back(std::move(note));
    return loaded;
  }
  ConvertOptions quick = options;
  quick.measure = false;
  MeshFile file = surface.mesh ? MeshFile{*surface.mesh, {}} : load_mesh_file(name, options.files);
  if (surface.mesh) check_texture_size(*surface.mesh, name);
  const auto vertices = static_cast<int>(file.mesh.positions.size());
  Conversion made = convert_mesh(file.mesh, name, quick);
  LoadedSurface loaded;
  if (options.keep_places) loaded.follows = blends_of(made, vertices);
  // The faces of a mesh in memory, once the conversion has checked that it is valid.
  if (options.keep_source && surface.mesh) file.faces = faces_of(file.mesh);
  if (options.keep_source)
    loaded.source = {std::move(file.mesh.positions), std::move(file.faces),
                     places_of(made, vertices)};
  if (options.keep_warp && !made.input.mesh.corner_uv.empty()) loaded.warp = warp_of(made);
  loaded.texture = std::move(made.texture);
  loaded.image = std::move(made.image);
  loaded.normals = std::move(made.normals);
  loaded.notes = std::move(made.input.repairs);
  // Of a larger image than was asked for, say.
  loaded.notes.insert(loaded.notes.end(), made.warnings.begin(), made.warnings.end());
  return loaded;
}

}  // namespace weft
