#include "weft/sim/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "weft/cloth/coarse_limit.h"
#include "weft/core/assert.h"
#include "weft/core/error.h"
#include "weft/core/hash.h"
#include "weft/image/rebuild.h"
#include "weft/sim/attachments.h"
#include "weft/sim/driven_bodies.h"
#include "weft/sim/pins.h"
#include "weft/sim/placement.h"
#include "weft/sim/runaway.h"
#include "weft/sim/scene_file.h"
#include "weft/sim/step_pieces.h"

namespace weft {
namespace {

constexpr int body_normal_map_size = 257;
/// Smaller cloths are stepped by one thread: what others would save they would spend waiting.
constexpr int least_shared_size = 97;
/// Only samples are pushed out of bodies, so a sharp edge between two of them would show: the gap
/// that is kept grows from the fabric's thickness to this part of the cloth's rest spacing, but to
/// no more than a few thicknesses, lest coarse cloths float.
constexpr double gap_in_spacings = 1.0 / 3, most_gap_in_thicknesses = 3;

double gap_of(const Cloth& cloth) {
  const double thickness = cloth.material.thickness;
  return std::clamp(gap_in_spacings * cloth.rest_spacing, thickness,
                    most_gap_in_thicknesses * thickness);
}

/// Between parts of cloth a gap of more than this part of the rest spacing would lock folds.
constexpr double most_self_gap_in_spacings = 0.25;

double self_gap_of(const Cloth& cloth) {
  return std::min(cloth.material.thickness, most_self_gap_in_spacings * cloth.rest_spacing);
}

/// Of the ground, which scenes do not name a coefficient for.
constexpr double ground_friction = 0.5;

/// The limiter pulls cloth into bodies, the collider stretches it again. The two-level method's
/// springs are so soft that the limiter carries the cloth: there both take turns, the collider
/// last.
constexpr int rounds_of_soft_springs = 4;
/// Stiff springs leave the limiter a few samples about pins, more of them in finer images, which it
/// has to bring up the whole cloth's weight by: many passes, that cost little.
LimitOptions suitable_limit(bool soft, int size) {
  return {soft ? 10 : std::clamp(size / 2, 60, 128)};
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

/// What moves one cloth.
struct Mover {
  std::unique_ptr<Integrator> integrator;
  std::optional<Wind> wind;
  RunawayCheck runaway;
  StrainLimit limit;
  CoarseLimit coarse_limit;
};

}  // namespace

struct Simulation::Parts {
  Parts(const Scene& given_scene, std::string given_name, const TeamOptions& given_team,
        Progress* given_progress)
      : scene(given_scene),
        name(std::move(given_name)),
        progress(given_progress),
        team(given_team),
        lone_team({1, given_team.instructions}),
        substep_time(1 / (scene.frame_rate * scene.substeps)),
        time_step(substep_time),
        soft(std::holds_alternative<TwoLevelOptions>(scene.integrator)) {}

  LoadedSurface load(const std::string& surface, ConvertOptions options, const std::string& what);
  void load_cloths();
  void load_bodies();
  /// Ties cloths to bodies, which stand where they begin.
  void tie_cloths();
  void make_movers();
  /// With the bodies where they are.
  void make_guard();
  void note_too_fast();
  /// The speed that wind, bodies and moving pins may lend a cloth [m/s].
  [[nodiscard]] double drive_of(std::size_t index) const;
  /// Begins a step that ends at a time: bodies and pins go there.
  void move_driven(double seconds);
  /// Ends the step: bodies are where it took them.
  void bodies_arrive();
  /// Advances by one substep, in as many pieces as fast bodies ask for. @param number  from 0
  void substep(int number, FrameReport& report);
  /// A power of 2: of a substep that ends at a time.
  [[nodiscard]] int pieces_until(double seconds);
  /// Advances all cloths. @param seconds  at the end of the step @return particles in contact
  int step(double seconds, FrameReport& report);
  void check_for_runaway(double seconds);
  /// Begins a cloth's step, up to its first proposal.
  void propose(std::size_t index);
  /// Solves a cloth's step with the contacts that were found.
  void solve(std::size_t index);
  /// Limits strain and pushes out. @return particles in contact
  int correct(std::size_t index, ClothState& next, FrameReport& report);
  /// Every cloth at its proposal, for the collider.
  void gather_moving();
  void finish(std::size_t index, FrameReport& report);
  [[noreturn]] void stop_unstable(std::size_t index, BadParticle particle) const;
  void measure(FrameReport& report);
  /// Springs that hold far more energy than the cloth can have gained ran away, though a limiter
  /// may tame the motion.
  void check_springs(std::size_t index, double kinetic, double springs) const;
  [[nodiscard]] Vec3d centre() const;
  /// Only implicit methods heed contacts; the others are pushed out at the end of the step.
  [[nodiscard]] bool heeds_contacts() const {
    return std::holds_alternative<MultigridOptions>(scene.integrator) ||
           std::holds_alternative<ImplicitOptions>(scene.integrator);
  }
  /// Who steps a cloth.
  [[nodiscard]] ThreadTeam& solvers(std::size_t index) {
    return cloths[index].cloth.size < least_shared_size ? lone_team : team;
  }

  Scene scene;
  std::string name;
  Progress* progress;
  ThreadTeam team, lone_team;
  double substep_time;  // [s]
  double time_step;     // of the step: a substep or a piece of one [s]
  double most_way = 0;  // of bodies in a step [m]
  bool soft;            // springs that leave all stretch to the limiter
  std::vector<SimulatedCloth> cloths;
  std::vector<PlacedBody> bodies;
  DrivenBodies driven;
  std::vector<std::string> notes;
  std::vector<std::vector<PinMotion>> pin_motions;  // of each cloth
  std::vector<std::vector<TiedPin>> tied_pins;      // of each cloth
  std::vector<Mover> movers;                        // one a cloth
  std::unique_ptr<Collider> collider;
  std::vector<MovingCloth> moving;  // of this step
  int frame = 0;
};

LoadedSurface Simulation::Parts::load(const std::string& surface, ConvertOptions options,
                                      const std::string& what) {
  update(options.progress, "load " + what, 0);
  options.threads = team.size();
  const auto read = [&] {
    try {
      return load_surface(surface, options);
    } catch (const UsageError& error) {
      // What a command line gets wrong by itself, a scene names in its file.
      throw SceneError(name, fmt::format("'{}': {}", what, error.what()), "");
    }
  };
  LoadedSurface loaded = read();
  for (const std::string& note : loaded.notes) notes.push_back(fmt::format("{}: {}", what, note));
  return loaded;
}

void Simulation::Parts::load_cloths() {
  for (const SceneCloth& wanted : scene.cloths) {
    ConvertOptions options;
    options.size = wanted.size;
    options.progress = progress;
    LoadedSurface loaded = load(wanted.surface, options, wanted.name);
    const Planes3 rest = placed_positions(loaded.image, placement_map(wanted.placement));
    Cloth cloth = make_cloth(rest, loaded.image.mates, wanted.material);
    pin_motions.push_back(pin_places(cloth, wanted.pins));
    ClothState state = rest_state(cloth, vec_cast<float>(wanted.velocity));
    cloths.push_back({wanted.name, std::move(loaded.image), std::move(cloth), std::move(state)});
  }
}

void Simulation::Parts::load_bodies() {
  for (const SceneBody& wanted : scene.bodies) {
    ConvertOptions options;
    options.size = wanted.size;
    options.normal_map_size = body_normal_map_size;
    options.keep_places = !wanted.animation.empty();
    options.progress = progress;
    LoadedSurface loaded = load(wanted.surface, options, wanted.name);
    BodyMotion motion(wanted, loaded, scene.frame_rate);
    const PlacementMap map = placement_map(wanted.placement);
    PlacedBody body;
    body.name = wanted.name;
    body.moves = motion.moves();
    if (loaded.normals && !body.moves) body.normals = placed_normals(*loaded.normals, map);
    body.image_normals = std::move(loaded.normals);
    body.positions = placed_positions(loaded.image, map);
    body.image = std::move(loaded.image);
    driven.add(std::move(motion));
    bodies.push_back(std::move(body));
  }
  driven.go(0, team);
  bodies_arrive();
}

void Simulation::Parts::bodies_arrive() {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].moves) bodies[i].positions = *driven.ends()[i];
}

void Simulation::Parts::tie_cloths() {
  std::vector<TiedSurface> surfaces;
  for (const PlacedBody& body : bodies)
    surfaces.push_back({body.name, &body.positions, grid_triangles(body.image)});
  for (std::size_t i = 0; i < cloths.size(); ++i)
    tied_pins.push_back(
        tie_places(cloths[i].cloth, scene.cloths[i].attach, surfaces, pin_motions[i]));
}

void Simulation::Parts::move_driven(double seconds) {
  driven.go(seconds, team);
  if (driven.any_moves()) collider->move_bodies(driven.ends());
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    move_pins(pin_motions[i], seconds, cloths[i].cloth);
    move_tied(tied_pins[i], driven.ends(), cloths[i].cloth);
  }
}

void Simulation::Parts::make_guard() {
  Obstacles obstacles;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    obstacles.bodies.push_back({bodies[i].positions, bodies[i].image.mates,
                                scene.bodies[i].friction, choose_diagonals(bodies[i].image)});
  obstacles.ground = scene.ground;
  obstacles.ground_friction = ground_friction;
  std::vector<GuardedCloth> guarded;
  most_way = HUGE_VAL;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    most_way = std::min(most_way, most_way_in_gaps * gap_of(cloth.cloth));
    guarded.push_back(
        {cloth.cloth.mates, cloth.cloth.size, choose_diagonals(cloth.image), gap_of(cloth.cloth),
         scene.cloths[i].friction, cloth.cloth.rest_spacing,
         knows_self_collision(scene.collider) && scene.cloths[i].self_collision.value_or(true),
         self_gap_of(cloth.cloth)});
  }
  collider = make_collider(scene.collider, obstacles, guarded);
}

void Simulation::Parts::note_too_fast() {
  if (driven.fastest() * substep_time <= most_pieces * most_way) return;
  notes.push_back(fmt::format(
      "bodies go up to {:.3g} m/s, faster than cloth can be kept from them; {} substeps "
      "or more are wanted",
      driven.fastest(), std::ceil(driven.fastest() / (scene.frame_rate * most_pieces * most_way))));
}

void Simulation::Parts::make_movers() {
  const StepInput typical{time_step, vec_cast<float>(scene.gravity)};
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    movers.push_back(
        {make_integrator(scene.integrator, cloth.cloth, typical, solvers(i)),
         scene.wind ? std::optional<Wind>(std::in_place, *scene.wind, cloth.cloth) : std::nullopt,
         RunawayCheck(cloth.cloth, cloth.state, scene.gravity, drive_of(i)),
         StrainLimit(cloth.cloth, solvers(i)), CoarseLimit(cloth.cloth, solvers(i))});
    if (const std::string caution = movers.back().integrator->caution(); !caution.empty())
      notes.push_back(fmt::format("{}: {}", cloth.name, caution));
  }
  moving.reserve(cloths.size());
}

double Simulation::Parts::drive_of(std::size_t index) const {
  return (scene.wind ? length(scene.wind->velocity) : 0) +
         std::max(fastest_pin(pin_motions[index]), driven.fastest());
}

void Simulation::Parts::propose(std::size_t index) {
  SimulatedCloth& cloth = cloths[index];
  Mover& mover = movers[index];
  if (mover.wind) mover.wind->blow(time_step, cloth.state, solvers(index));
  mover.integrator->begin({time_step, vec_cast<float>(scene.gravity)}, cloth.state);
  // Multigrid's contacts are looked for where the step leads without the cloth's own forces.
  if (!std::holds_alternative<MultigridOptions>(scene.integrator)) mover.integrator->iterate({});
}

void Simulation::Parts::solve(std::size_t index) {
  const std::span<const Contact> found = collider->contacts(index);
  if (std::holds_alternative<MultigridOptions>(scene.integrator) ||
      (heeds_contacts() && !found.empty()))
    movers[index].integrator->iterate(found);
}

int Simulation::Parts::correct(std::size_t index, ClothState& next, FrameReport& report) {
  const SimulatedCloth& cloth = cloths[index];
  Mover& mover = movers[index];
  StageClock clock;
  LimitOptions limiter = suitable_limit(soft, cloth.cloth.size);
  limiter.passes = scene.limiter_passes.value_or(limiter.passes);
  int contacts = 0;
  for (int round = 0; round < (soft ? rounds_of_soft_springs : 1); ++round) {
    if (soft)
      mover.coarse_limit.limit(std::min(coarse_passes, limiter.passes), time_step, next,
                               solvers(index));
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
                       Progress* progress)
    : parts_(std::make_unique<Parts>(scene, name, team, progress)) {
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

}  // namespace weft
