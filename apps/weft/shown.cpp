#include "apps/weft/shown.h"

#include <algorithm>
#include <utility>

#include "apps/weft/terminal_progress.h"
#include "weft/drawing.h"
#include "weft/error.h"
#include "weft/garment.h"
#include "weft/geometry_image.h"
#include "weft/image_file.h"
#include "weft/repair.h"

namespace weft::app {
namespace {

/// Meshes with more triangles are drawn without their edges.
constexpr int max_edges_shown = 3000;
constexpr int default_size = 257;

int size_of(const ShownArgs& args) { return args.size > 0 ? args.size : default_size; }

std::string list_of(const std::vector<std::string>& args) {
  std::string list;
  for (const std::string& arg : args) list.append(list.empty() ? "" : ", ").append(arg);
  return list;
}

void check(const ShownArgs& args, bool is_image) {
  const auto& known = is_image ? shown_of_images() : shown_of_meshes();
  if (std::find(known.begin(), known.end(), args.show) == known.end())
    throw UsageError("--show", "'" + args.show + "' of " + (is_image ? "an image" : "a mesh"),
                     list_of(known) + " is wanted");
  const bool converts = !is_image && args.show != "surface";
  if (!converts && args.size > 0)
    throw UsageError("--size", "nothing is converted to show this", "leave it out");
  if ((!converts || args.show == "cut") && !args.parameterizer.empty())
    throw UsageError("--parameterizer", "nothing is mapped to show this", "leave it out");
  const bool compares = is_image && args.show == "error";
  if (compares && args.against.empty())
    throw UsageError("--show error", "no mesh to compare the image with",
                     "--against MESH is wanted");
  if (!compares && !args.against.empty())
    throw UsageError("--against", "nothing is compared to show this",
                     "an image and --show error are wanted");
}

int flat_side(const ViewFrom& view) { return std::min(view.width, view.height); }

}  // namespace

const std::vector<std::string>& shown_of_meshes() {
  static const std::vector<std::string> args{"cut",     "map",   "stretch", "colours",
                                             "surface", "mates", "error"};
  return args;
}

const std::vector<std::string>& shown_of_images() {
  static const std::vector<std::string> args{"colours", "surface", "cut",
                                             "stretch", "mates",   "error"};
  return args;
}

Shown::Shown(const ShownArgs& asked, const Context& context) : view_(asked.view) {
  if (is_pattern_name(asked.subject)) {
    show_pattern(asked);
    return;
  }
  const bool is_image = is_image_name(asked.subject);
  ShownArgs args = asked;
  if (args.show.empty())
    args.show = is_image ? shown_of_images().front() : shown_of_meshes().front();
  check(args, is_image);
  if (!is_image) {
    show_mesh(args, context);
  } else if (args.show == "error") {
    show_error(read_image(args.subject), load_mesh(args.against));
  } else {
    show_image(args, read_image(args.subject));
  }
}

void Shown::show(SurfaceDrawing drawing, const ViewFrom& view) {
  drawing.mesh = &surface_.mesh;
  painter_ = std::make_unique<SurfacePainter>(drawing, view);
}

void Shown::show_pattern(const ShownArgs& args) {
  for (const auto& [option, given] : {std::pair{"--show", !args.show.empty()},
                                      {"--size", args.size > 0},
                                      {"--against", !args.against.empty()},
                                      {"--parameterizer", !args.parameterizer.empty()}})
    if (given)
      throw UsageError(option, "the subject is a sewing pattern",
                       "it shows its panels; leave it out");
  flat_ = draw_pattern(read_pattern(args.subject), args.view.width, args.view.height);
}

void Shown::show_mesh(const ShownArgs& args, const Context& context) {
  TriangleMesh mesh = load_mesh(args.subject);
  if (args.show == "cut") return show_cut(args, context, mesh);
  if (args.show != "surface") return show_conversion(args, context, mesh);
  surface_.mesh = std::move(mesh);
  show({}, args.view);
}

void Shown::show_cut(const ShownArgs& args, const Context& context, const TriangleMesh& mesh) {
  TerminalProgress progress(context.quiet || context.json);
  CutPreview cut = preview_cut(mesh, args.subject,
                               {.augment = true, .size = size_of(args), .progress = &progress});
  surface_.mesh = std::move(cut.input.mesh);
  SurfaceDrawing drawing;
  for (const auto& disk : cut.disks) add_cut(drawing, *disk);
  drawing.show_edges = static_cast<int>(surface_.mesh.triangles.size()) <= max_edges_shown;
  show(drawing, args.view);
}

void Shown::show_conversion(const ShownArgs& args, const Context& context,
                            const TriangleMesh& mesh) {
  TerminalProgress progress(context.quiet || context.json);
  ConvertOptions options;
  options.size = size_of(args);
  if (args.parameterizer == "floater") options.parameterizer = FloaterOptions{};
  // Maps are drawn one at a time.
  if (args.show == "map" || args.show == "stretch") options.charts = ChartChoice::one;
  options.measure = false;
  options.threads = context.threads;
  options.progress = &progress;
  const Conversion made = convert_mesh(mesh, args.subject, options);
  if (args.show == "error") return show_error(made.image, made.input.mesh);
  if (args.show == "stretch") {
    surface_ = stretch_on_surface(*made.charts[0].mapped);
    SurfaceDrawing drawing = draw_stretch(surface_);
    add_cut(drawing, *made.charts[0].mapped);
    return show(drawing, args.view);
  }
  if (args.show != "map") return show_image(args, made.image);
  MapDrawing drawing;
  drawing.side = flat_side(args.view);
  drawing.edges = static_cast<int>(made.input.mesh.triangles.size()) <= max_edges_shown;
  flat_ = framed_by_mates(draw_map(*made.charts[0].mapped, drawing),
                          border_bands(*made.charts[0].mapped), made.image.size());
  add_legend(flat_, stretch_legend("stretch"));
}

void Shown::show_image(const ShownArgs& args, const GeometryImage& image) {
  if (args.show == "colours") {
    flat_ = args.sized ? colours_of(image, flat_side(args.view)) : colours_of(image);
  } else if (args.show == "mates" && !image.has_one_chart()) {
    flat_ = marked_by_mates(colours_of(image, flat_side(args.view)), image.mates);
  } else if (args.show == "mates") {
    flat_ = framed_by_mates(colours_of(image, flat_side(args.view)), border_bands(image.mates),
                            image.size());
  } else {
    SurfaceDrawing drawing;
    if (args.show == "stretch") {
      surface_ = stretch_on_surface(image);
      drawing = draw_stretch(surface_);
    } else {
      RebuiltMesh rebuilt = rebuild_mesh(image);
      for (const Vec3f colour : vertex_colours(image, rebuilt))
        drawing.colours.push_back(display_colour(colour));
      surface_.mesh = std::move(rebuilt.mesh);
    }
    if (args.show != "surface") add_cut(drawing, image);
    show(drawing, args.view);
  }
}

void Shown::show_error(const GeometryImage& image, const TriangleMesh& mesh) {
  surface_ = error_on_surface(image, mesh);
  show(draw_error(surface_), view_);
}

void Shown::add_to(Outline& outline, int /*frame*/) const { outline.add(surface_.mesh); }

Picture Shown::draw(int /*frame*/, const Camera& camera) {
  return painter_ ? painter_->draw(camera) : flat_;
}

}  // namespace weft::app
