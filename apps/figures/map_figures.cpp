#include <fmt/format.h>

#include "apps/figures/figures.h"
#include "weft/convert.h"
#include "weft/drawing.h"
#include "weft/param/chords.h"
#include "weft/picture.h"
#include "weft/shapes.h"
#include "weft/view/map_picture.h"

namespace weft::figures {
namespace {

constexpr int side = 225;

Conversion convert(const char* shape, const ConvertOptions& options) {
  return convert_mesh(make_shape(shape), std::string("builtin:") + shape, options);
}

void draw_border(const std::filesystem::path& path) {
  ConvertOptions options;
  options.size = 129;
  options.measure = false;
  const Conversion made = convert("double_torus", options);
  SurfaceDrawing drawing;
  drawing.mesh = &made.input.mesh;
  drawing.curve_radius = 0.006;
  add_cut(drawing, *made.charts[0].mapped);
  const Picture square =
      framed_by_mates(draw_map(*made.charts[0].mapped, {.side = side, .stretch = false}),
                      border_bands(*made.charts[0].mapped), options.size);
  write_png(path, in_a_row({{draw_on_white(drawing, {400, square.height, 0.35, 0.85}),
                             "paths and nodes of the cut"},
                            {square, "around the square"}}));
}

/// A disk of eight border vertices and one inside, two of whose edges are chords.
DiskMesh disk_with_chords() {
  DiskMesh disk;
  const std::vector<Vec2d> places{{0, 0}, {2, 0}, {4, 0}, {4, 2},  {4, 4},
                                  {2, 4}, {0, 4}, {0, 2}, {2, 2.6}};
  for (int v = 0; v < static_cast<int>(places.size()); ++v) {
    // The map's v runs down in pictures.
    disk.positions.push_back({places[v].x, -places[v].y, 0});
    disk.surface_vertex.push_back(v);
    if (v < 8) disk.border.push_back(v);
  }
  // Bulges of the lower and the right side, so that the chords have triangles to hold.
  disk.positions[1].y = 0.8;
  disk.positions[3].x = 4.8;
  disk.triangles = {{0, 1, 2}, {2, 3, 4}, {0, 2, 8}, {2, 4, 8},
                    {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 0, 8}};
  return disk;
}

/// Tutte map of the disk: its border on that of the square, inner vertices at the mean of their
/// neighbours.
SquareMap tutte_map(const DiskMesh& disk) {
  SquareMap map{5, {{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4}, {0, 4}, {0, 2}}};
  map.uv.resize(disk.positions.size(), {2, 2});
  for (int round = 0; round < 200; ++round)
    for (std::size_t v = 8; v < map.uv.size(); ++v) {
      Vec2d sum;
      int count = 0;
      for (const Triangle& t : disk.triangles)
        for (int k = 0; k < 3; ++k)
          if (t[k] == static_cast<int>(v)) {
            sum = sum + map.uv[t[(k + 1) % 3]] + map.uv[t[(k + 2) % 3]];
            count += 2;
          }
      map.uv[v] = (1.0 / count) * sum;
    }
  return map;
}

void draw_chords(const std::filesystem::path& path) {
  DiskMesh disk = disk_with_chords();
  // Seen from the front, triangles face away: the picture's v runs down.
  TriangleMesh mesh{disk.positions, disk.triangles};
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  SurfaceDrawing surface;
  surface.mesh = &mesh;
  surface.show_edges = true;
  surface.curve_radius = 0.006;
  for (const auto& [a, b] : {std::array{0, 2}, std::array{2, 4}})
    surface.curves.push_back({{mesh.positions[a], mesh.positions[b]}, {0.80F, 0.15F, 0.12F}});
  std::vector<Panel> panels{{draw_on_white(surface, {300, 312, 0, 0}), "two chords"}};
  for (const char* label : {"their triangles collapse", "chords split"}) {
    panels.push_back({draw_map(disk, tutte_map(disk), {.side = 280}), label});
    split_chords(disk);
  }
  for (Panel& panel : panels) panel.picture = framed_by_mates(panel.picture, {}, 5);
  write_png(path, in_a_row(panels));
}

void draw_parameterizers(const std::filesystem::path& path) {
  std::vector<Panel> squares, surfaces;
  for (const bool floater : {true, false}) {
    ConvertOptions options;
    options.measure = false;
    if (floater) options.parameterizer = FloaterOptions{};
    const Conversion made = convert("mannequin", options);
    Picture square = draw_map(*made.charts[0].mapped, {.side = side, .edges = false});
    square = framed_by_mates(square, border_bands(*made.charts[0].mapped), options.size);
    const SurfaceValues stretch = stretch_on_surface(*made.charts[0].mapped);
    SurfaceDrawing drawing = draw_stretch(stretch);
    drawing.legend.reset();
    squares.push_back({square, fmt::format("{}: L2 {:.2f}", floater ? "floater" : "stretch",
                                           made.map_quality.stretch_l2)});
    surfaces.push_back({draw_on_white(drawing, {140, square.height, 0.5, 0.15}), ""});
  }
  Picture figure = in_a_row({squares[0], surfaces[0], squares[1], surfaces[1]});
  add_legend(figure, stretch_legend("stretch"));
  write_png(path, figure);
}

}  // namespace

void draw_maps(const std::filesystem::path& folder) {
  draw_border(folder / "border.png");
  draw_chords(folder / "chords.png");
  draw_parameterizers(folder / "maps.png");
}

}  // namespace weft::figures
