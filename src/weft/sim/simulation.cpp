#include "weft/sim/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "weft/core/assert.h"
#include "weft/core/error.h"
#include "weft/core/hash.h"
#include "weft/sim/detail/simulation_parts.h"
#include "weft/sim/scene_file.h"

namespace weft {
namespace {

/// The limiter pulls cloth into bodies, the collider stretches it again. The two-level method's
/// springs are so soft that the limiter carries the cloth: there both take turns, the collider
/// last.
constexpr int rounds_of_soft_springs = 4;
/// What the two-level method is limited at where the material says nothing: its springs are none of
/// the material's. [zink07]
constexpr double strain_of_soft_springs = 0.05;

/// Passes that suit a method. Stiff springs leave the limiter a few samples about pins, more of
/// them in finer images, which it has to bring up the whole cloth's weight by: many passes, that
/// cost little.
struct SuitablePasses {
  int size;
  int operator()(const TwoLevelOptions& /*options*/) const { return 10; }
  int operator()(const DesbrunOptions& /*options*/) const { return std::clamp(size / 2, 60, 128); }
  int operator()(const MultigridOptions& /*options*/) const {
    return std::clamp(size / 2, 60, 128);
  }
  /// Any other method holds its cloth by the springs themselves.
  template <class Other>
  int operator()(const Other& /*options*/) const {
    return 0;
  }
};

LimitOptions limit_for(const Scene& scene, const Cloth& cloth) {
  LimitOptions limit{
      has_limiter(scene.integrator)
          ? scene.limiter_passes.value_or(std::visit(SuitablePasses{cloth.size}, scene.integrator))
          : 0};
  const auto* soft = std::get_if<TwoLevelOptions>(&scene.integrator);
  if (soft == nullptr) return limit;
  if (cloth.material.strain_limit == 0) limit.strain = strain_of_soft_springs;
  limit.as_printed = soft->as_printed;
  return limit;
}
/// Of the limiter on each coarse level.
constexpr int coarse_passes = 2;

class StageClock {
 public:
  /// Milliseconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Mates counted once. [kg]
double mass_of(const Cloth& cloth) {
  double mass = 0;
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) mass += cloth.counted(r, c) * cloth.mass(r, c);
  return mass;
}

}  // namespace

void Simulation::Parts::bodies_arrive() {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].moves) bodies[i].positions = *driven.ends()[i];
}

void Simulation::Parts::move_driven(double seconds) {
  driven.go(seconds, team);
  if (driven.any_moves()) collider->move_bodies(driven.ends());
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    move_pins(pin_motions[i], seconds, cloths[i].cloth);
    move_tied(tied_pins[i], driven.ends(), cloths[i].cloth);
  }
  if (grab.holds()) grab.move(time_step, scene.ground, cloths[grab.cloth()]);
}

void Simulation::Parts::propose(std::size_t index) {
  SimulatedCloth& cloth = cloths[index];
  Mover& mover = movers[index];
  if (mover.wind) mover.wind->blow(time_step, cloth.state, solvers(index));
  mover.integrator->begin({time_step, vec_cast<float>(scene.gravity)}, cloth.state);
  // Others' contacts are looked for where the step leads without the cloth's own forces.
  if (!guesses()) mover.integrator->iterate({});
}

void Simulation::Parts::solve(std::size_t index) {
  const std::span<const Contact> found = collider->contacts(index);
  if (guesses() || (heeds_contacts() && !found.empty())) movers[index].integrator->iterate(found);
}

int Simulation::Parts::correct(std::size_t index, ClothState& next, FrameReport& report) {
  const SimulatedCloth& cloth = cloths[index];
  Mover& mover = movers[index];
  StageClock clock;
  const LimitOptions limiter = limit_for(scene, cloth.cloth);
  LimitOptions coarse_limiter = limiter;
  coarse_limiter.passes = std::min(coarse_passes, limiter.passes);
  int contacts = 0;
  for (int round = 0; round < (soft ? rounds_of_soft_springs : 1); ++round) {
    if (soft) mover.coarse_limit.limit(coarse_limiter, time_step, next, solvers(index));
    mover.limit.limit(limiter, time_step, next, solvers(index));
    report.limit_ms += clock.lap();
    const int touched = collider->correct(index, moving[index], mover.integrator->contact_forces(),
                                          time_step, team);
    report.collide_ms += clock.lap();
    contacts = std::max(contacts, touched);
    if (touched == 0) break;
  }
  return contacts;
}

void Simulation::Parts::gather_moving() {
  moving.clear();
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    ClothState& next = movers[i].integrator->proposal();
    moving.push_back(
        {cloths[i].state.position, next.position, next.velocity, cloths[i].cloth.inverse_mass});
  }
}

void Simulation::Parts::substep(int number, FrameReport& report) {
  const double begin = substep_time * number, end = substep_time * (number + 1);
  const int pieces = pieces_until(end);
  time_step = substep_time / pieces;
  for (int piece = 1; piece <= pieces; ++piece) {
    const double seconds = piece < pieces ? begin + time_step * piece : end;
    move_driven(seconds);
    report.contacts = std::max(report.contacts, step(seconds, report));
    report.self_contacts = std::max(report.self_contacts, collider->self_contacts());
    bodies_arrive();
  }
}

int Simulation::Parts::pieces_until(double seconds) {
  if (!driven.any_moves()) return 1;
  driven.go(seconds, team);
  double way = 0;
  for (std::size_t c = 0; c < cloths.size(); ++c) {
    const Box3d near = swept_box(cloths[c].state, substep_time, gap_of(cloths[c].cloth));
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].moves)
        way = std::max(way, farthest_way(bodies[i].positions, *driven.ends()[i], near));
  }
  return pieces_for(way, most_way);
}

/// Before the guard: what it stops would look calm.
void Simulation::Parts::check_for_runaway(double seconds) {
  for (std::size_t i = 0; i < cloths.size(); ++i)
    if (const auto bad = movers[i].runaway.find(cloths[i].cloth, movers[i].integrator->proposal(),
                                                seconds, solvers(i)))
      stop_unstable(i, *bad);
}

int Simulation::Parts::step(double seconds, FrameReport& report) {
  for (std::size_t i = 0; i < cloths.size(); ++i) propose(i);
  gather_moving();
  StageClock clock;
  if (heeds_contacts() || !std::holds_alternative<PolarMapOptions>(scene.collider))
    collider->detect(moving, time_step, team);
  report.collide_ms += clock.lap();
  for (std::size_t i = 0; i < cloths.size(); ++i) solve(i);
  gather_moving();
  int contacts = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i)
    contacts += correct(i, movers[i].integrator->proposal(), report);
  check_for_runaway(seconds);
  clock.lap();
  collider->guard(moving, time_step, team);
  report.collide_ms += clock.lap();
  for (std::size_t i = 0; i < cloths.size(); ++i) finish(i, report);
  return contacts;
}

void Simulation::Parts::finish(std::size_t index, FrameReport& report) {
  const StepReport stepped = movers[index].integrator->end(cloths[index].state);
  report.forces_ms += 1000 * stepped.forces_seconds;
  report.solve_ms += 1000 * stepped.solve_seconds;
  report.iterations += stepped.iterations;
  report.residual = std::max(report.residual, stepped.residual);
}

void Simulation::Parts::stop_unstable(std::size_t index, BadParticle particle) const {
  const std::string advice = movers[index].integrator->stability_advice(time_step);
  throw SceneError(name,
                   fmt::format("cloth '{}' ran away at frame {}, particle (row {}, col {})",
                               cloths[index].name, frame + 1, particle.row, particle.col),
                   advice.empty() ? "more substeps or a softer material are wanted" : advice);
}

Vec3d Simulation::Parts::centre() const {
  Vec3d moment;
  double total = 0;
  for (const SimulatedCloth& cloth : cloths) {
    const double mass = mass_of(cloth.cloth);
    moment += mass * weft::centre_of_mass(cloth.cloth, cloth.state);
    total += mass;
  }
  return (1 / total) * moment;
}

void Simulation::Parts::check_springs(std::size_t index, double kinetic, double springs) const {
  // The two-level method has soft springs of its own: the fabric's say nothing about it.
  if (std::holds_alternative<TwoLevelOptions>(scene.integrator)) return;
  const SimulatedCloth& cloth = cloths[index];
  const double seconds = (frame + 1) / scene.frame_rate;
  if ((kinetic + springs) / mass_of(cloth.cloth) > movers[index].runaway.most_energy(seconds))
    stop_unstable(index, fastest_particle(cloth.cloth, cloth.state));
}

void Simulation::Parts::measure(FrameReport& report) {
  double weight = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    const double kinetic = kinetic_energy(cloth.cloth, cloth.state);
    const double potential = potential_energy(cloth.cloth, cloth.state, scene.gravity);
    const Vec3d weight_force = mass_of(cloth.cloth) * scene.gravity;
    check_springs(i, kinetic,
                  potential + dot(weight_force, weft::centre_of_mass(cloth.cloth, cloth.state)));
    report.kinetic_energy += kinetic;
    report.potential_energy += potential;
    report.smallest_gap =
        std::min(report.smallest_gap, collider->smallest_gap(i, cloth.state.position, team));
    const StrainSummary strain = measure_strain(cloth.cloth, cloth.state);
    report.strain.mean += strain.mean * cloth.cloth.particles;
    report.strain.p99 = std::max(report.strain.p99, strain.p99);
    report.strain.max = std::max(report.strain.max, strain.max);
    weight += cloth.cloth.particles;
  }
  report.strain.mean /= weight;
  report.centre_of_mass = centre();
}

Simulation::Simulation(const Scene& scene, const std::string& name, const TeamOptions& team,
                       const SimulationHelp& help)
    : parts_(std::make_unique<Parts>(scene, name, team, help)) {
  check_abilities(scene, name);
  if (scene.cloths.empty()) throw SceneError(name, "no cloth", "at least one is wanted");
  parts_->load_cloths();
  parts_->load_bodies();
  parts_->tie_cloths();
  parts_->make_movers();
  parts_->make_guard();
  parts_->note_too_fast();
}

Simulation::~Simulation() = default;

FrameReport Simulation::advance() {
  FrameReport report;
  StageClock clock;
  const int substeps = parts_->scene.substeps;
  for (int substep = 0; substep < substeps; ++substep) {
    update(parts_->progress, "simulate",
           (parts_->frame + static_cast<double>(substep) / substeps) /
               std::max(parts_->frame + 1, parts_->scene.frames));
    parts_->substep(parts_->frame * substeps + substep, report);
  }
  report.milliseconds = clock.lap();
  parts_->measure(report);
  ++parts_->frame;
  return report;
}

void Simulation::save(SimulationState& state) const {
  state.frame = parts_->frame;
  state.cloths.resize(parts_->cloths.size());
  state.marks.resize(parts_->cloths.size());
  for (std::size_t i = 0; i < state.cloths.size(); ++i) {
    state.cloths[i] = parts_->cloths[i].state;
    parts_->collider->save_marks(i, state.marks[i]);
  }
}

void Simulation::restore(const SimulationState& state) {
  WEFT_ASSERT(state.cloths.size() == parts_->cloths.size());
  let_go();
  parts_->frame = state.frame;
  for (std::size_t i = 0; i < state.cloths.size(); ++i) parts_->cloths[i].state = state.cloths[i];
  if (parts_->driven.any_moves()) {
    parts_->driven.go(parts_->substep_time * (parts_->frame * parts_->scene.substeps),
                      parts_->team);
    parts_->bodies_arrive();
    // A new guard, for which this is no motion.
    parts_->make_guard();
  }
  for (std::size_t i = 0; i < state.marks.size(); ++i)
    parts_->collider->restore_marks(i, state.marks[i]);
}

void Simulation::grab(std::size_t cloth, int sample) {
  WEFT_ASSERT(cloth < parts_->cloths.size());
  let_go();
  parts_->grab.take(cloth, sample, parts_->cloths[cloth]);
}

void Simulation::pull(Vec3d target) { parts_->grab.pull(target); }

void Simulation::let_go() {
  if (holds()) parts_->grab.let_go(parts_->cloths[parts_->grab.cloth()].cloth);
}

bool Simulation::holds() const { return parts_->grab.holds(); }

int Simulation::frame() const { return parts_->frame; }
const std::vector<SimulatedCloth>& Simulation::cloths() const { return parts_->cloths; }
const std::vector<PlacedBody>& Simulation::bodies() const { return parts_->bodies; }
const std::vector<std::string>& Simulation::notes() const { return parts_->notes; }

std::string Simulation::state_hash() const {
  Hash hash;
  for (const SimulatedCloth& cloth : parts_->cloths)
    for (const Planes3* planes : {&cloth.state.position, &cloth.state.velocity})
      for (const Grid<float>* plane : {&planes->x, &planes->y, &planes->z}) hash.add(*plane);
  return hash.text();
}

int Simulation::particles() const {
  int total = 0;
  for (const SimulatedCloth& cloth : parts_->cloths) total += cloth.cloth.particles;
  return total;
}

Vec3d Simulation::centre_of_mass() const { return parts_->centre(); }

std::span<const Contact> Simulation::contacts(std::size_t cloth) const {
  return parts_->collider->contacts(cloth);
}

int Simulation::crossings() const { return parts_->collider->crossings(); }

bool Simulation::last_corrections(std::size_t cloth, Grid<float>& sizes) const {
  return parts_->movers[cloth].integrator->last_corrections(sizes);
}

}  // namespace weft
