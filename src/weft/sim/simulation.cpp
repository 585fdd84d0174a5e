#include "weft/simulation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/cloth/measure.h"
#include "weft/cloth/strain_stiffening.h"
#include "weft/core/assert.h"
#include "weft/core/hash.h"
#include "weft/core/stopwatch.h"
#include "weft/error.h"
#include "weft/scene_file.h"
#include "weft/sim/stepping/cloth_gaps.h"
#include "weft/sim/stepping/simulation_parts.h"

namespace weft {
namespace {

/// Number of samples that are faster than resting_speed.
int count_moving(const Planes3& velocity) {
  int count = 0;
  for (int s = 0; s < velocity.size() * velocity.size(); ++s)
    if (squared_length(velocity.at(s)) > Simulation::resting_speed * Simulation::resting_speed)
      ++count;
  return count;
}

/// Mass of a cloth, mates counted once. [kg]
double mass_of(const Cloth& cloth) {
  double mass = 0;
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) mass += cloth.owner(r, c) * cloth.mass(r, c);
  return mass;
}

LoadedSizes sizes_of(const LoadedScene& scene) {
  LoadedSizes sizes;
  for (const SimulatedCloth& cloth : scene.cloths) sizes.cloths.push_back(cloth.image.size());
  for (const PlacedBody& body : scene.bodies) sizes.bodies.push_back(body.image.size());
  return sizes;
}

}  // namespace

Vec3d Simulation::Parts::centre() const {
  Vec3d moment;
  double total = 0;
  for (const SimulatedCloth& cloth : cloths) {
    const double mass = mass_of(*cloth.model);
    moment += mass * weft::centre_of_mass(*cloth.model, cloth.state);
    total += mass;
  }
  return (1 / total) * moment;
}

void Simulation::Parts::measure(FrameReport& report) {
  const StabilityCheck::Now now{frame, time_step, 0, collider->crossings()};
  double weight = 0, own = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    const double kinetic = kinetic_energy(*cloth.model, cloth.state);
    double potential = potential_energy(*cloth.model, cloth.state, scene.gravity);
    for (int r = 0; stiffens() && r < cloth.model->size; ++r)
      potential += strain_limit_energy(*cloth.model, cloth.state.position, r);
    const Vec3d weight_force = mass_of(*cloth.model) * scene.gravity;
    own += kinetic + potential + dot(weight_force, weft::centre_of_mass(*cloth.model, cloth.state));
    report.kinetic_energy += kinetic;
    report.potential_energy += potential;
    report.smallest_gap =
        std::min(report.smallest_gap, collider->smallest_gap(i, cloth.state.position, team));
    const StrainSummary strain = measure_strain(*cloth.model, cloth.state);
    for (const double gap : garments.gaps(i)) report.seam_gap = std::max(report.seam_gap, gap);
    report.strain.mean += strain.mean * cloth.model->particles;
    report.strain.p99 = std::max(report.strain.p99, strain.p99);
    report.strain.max = std::max(report.strain.max, strain.max);
    weight += cloth.model->particles;
  }
  report.strain.mean /= weight;
  // The two-level method has soft springs of its own: the energy of the fabric's springs says
  // nothing about it.
  if (!soft) stability.check_energy(now, report, own, grab.holds(), energy);
  report.centre_of_mass = centre();
}

Simulation::Simulation(const Scene& scene, const std::string& name, const TeamOptions& team,
                       const SimulationHelp& help)
    : parts_(std::make_unique<Parts>(scene, name, team, help)) {
  check_abilities(scene, name);
  if (scene.cloths.empty()) throw SceneError(name, "no cloth", "at least one is wanted");
  static_cast<LoadedScene&>(*parts_) = load_scene(scene, name, help, parts_->team);
  if (help.loaded) help.loaded(sizes_of(*parts_));
  parts_->make_movers();
  // Baselines take the start as it is.
  if (Colliders::traits_of(scene.collider).filters)
    parts_->crossings.refuse_cloths_in_one_place(name);
  parts_->buried.set_up(parts_->team);
  for (std::string& note : parts_->buried.notes()) parts_->notes.push_back(std::move(note));
  parts_->make_collider_of_scene();
  if (const std::string caution = parts_->approach.caution(parts_->substep_time); !caution.empty())
    parts_->notes.push_back(caution);
}

Simulation::~Simulation() = default;

FrameReport Simulation::advance() {
  FrameReport report;
  Stopwatch clock;
  const int substeps = parts_->scene.substeps;
  // A frame depends only on what save() stores, so that a run can be resumed at any frame.
  report.work = parts_->follow_sewing();
  parts_->energy.add_work(report.work);
  for (const auto& mover : parts_->movers) mover.integrator->forget();
  parts_->collider->forget();
  parts_->follow_buried();
  for (int substep = 0; substep < substeps; ++substep) {
    update(parts_->progress, "simulate",
           (parts_->frame + static_cast<double>(substep) / substeps) /
               std::max(parts_->frame + 1, parts_->scene.frames));
    parts_->substep(parts_->frame * substeps + substep, report);
  }
  parts_->collider->end_frame();
  report.milliseconds += clock.lap_ms();
  parts_->measure(report);
  report.buried = parts_->buried.count();
  ++parts_->frame;
  return report;
}

void Simulation::watch(StepWatcher* watcher) { parts_->watcher = watcher; }

void Simulation::save(SimulationState& state) const {
  state.frame = parts_->frame;
  state.fitted = parts_->garments.fitted();
  state.levels = parts_->levels;
  state.work = parts_->energy.work();
  state.frames_unexplained = parts_->stability.frames_beyond();
  state.cloths.resize(parts_->cloths.size());
  state.marks.resize(parts_->cloths.size());
  state.contacts.resize(parts_->cloths.size());
  state.pin_targets.resize(parts_->cloths.size());
  const std::span<const StruckContact> struck = parts_->collider->struck();
  state.struck.assign(struck.begin(), struck.end());
  for (std::size_t i = 0; i < state.cloths.size(); ++i) {
    state.cloths[i] = parts_->cloths[i].state;
    parts_->collider->save_marks(i, state.marks[i]);
    const std::span<const PastContact> past = parts_->movers[i].integrator->past_contacts();
    state.contacts[i].assign(past.begin(), past.end());
    state.pin_targets[i].clear();
    for (const Pin& pin : parts_->cloths[i].model->pins) state.pin_targets[i].push_back(pin.target);
  }
}

void Simulation::restore(const SimulationState& state) {
  WEFT_ASSERT(state.cloths.size() == parts_->cloths.size());
  let_go();
  parts_->frame = state.frame;
  parts_->levels = state.levels;
  parts_->energy.restore(state.work);
  parts_->stability.restore(state.frames_unexplained);
  for (std::size_t i = 0; i < state.cloths.size(); ++i) parts_->cloths[i].state = state.cloths[i];
  for (std::size_t i = 0; i < state.pin_targets.size(); ++i) {
    std::vector<Pin>& pins = parts_->cloths[i].model->pins;
    // One that a hand had added at the end is gone.
    const std::size_t both = std::min(pins.size(), state.pin_targets[i].size());
    for (std::size_t k = 0; k < both; ++k) pins[k].target = state.pin_targets[i][k];
  }
  parts_->garments.restore_fitted(state.fitted);
  parts_->follow_sewing();
  if (parts_->driven.any_moves()) {
    parts_->resume_bodies();
    // A new collider, so that the jump of the bodies does not count as motion.
    parts_->make_collider_of_scene();
  }
  for (std::size_t i = 0; i < state.marks.size(); ++i)
    parts_->collider->restore_marks(i, state.marks[i]);
  parts_->collider->restore_struck(state.struck);
  for (std::size_t i = 0; i < state.cloths.size(); ++i)
    parts_->movers[i].integrator->restore_past(
        i < state.contacts.size() ? state.contacts[i] : std::vector<PastContact>());
}

void Simulation::grab(std::size_t cloth, int sample) {
  WEFT_ASSERT(cloth < parts_->cloths.size());
  let_go();
  parts_->energy.forget();
  parts_->grab.take(cloth, sample, parts_->cloths[cloth]);
}

void Simulation::pull(Vec3d target) { parts_->grab.pull(target); }

void Simulation::let_go() {
  if (holds()) parts_->grab.let_go(*parts_->cloths[parts_->grab.cloth()].model);
}

bool Simulation::holds() const { return parts_->grab.holds(); }

bool Simulation::is_at_rest() const {
  const bool driven = parts_->driven.any_moves() || holds() || parts_->garments.any_sewn();
  if (driven || frame() == 0) return false;
  for (const Mover& mover : parts_->movers)
    if (mover.wind) return false;
  for (const SimulatedCloth& cloth : parts_->cloths)
    for (const Pin& pin : cloth.model->pins)
      if (vec_cast<float>(pin.target) != cloth.state.position.at(pin.sample)) return false;
  return std::all_of(parts_->cloths.begin(), parts_->cloths.end(), [](const auto& cloth) {
    const int samples = cloth.model->size * cloth.model->size;
    return count_moving(cloth.state.velocity) <= restless_part * samples;
  });
}

int Simulation::frame() const { return parts_->frame; }
const std::vector<SimulatedCloth>& Simulation::cloths() const { return parts_->cloths; }
const std::vector<PlacedBody>& Simulation::bodies() const { return parts_->bodies; }
std::vector<Vec3d> Simulation::body_vertices(std::size_t body) const {
  const std::optional<SourceMesh>& source = parts_->bodies[body].source;
  if (!source) return {};
  const double seconds = parts_->frame / parts_->scene.frame_rate;
  return parts_->driven.motion(body).vertices(seconds, source->positions);
}
const std::vector<std::string>& Simulation::notes() const { return parts_->notes; }
const std::vector<StartInside>& Simulation::start_insides() const { return parts_->insides; }

std::string Simulation::state_hash() const {
  Hash hash;
  for (const SimulatedCloth& cloth : parts_->cloths)
    for (const Planes3* planes : {&cloth.state.position, &cloth.state.velocity})
      for (const Grid<float>* plane : {&planes->x, &planes->y, &planes->z}) hash.add(*plane);
  return hash.text();
}

int Simulation::particles() const {
  int total = 0;
  for (const SimulatedCloth& cloth : parts_->cloths) total += cloth.model->particles;
  return total;
}

Vec3d Simulation::centre_of_mass() const { return parts_->centre(); }

double Simulation::mass() const {
  double mass = 0;
  for (const SimulatedCloth& cloth : parts_->cloths) mass += mass_of(*cloth.model);
  return mass;
}

double Simulation::side() const {
  double area = 0;
  for (const SimulatedCloth& cloth : parts_->cloths)
    area = std::max(area, mass_of(*cloth.model) / cloth.model->material.density);
  return std::sqrt(area);
}

double Simulation::start_energy() const { return parts_->energy.at_start().total(); }

double Simulation::used_thickness(std::size_t cloth) const {
  return self_gap_of(*parts_->cloths[cloth].model);
}

std::span<const Contact> Simulation::contacts(std::size_t cloth) const {
  return parts_->collider->contacts(cloth);
}

std::vector<double> Simulation::seam_gaps(std::size_t cloth) const {
  return parts_->garments.gaps(cloth);
}

std::vector<double> Simulation::seam_stretches(std::size_t cloth) const {
  return parts_->garments.stretches(cloth);
}

double Simulation::sunk(std::size_t cloth) const {
  return parts_->worn_places[cloth].sunk(parts_->cloths[cloth].state.position, parts_->bodies);
}

IntersectionCounts Simulation::intersections() const { return parts_->crossings.count(); }

int Simulation::crossings() const { return parts_->collider->crossings(); }

void Simulation::strain_at_samples(std::size_t cloth, Grid<float>& strains) const {
  const SimulatedCloth& shown = parts_->cloths[cloth];
  weft::strain_at_samples(std::span(shown.model->springs).subspan<stretch_u, 2>(),
                          shown.state.position, strains);
}

bool Simulation::last_corrections(std::size_t cloth, Grid<float>& sizes) const {
  return parts_->movers[cloth].integrator->last_corrections(sizes);
}

}  // namespace weft
