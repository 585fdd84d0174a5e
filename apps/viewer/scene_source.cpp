#include <algorithm>

#include "apps/viewer/colouring.h"
#include "apps/viewer/sources.h"
#include "weft/scene_file.h"

namespace weft::viewer {
namespace {

Subject subject_of(const Scene& scene, const Simulation& simulation, const std::string& name,
                   std::uint64_t number) {
  Subject subject;
  subject.number = number;
  subject.name = name;
  subject.ground = scene.ground;
  subject.scene = scene;
  subject.plays = true;
  for (const SimulatedCloth& cloth : simulation.cloths())
    subject.cloths.push_back({cloth.name,
                              cloth.image.mates,
                              std::nullopt,
                              cloth.state.position,
                              true,
                              cloth.image.colours,
                              {},
                              rising_quads(cloth.image)});
  for (const PlacedBody& body : simulation.bodies())
    subject.bodies.push_back({body.name, body.image.mates, body.normals, body.positions, body.moves,
                              body.image.colours, body.placed, rising_quads(body.image)});
  return subject;
}

/// Text of the surfaces of a scene and their places, by which scenes are compared.
std::string shapes_of(Scene scene) {
  const Scene plain;
  scene.gravity = plain.gravity;
  scene.frame_rate = plain.frame_rate;
  scene.substeps = plain.substeps;
  scene.frames = plain.frames;
  scene.wind = plain.wind;
  scene.integrator = plain.integrator;
  scene.limiter_passes = plain.limiter_passes;
  scene.collider = plain.collider;
  for (SceneCloth& cloth : scene.cloths) {
    cloth.material = Material{};
    cloth.friction = 0;
    cloth.self_collision.reset();
  }
  for (SceneBody& body : scene.bodies) body.friction = 0;
  return scene_text(scene, "scene.json");
}

}  // namespace

SceneSource::SceneSource(const Scene& scene, const std::string& name, const SourceMaker& maker)
    : simulation_(scene, name, TeamOptions(maker.threads, maker.instructions),
                  {maker.progress, maker.surfaces}) {
  subject_ = std::make_shared<Subject>(subject_of(scene, simulation_, name, maker.number));
  simulation_.save(start_);
}

double SceneSource::frame_rate() const { return subject_->scene->frame_rate; }

bool SceneSource::advance() {
  report_ = simulation_.advance();
  return true;
}

void SceneSource::reset() {
  simulation_.restore(start_);
  report_ = {};
}

void SceneSource::grab(std::size_t cloth, int sample) {
  if (cloth < simulation_.cloths().size()) simulation_.grab(cloth, sample);
}

void SceneSource::continue_from(const SceneSource& other) {
  SimulationState state;
  other.simulation_.save(state);
  // Marks of one collider mean nothing to another one.
  if (subject_->scene->collider.index() != other.subject_->scene->collider.index())
    state.marks.clear();
  simulation_.restore(state);
  report_ = other.report_;
  Subject next = *subject_;
  next.frames_anew = false;
  subject_ = std::make_shared<Subject>(std::move(next));
}

void SceneSource::colour(const Colouring& colouring, std::size_t cloth, Planes3& colours) const {
  const SimulatedCloth& shown = simulation_.cloths()[cloth];
  const Planes3& positions = shown.state.position;
  const int n = positions.size();
  Grid<float> values(n, n);
  if (colouring.by == ColourBy::strain) {
    simulation_.strain_at_samples(cloth, values);
    return colour_strain(values, subject_->scene->cloths[cloth].material.strain_limit, colours);
  }
  if (colouring.by == ColourBy::contacts)
    return colour_contacts(simulation_.contacts(cloth), n, colours);
  if (colouring.by != ColourBy::residual)
    return colour_surface(colouring, shown.image.mates, positions, colours);
  simulation_.last_corrections(cloth, values);
  colour_residual(values, colours);
}

void SceneSource::show(const Colouring& colouring, Snapshot& snapshot) const {
  const std::size_t cloths = simulation_.cloths().size(), bodies = simulation_.bodies().size();
  snapshot.cloths.resize(cloths);
  snapshot.colours.resize(cloths);
  snapshot.bodies.resize(bodies);
  for (std::size_t i = 0; i < cloths; ++i) {
    snapshot.cloths[i] = simulation_.cloths()[i].state.position;
    colour(colouring, i, snapshot.colours[i]);
  }
  for (std::size_t i = 0; i < bodies; ++i)
    if (simulation_.bodies()[i].moves) snapshot.bodies[i] = simulation_.bodies()[i].positions;
  carry_normals(*subject_, snapshot);
  snapshot.frame = simulation_.frame();
  snapshot.report = report_;
  snapshot.centre_of_mass = simulation_.centre_of_mass();
  snapshot.held = simulation_.holds();
}

std::unique_ptr<Source> simulate_scene(const Scene& scene, const SourceMaker& maker,
                                       const Source* before, bool& kept) {
  const auto* running = dynamic_cast<const SceneSource*>(before);
  const std::string name = running != nullptr ? running->subject()->name : "scene";
  auto made = std::make_unique<SceneSource>(scene, name, maker);
  kept = running != nullptr && shapes_of(scene) == shapes_of(*running->subject()->scene);
  if (kept) made->continue_from(*running);
  return made;
}

}  // namespace weft::viewer
