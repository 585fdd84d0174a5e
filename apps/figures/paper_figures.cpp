#include <algorithm>

#include <fmt/format.h>

#include "apps/figures/figures.h"
#include "weft/camera.h"
#include "weft/convert.h"
#include "weft/drawing.h"
#include "weft/picture.h"
#include "weft/shapes.h"

namespace weft::figures {
namespace {

constexpr Vec3f plaster{0.62F, 0.60F, 0.57F};

Conversion convert_figure(const ConvertOptions& options) {
  return convert_mesh(make_shape("mannequin"), "builtin:mannequin", options);
}

/// Draws a mesh and geometry images of it from one camera.
class Portrait {
 public:
  Portrait(const TriangleMesh& mesh, int width, int height)
      : mesh_(mesh), renderer_(width, height) {
    Outline outline;
    outline.add(mesh);
    scene_.camera = frame_points(outline.points(), 0.5, 0.15, static_cast<double>(width) / height);
    scene_.on_white = true;
  }
  /// Frames the upper part of the mesh alone, which has the most detail.
  void look_at_head() {
    const Vec3d middle = 0.5 * (box_of(mesh_).lower + box_of(mesh_).upper);
    const double top = box_of(mesh_).upper.y;
    Outline outline;
    for (const Vec3d p : mesh_.positions)
      if (p.y > top - 0.22 * (top - middle.y) * 2) outline.add(p);
    scene_.camera = frame_points(outline.points(), 0.5, 0.15, 0.75);
  }
  Picture of_mesh() {
    DrawnMesh drawn;
    drawn.mesh = &mesh_;
    scene_.surfaces.clear();
    scene_.meshes = {drawn};
    return renderer_.draw(scene_);
  }
  /// @param normals  or null: made from the samples
  Picture of_image(const GeometryImage& image, const NormalMap* normals) {
    const Planes3 positions = world_positions(image);
    DrawnSurface drawn;
    drawn.positions = &positions;
    drawn.mates = &image.mates;
    drawn.normals = normals;
    drawn.colour = plaster;
    drawn.look = Look::body;
    scene_.meshes.clear();
    scene_.surfaces = {drawn};
    return renderer_.draw(scene_);
  }

 private:
  const TriangleMesh& mesh_;
  Renderer renderer_;
  DrawnScene scene_;
};

/// Figure 1 of the paper.
void draw_normal_mapped(const std::filesystem::path& path) {
  ConvertOptions options;
  options.size = 65;
  options.normal_map_size = 513;
  options.measure = false;
  const Conversion made = convert_figure(options);
  Portrait portrait(made.input.mesh, 240, 320);
  portrait.look_at_head();
  write_png(
      path,
      in_a_row({{portrait.of_mesh(), fmt::format("{} triangles", made.input.mesh.triangles.size())},
                {portrait.of_image(made.image, nullptr), "65 x 65 samples"},
                {portrait.of_image(made.image, &*made.normals), "with normal map"}}));
}

/// Normals as colours: -1 to 1 as dark to bright.
Picture normal_colours(const NormalMap& normals, int side) {
  Picture picture{side, side, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto nearest = [&](int i) { return i * (normals.size() - 1) / (side - 1); };
      const Vec3f n = normals.normal.at(nearest(y), nearest(x));
      for (const float channel : {n.x, n.y, n.z})
        picture.rgb.push_back(static_cast<std::uint8_t>(127.5F + 127.5F * channel));
    }
  return picture;
}

/// Figure 2 of the paper, a picture for each of its eight.
void draw_way(const std::filesystem::path& path) {
  constexpr int side = 193;
  const ViewFrom view{side, 236, 0.5, 0.15};
  std::vector<Panel> cuts, maps, images;
  for (const bool augment : {false, true}) {
    ConvertOptions options;
    options.augment = augment;
    options.measure = false;
    options.parameterizer = FloaterOptions{};
    const Conversion made = convert_figure(options);
    SurfaceDrawing drawing;
    drawing.mesh = &made.input.mesh;
    add_cut(drawing, *made.charts[0].mapped);
    cuts.push_back({draw_on_white(drawing, view), augment ? "(c) improved cut" : "(a) first cut"});
    maps.push_back({draw_map(*made.charts[0].mapped, {.side = side, .edges = false}),
                    augment ? "(d) floater" : "(b) floater"});
  }
  ConvertOptions options;
  options.size = side;
  options.normal_map_size = 513;
  const Conversion made = convert_figure(options);
  maps.push_back({draw_map(*made.charts[0].mapped, {.side = side, .edges = false}), "(e) stretch"});
  images.push_back({colours_of(made.image, side), "(f) image"});
  images.push_back({normal_colours(*made.normals, side), "(g) normal map"});
  Portrait portrait(made.input.mesh, view.width, view.height);
  images.push_back({portrait.of_image(made.image, &*made.normals), "(h) rebuilt"});
  write_png(path, in_a_column({in_a_row({cuts[0], maps[0], cuts[1], maps[1]}),
                               in_a_row({maps[2], images[0], images[1], images[2]})}));
}

}  // namespace

void draw_papers(const std::filesystem::path& folder) {
  draw_normal_mapped(folder / "normal-mapped.png");
  draw_way(folder / "way.png");
}

}  // namespace weft::figures
