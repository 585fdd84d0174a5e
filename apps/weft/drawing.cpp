#include "apps/weft/drawing.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "weft/drawing.h"
#include "weft/picture.h"

namespace weft::app {
namespace {

constexpr Vec3f plaster{0.62F, 0.60F, 0.57F};
constexpr Vec3f cloth_colours[] = {
    {0.42F, 0.05F, 0.07F}, {0.05F, 0.13F, 0.32F}, {0.50F, 0.33F, 0.06F}};

/// A frame of a run: its scene, and the surfaces that the scene points to.
struct RunFrame {
  std::vector<Planes3> cloths, bodies;
  std::vector<Planes3> colours;  // of cloths
  std::vector<NormalMap> normals;
  DrawnScene scene;
};

/// In the colours of its image, where that has some.
void paint(DrawnSurface& surface, const GeometryImage& image) {
  if (!image.has_colours()) return;
  surface.colours = &image.colours;
  surface.colour = {1, 1, 1};
}

/// In these colours, without weave or sheen.
void paint(DrawnSurface& surface, const Planes3& colours) {
  surface.colours = &colours;
  surface.colour = {1, 1, 1};
  surface.look = Look::body;
}

void add_cloth(RunFrame& drawn, const RecordedCloth& cloth, const std::vector<char>& rising,
               int frame, const std::optional<StrainColours>& strain) {
  const std::size_t k = drawn.cloths.size();
  drawn.cloths.push_back(cloth.recorded.positions(frame));
  DrawnSurface surface;
  surface.positions = &drawn.cloths.back();
  surface.mates = &cloth.image.mates;
  surface.rising = &rising;
  surface.revision = static_cast<std::uint64_t>(frame) + 1;
  surface.colour = cloth_colours[k % std::size(cloth_colours)];
  paint(surface, cloth.image);
  if (strain) paint(surface, drawn.colours.emplace_back(strain->of(k, drawn.cloths.back())));
  drawn.scene.surfaces.push_back(surface);
}

void add_body(RunFrame& drawn, const RecordedBody& body, const std::vector<char>& rising,
              int frame) {
  drawn.bodies.push_back(body.positions_at(frame));
  DrawnSurface surface;
  surface.positions = &drawn.bodies.back();
  surface.mates = &body.image.mates;
  surface.rising = &rising;
  surface.revision = body.recorded ? static_cast<std::uint64_t>(frame) + 1 : 1;
  if (body.normals && body.recorded) {
    drawn.normals.push_back(
        carried_normals(body.positions, *body.normals, drawn.bodies.back(), &body.image.mates));
    surface.normals = &drawn.normals.back();
  } else if (body.normals) {
    surface.normals = &*body.normals;
  }
  surface.colour = plaster;
  paint(surface, body.image);
  surface.look = Look::body;
  drawn.scene.surfaces.push_back(surface);
}

}  // namespace

RunSubject::RunSubject(RunFolder run, const ViewFrom& size, bool by_strain)
    : run_(std::move(run)),
      strain_(by_strain ? std::optional<StrainColours>(run_) : std::nullopt),
      size_{size.width, size.height - (by_strain ? legend_height(size.width) : 0)},
      renderer_(size_.width, size_.height) {
  for (const RecordedCloth& cloth : run_.cloths) cloth_quads_.push_back(rising_quads(cloth.image));
  for (const RecordedBody& body : run_.bodies) body_quads_.push_back(rising_quads(body.image));
}

double RunSubject::max_strain(int frame) const {
  std::vector<Planes3> cloths;
  for (const RecordedCloth& cloth : run_.cloths) cloths.push_back(cloth.recorded.positions(frame));
  return strain_->most_of(cloths);
}

void RunSubject::add_to(Outline& outline, int frame) const {
  for (const RecordedBody& body : run_.bodies) outline.add(body.positions_at(frame));
  for (const RecordedCloth& cloth : run_.cloths) outline.add(cloth.recorded.positions(frame));
}

Picture RunSubject::draw(int frame, const Camera& camera) {
  RunFrame drawn;
  drawn.scene.camera = camera;
  drawn.scene.ground = run_.ground;
  drawn.cloths.reserve(run_.cloths.size());
  drawn.colours.reserve(run_.cloths.size());
  for (std::size_t i = 0; i < run_.cloths.size(); ++i)
    add_cloth(drawn, run_.cloths[i], cloth_quads_[i], frame, strain_);
  drawn.bodies.reserve(run_.bodies.size());
  drawn.normals.reserve(run_.bodies.size());
  for (std::size_t i = 0; i < run_.bodies.size(); ++i)
    add_body(drawn, run_.bodies[i], body_quads_[i], frame);
  Picture picture = renderer_.draw(drawn.scene);
  if (strain_) add_legend(picture, strain_->legend());
  return picture;
}

Picture draw_run(const RunFolder& run, const ViewFrom& view) {
  RunSubject subject(run, view);
  Outline outline;
  subject.add_to(outline, run.frames - 1);
  return subject.draw(run.frames - 1, frame_points(outline.points(), view.azimuth, view.elevation,
                                                   subject.aspect()));
}

std::vector<int> frames_to_look_at(const Subject& subject) {
  constexpr int max_frames = 48;
  const int last = subject.frames() - 1, looked_at = std::min(last, max_frames - 1);
  if (looked_at == 0) return {last};
  std::vector<int> frames;
  for (int i = 0; i <= looked_at; ++i)
    frames.push_back(static_cast<int>(static_cast<long long>(last) * i / looked_at));
  return frames;
}

Outline outline_of(const Subject& subject) {
  Outline outline;
  for (const int frame : frames_to_look_at(subject)) subject.add_to(outline, frame);
  return outline;
}

void film_run(const RunFolder& run, const std::filesystem::path& path, const ViewFrom& view,
              Progress* progress) {
  RunSubject subject(run, view);
  const Camera camera =
      frame_points(outline_of(subject).points(), view.azimuth, view.elevation, subject.aspect());
  MovieWriter movie(path, view.width, view.height, run.frame_rate);
  for (int frame = 0; frame < run.frames; ++frame) {
    update(progress, "drawing", static_cast<double>(frame) / run.frames);
    movie.add(subject.draw(frame, camera));
  }
  movie.finish();
}

}  // namespace weft::app
