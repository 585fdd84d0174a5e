#include "apps/weft/drawing.h"

#include <initializer_list>
#include <vector>

#include "weft/view/camera.h"
#include "weft/view/renderer.h"

namespace weft::app {
namespace {

void add(Box3d& box, const Box3d& other) {
  if (other.empty()) return;
  box.add(other.lower);
  box.add(other.upper);
}

double aspect(const ViewFrom& options) {
  return static_cast<double>(options.width) / options.height;
}

// The given frames of bodies and cloths.
Camera camera_of(const RunFolder& run, std::initializer_list<int> frames, const ViewFrom& options) {
  Box3d box;
  for (const int frame : frames) {
    for (const RecordedBody& body : run.bodies) add(box, bounds(body.positions_at(frame)));
    for (const RecordedCloth& cloth : run.cloths) add(box, bounds(cloth.recorded.positions(frame)));
  }
  return frame_box(box, options.azimuth, options.elevation, aspect(options));
}

// A scene points at its surfaces: this holds them while it is drawn.
struct RunFrame {
  std::vector<Planes3> cloths, bodies;
  DrawnScene scene;
};

RunFrame frame_of(const RunFolder& run, int frame, const Camera& camera) {
  static constexpr Vec3f colours[] = {
      {0.42F, 0.05F, 0.07F}, {0.05F, 0.13F, 0.32F}, {0.50F, 0.33F, 0.06F}};
  RunFrame drawn;
  drawn.scene.camera = camera;
  drawn.scene.ground = run.ground;
  drawn.cloths.reserve(run.cloths.size());
  for (std::size_t k = 0; k < run.cloths.size(); ++k) {
    drawn.cloths.push_back(run.cloths[k].recorded.positions(frame));
    DrawnSurface surface;
    surface.positions = &drawn.cloths.back();
    surface.mates = &run.cloths[k].image.mates;
    surface.colour = colours[k % std::size(colours)];
    drawn.scene.surfaces.push_back(surface);
  }
  drawn.bodies.reserve(run.bodies.size());
  for (const RecordedBody& body : run.bodies) {
    drawn.bodies.push_back(body.positions_at(frame));
    DrawnSurface surface;
    surface.positions = &drawn.bodies.back();
    surface.mates = &body.image.mates;
    surface.normals = body.normals ? &*body.normals : nullptr;
    surface.colour = {0.62F, 0.60F, 0.57F};
    surface.look = Look::body;
    drawn.scene.surfaces.push_back(surface);
  }
  return drawn;
}

}  // namespace

Picture draw_run(const RunFolder& run, int frame, const ViewFrom& options) {
  Renderer renderer(options.width, options.height);
  const int shown = frame < 0 ? run.frames - 1 : frame;
  return renderer.draw(frame_of(run, shown, camera_of(run, {shown}, options)).scene);
}

void film_run(const RunFolder& run, const std::filesystem::path& path, const ViewFrom& options,
              Progress* progress) {
  MovieWriter movie(path, options.width, options.height, run.frame_rate);
  Renderer renderer(options.width, options.height);
  const Camera camera = camera_of(run, {0, run.frames - 1}, options);
  for (int frame = 0; frame < run.frames; ++frame) {
    update(progress, "drawing", static_cast<double>(frame) / run.frames);
    movie.add(renderer.draw(frame_of(run, frame, camera).scene));
  }
  movie.finish();
}

}  // namespace weft::app
