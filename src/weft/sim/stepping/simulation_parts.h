#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/cloth/baselines/coarse_limit.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/energy_meter.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/wind.h"
#include "weft/collide/collider.h"
#include "weft/sim/insides.h"
#include "weft/sim/motion/attachments.h"
#include "weft/sim/motion/body_motion.h"
#include "weft/sim/motion/grab.h"
#include "weft/sim/motion/pins.h"
#include "weft/sim/stepping/adaptive_substeps.h"
#include "weft/sim/stepping/driven_work.h"
#include "weft/sim/stepping/runaway.h"
#include "weft/simulation.h"

namespace weft {

/// The gap that a cloth keeps to obstacles. [m]
double gap_of(const Cloth& cloth);

/// Between parts of cloth. [m]
double self_gap_of(const Cloth& cloth);

/// What moves one cloth.
struct Mover {
  std::unique_ptr<Integrator> integrator;
  std::optional<Wind> wind;
  RunawayCheck runaway;
  StrainLimit limit;
  CoarseLimit coarse_limit;
  EnergyMeter meter;
  DrivenWork driven_work;
  /// Of this step: where it started, after the wind; as it was solved, its strain limited; where it
  /// ends.
  Energy start, solved, end;
  Planes3 calm_velocity;  // before the wind blew [m/s]
  Planes3 guess;          // where this step's contacts were found first [m]
  // Of this step: what the wind did, and what the strain limit did while something pulled. [J]
  double wind_work = 0, pulled_work = 0;
};

struct Simulation::Parts {
  Parts(const Scene& given_scene, std::string given_name, const TeamOptions& given_team,
        const SimulationHelp& help)
      : scene(given_scene),
        name(std::move(given_name)),
        progress(help.progress),
        surface_cache(help.surfaces),
        team(given_team),
        lone_team({1, given_team.instructions}),
        substep_time(1 / (scene.frame_rate * scene.substeps)),
        time_step(substep_time),
        soft(Integrators::traits_of(scene.integrator).soft_springs) {}

  LoadedSurface load(const Surface& surface, ConvertOptions options, const std::string& what);
  Cloth make(const SceneCloth& wanted, const Planes3& rest, const BorderMates& mates) const;
  void load_cloths();
  void load_bodies();
  /// Ties cloths to bodies, which stand where they begin.
  void tie_cloths();
  void make_movers();
  /// On which side of closed bodies cloths begin, which stand where they begin, too.
  void find_insides();
  /// With the bodies where they are.
  void make_collider_of_scene();
  void note_too_fast();
  /// The speed that wind, bodies and moving pins may lend a cloth [m/s].
  [[nodiscard]] double drive_of(std::size_t index) const;
  /// Begins a step that ends at a time: bodies and pins go there.
  void move_driven(double seconds);
  /// Ends the step: bodies are where it took them.
  void bodies_arrive();
  /// Advances by one substep, in as many steps as fast bodies and collisions ask for.
  /// @param number  from 0
  void substep(int number, FrameReport& report);
  /// A power of 2: of a substep that ends at a time.
  [[nodiscard]] int subdivisions_until(double seconds);
  /// What became of a step that was tried.
  struct Tried {
    bool refused = false;
    StepVerdict verdict = StepVerdict::calm;
    int contacts = 0;  // particles in contact
    FilterCounts filtered;
    double work = 0;    // of pins and bodies [J]
    double pushed = 0;  // what response and filter added while bodies moved [J]
  };
  /// Tries to advance all cloths; a step that is not refused stands.
  /// @param seconds  at the end of the step
  Tried try_step(double seconds, bool may_refuse, FrameReport& report);
  /// Proposes the end of the step, with the contacts that were found.
  void solve_all(FrameReport& report);
  /// Takes back what guesses passed through. @return whether there is anything to collide with
  bool free_guesses();
  void iterate_all();
  /// All cloths as one system, where they press on each other.
  void iterate_together();
  /// Whether guesses may pass through what stands next to cloth.
  [[nodiscard]] bool guesses_go_far() const;
  /// Whether solves led where other contacts may be.
  [[nodiscard]] bool solves_go_far() const;
  /// Tells integrators what cloths may gain in the step, by what they had least. @pre wind blew
  void lend();
  /// What the step did after it was solved, by energy. @pre the filter is done
  void assess_step(bool may_refuse, Tried& tried);
  void take_excess(double excess);
  /// Whether solves missed the energy that they were to end with by so much that the step is too
  /// long for them.
  [[nodiscard]] bool solve_is_lost();
  void finish_step(const Tried& tried, FrameReport& report);
  void refuse_step();
  /// To whoever watches; that takes no time of the frame's.
  void show_step(FrameReport& report) const;
  /// Before the filter: what that stops would look calm. @return whether motion is sane
  bool check_for_runaway(double seconds, bool may_refuse);
  /// Begins a cloth's step, up to its first proposal.
  void propose(std::size_t index);
  /// Whether pins or bodies move in this step, which pull at cloth by its strain limit too.
  [[nodiscard]] bool is_pulled(std::size_t index) const;
  /// Pushes out what the solve left in obstacles, where it does not heed them all.
  /// @return particles in contact
  int respond(std::size_t index);
  /// Limits strain and pushes out. @return particles in contact
  int correct(std::size_t index, ClothState& next, FrameReport& report);
  /// Every cloth at its proposal, for the collider.
  void gather_moving();
  void finish(std::size_t index, FrameReport& report);
  [[noreturn]] void stop_unstable(std::size_t index, BadParticle particle) const;
  void measure(FrameReport& report);
  /// Stops a run whose energy nothing explains, or whose cloth is torn.
  void check_energy(const FrameReport& report, double own);
  void check_strain(std::size_t index, const StrainSummary& strain) const;
  [[noreturn]] void stop_torn(std::size_t index, const std::string& found) const;
  [[nodiscard]] std::string advice_for(std::size_t index) const;
  [[nodiscard]] Vec3d centre() const;
  /// Only implicit methods heed contacts; the others are pushed out at the end of the step.
  [[nodiscard]] bool heeds_contacts() const {
    return Integrators::traits_of(scene.integrator).heeds_contacts;
  }
  /// Who steps the cloths: all of them alike, as they may be solved together.
  [[nodiscard]] ThreadTeam& solvers() {
    for (const SimulatedCloth& cloth : cloths)
      if (cloth.model->size >= min_shared_size) return team;
    return lone_team;
  }

  Scene scene;
  std::string name;
  Progress* progress;
  SurfaceCache* surface_cache;  // none: everything is loaded anew
  ThreadTeam team, lone_team;
  double substep_time;              // [s]
  double time_step;                 // of the step: a substep or a piece of one [s]
  double max_approach_in_step = 0;  // that bodies may come closer in a step [m]
  ClothReach reach;                 // of one cloth in a substep
  SurfaceMotion body_motion;        // of one body in a substep
  bool soft;                        // springs that leave all stretch to the limiter
  std::vector<SimulatedCloth> cloths;
  std::vector<PlacedBody> bodies;
  std::vector<std::vector<Triangle>> body_triangles;  // of those that move
  DrivenBodies driven;
  std::vector<std::string> notes;
  std::vector<StartInside> insides;
  std::vector<StartSides> start_sides;              // of each cloth
  std::vector<std::vector<PinMotion>> pin_motions;  // of each cloth
  std::vector<std::vector<TiedPin>> tied_pins;      // of each cloth
  std::vector<Mover> movers;                        // one a cloth
  std::unique_ptr<JointIntegrator> joint;           // of all; null: each is solved by itself
  std::vector<std::span<const Contact>> own_contacts;
  std::unique_ptr<Collider> collider;
  std::vector<MovingCloth> moving;  // of this step
  Grab grab;
  int frame = 0;
  StepWatcher* watcher = nullptr;
  int frames_beyond = 0;  // in a row, with more energy than is explained
  StepLevels levels;
  WorkDone work;
  double max_energy = HUGE_VAL;  // that cloths may have at the end of the step without work [J]
  Energy start_energy;           // before the first frame
  /// Strain, in steps that collisions shortened: what the limiter moves does not shrink with the
  /// step, and leads cloth through itself again.
  bool unlimited = false;
  bool watched = false;       // the step's energy: there is something to collide with
  bool known_energy = false;  // movers' start energies are those of the states
};

}  // namespace weft
