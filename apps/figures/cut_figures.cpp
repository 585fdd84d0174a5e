#include <algorithm>

#include <fmt/format.h>

#include "apps/figures/figures.h"
#include "weft/convert.h"
#include "weft/cut/cut_graph.h"
#include "weft/cut/cut_surface.h"
#include "weft/cut/open_to_disk.h"
#include "weft/cut/straighten.h"
#include "weft/drawing.h"
#include "weft/picture.h"
#include "weft/shapes.h"

namespace weft::figures {
namespace {

constexpr int seed_triangle = 0;
const ViewFrom from_above{440, 330, 0.35, 0.85};

/// Draws the distance from the seed, and the cut from it.
void draw_distance(const CutSurface& surface, const std::filesystem::path& path) {
  const TriangleMesh& mesh = surface.mesh();
  const std::vector<double> distance = paths_from(surface, mesh.triangles[seed_triangle]).distance;
  const double largest = *std::max_element(distance.begin(), distance.end());
  SurfaceDrawing drawing;
  drawing.mesh = &mesh;
  for (const double d : distance) drawing.colours.push_back(amount_colour(0.8 * d / largest));
  drawing.nodes = {mesh.positions[mesh.triangles[seed_triangle][0]]};
  drawing.curve_radius = 0.008;
  drawing.legend = amount_legend("distance from the seed", fmt::format("{:.2g} m", largest));
  drawing.legend->colour = [](double place) { return amount_colour(0.8 * place); };
  SurfaceDrawing cut;
  cut.mesh = &mesh;
  add_cut(cut, cut_open(mesh, cut_from_seed(CutGraph(surface), seed_triangle).cut()));
  ViewFrom plain = from_above;
  plain.height -= legend_height(plain.width);
  write_png(path, in_a_row({{draw_on_white(drawing, from_above), "triangles go in this order"},
                            {draw_on_white(cut, plain), "edges never crossed, pruned"}}));
}

void draw_straightened(const CutSurface& surface, const std::filesystem::path& path) {
  std::vector<Panel> panels;
  CutGraph graph = cut_from_seed(CutGraph(surface), seed_triangle);
  for (const bool straight : {false, true}) {
    if (straight) straighten(graph);
    SurfaceDrawing drawing;
    drawing.mesh = &surface.mesh();
    add_cut(drawing, cut_open(surface.mesh(), graph.cut()));
    panels.push_back(
        {draw_on_white(drawing, from_above),
         fmt::format("{}: {:.2f} m", straight ? "straightened" : "pruned", graph.length())});
  }
  write_png(path, in_a_row(panels));
}

void draw_augmented(const std::filesystem::path& path) {
  const TriangleMesh mesh = make_shape("mannequin");
  std::vector<Panel> panels;
  for (const bool augment : {false, true}) {
    ConvertOptions options;
    options.augment = augment;
    options.measure = false;
    const Conversion made = convert_mesh(mesh, "builtin:mannequin", options);
    const SurfaceValues stretch = stretch_on_surface(*made.charts[0].mapped);
    SurfaceDrawing drawing = draw_stretch(stretch);
    add_cut(drawing, *made.charts[0].mapped);
    panels.push_back(
        {draw_on_white(drawing, {360, 480, 0.5, 0.15}),
         fmt::format("{}: L2 {:.2f}",
                     augment ? fmt::format("{} paths more", made.rounds) : std::string("first cut"),
                     made.map_quality.stretch_l2)});
  }
  write_png(path, in_a_row(panels));
}

}  // namespace

void draw_cuts(const std::filesystem::path& folder) {
  const TriangleMesh mesh = make_shape("double_torus");
  const CutSurface surface(mesh);
  draw_distance(surface, folder / "distance.png");
  draw_straightened(surface, folder / "straighten.png");
  draw_augmented(folder / "augment.png");
}

}  // namespace weft::figures
