#include <algorithm>

#include <fmt/format.h>

#include "apps/figures/figures.h"
#include "weft/camera.h"
#include "weft/convert.h"
#include "weft/drawing.h"
#include "weft/geometry_image.h"
#include "weft/picture.h"
#include "weft/shapes.h"

namespace weft::figures {
namespace {

Conversion convert_figure(int size) {
  ConvertOptions options;
  options.size = size;
  return convert_mesh(make_shape("mannequin"), "builtin:mannequin", options);
}

/// Adds rows and columns of the image on the surface, every `step` of them.
void add_lines(SurfaceDrawing& drawing, const GeometryImage& image, int step) {
  for (int line = 0; line < image.size(); line += step) {
    DrawnCurve row{{}, {0.80F, 0.20F, 0.15F}}, col{{}, {0.15F, 0.35F, 0.75F}};
    for (int k = 0; k < image.size(); ++k) {
      row.points.push_back(image.world_position(line, k));
      col.points.push_back(image.world_position(k, line));
    }
    drawing.curves.push_back(row);
    drawing.curves.push_back(col);
  }
}

void draw_samples(const GeometryImage& image, const std::filesystem::path& path) {
  const TriangleMesh mesh = rebuild_mesh(image).mesh;
  SurfaceDrawing drawing;
  drawing.mesh = &mesh;
  drawing.curve_radius = 0.0015;
  add_lines(drawing, image, (image.size() - 1) / 32);
  const Picture square =
      framed_by_mates(colours_of(image, 300), border_bands(image.mates), image.size());
  write_png(
      path,
      in_a_row({{draw_on_white(drawing, {360, square.height, 0.5, 0.15}), "its rows and columns"},
                {square, "the image"}}));
}

/// Draws the pyramid, each level of which has every second sample of the one before.
void draw_pyramid(const GeometryImage& image, const std::filesystem::path& path) {
  std::vector<Panel> panels;
  GeometryImage level = image;
  for (int size = image.size(); size >= 9; size = (size + 1) / 2) {
    const int step = (image.size() - 1) / (size - 1);
    level.cube = Planes3(size);
    for (int row = 0; row < size; ++row)
      for (int col = 0; col < size; ++col)
        level.cube.set(row, col, image.cube.at(row * step, col * step));
    panels.push_back({colours_of(level, 129), fmt::format("{0} x {0}", size)});
  }
  write_png(path, in_a_row(panels));
}

void draw_rebuilt(const std::filesystem::path& path) {
  const ViewFrom view{170, 290, 0.5, 0.15};
  const TriangleMesh mesh = make_shape("mannequin");
  const double diagonal = box_of(mesh).diagonal();
  constexpr double scale_end = 0.01;  // of the diagonal
  std::vector<Panel> surfaces, errors;
  for (const int size : {17, 33, 65, 129}) {
    const Conversion made = convert_figure(size);
    const TriangleMesh rebuilt = rebuild_mesh(made.image).mesh;
    SurfaceDrawing drawing;
    drawing.mesh = &rebuilt;
    surfaces.push_back({draw_on_white(drawing, view), fmt::format("{0} x {0}", size)});
    const SurfaceValues error = error_on_surface(made.image, made.input.mesh);
    drawing.mesh = &error.mesh;
    for (const double value : error.values)
      drawing.colours.push_back(amount_colour(value / (scale_end * diagonal)));
    errors.push_back(
        {draw_on_white(drawing, view), fmt::format("PSNR {:.1f} dB", made.quality.psnr_db)});
  }
  Picture figure = in_a_column({in_a_row(surfaces), in_a_row(errors)});
  add_legend(figure, amount_legend("distance to the mesh, of the diagonal",
                                   fmt::format("{:.0f} %", 100 * scale_end)));
  write_png(path, figure);
}

/// The two pictures of the first page.
void draw_pair(const std::filesystem::path& folder) {
  const Conversion made = convert_figure(257);
  write_png(folder / "mannequin-colours.png", colours_of(made.image, 257));
  write_png(folder / "mannequin-map.png",
            draw_map(*made.charts[0].mapped, {.side = 257, .edges = false}));
}

}  // namespace

void draw_images(const std::filesystem::path& folder) {
  draw_pair(folder);
  const Conversion made = convert_figure(129);
  draw_samples(made.image, folder / "samples.png");
  draw_pyramid(made.image, folder / "pyramid.png");
  draw_rebuilt(folder / "rebuilt.png");
}

}  // namespace weft::figures
