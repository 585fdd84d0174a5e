#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/collide/collider.h"
#include "weft/sim/loading/load_scene.h"
#include "weft/sim/motion/driven_pins.h"
#include "weft/sim/sewing/garments.h"
#include "weft/sim/stepping/adaptive_substeps.h"
#include "weft/sim/stepping/approach_limit.h"
#include "weft/sim/stepping/buried_bodies.h"
#include "weft/sim/stepping/energy_budget.h"
#include "weft/sim/stepping/mover.h"
#include "weft/sim/stepping/scene_crossings.h"
#include "weft/sim/stepping/stability_check.h"
#include "weft/simulation.h"

namespace weft {

/// A loaded scene and what steps it.
struct Simulation::Parts : LoadedScene {
  Parts(const Scene& given_scene, std::string given_name, const TeamOptions& given_team,
        const SimulationHelp& help)
      : scene(given_scene),
        name(std::move(given_name)),
        progress(help.progress),
        team(given_team),
        lone_team({1, given_team.instructions}),
        substep_time(1 / (scene.frame_rate * scene.substeps)),
        time_step(substep_time),
        soft(Integrators::traits_of(scene.integrator).soft_springs) {}

  /// Makes what moves a cloth, by the fabric that it has now.
  [[nodiscard]] Mover make_mover(std::size_t index);
  void make_movers();
  /// Solves all cloths as one system, where the method can.
  void join_movers();
  /// Creates the collider, with the bodies at their current positions.
  void make_collider_of_scene();
  /// The speed that wind, bodies and moving pins may lend a cloth [m/s].
  [[nodiscard]] double drive_of(std::size_t index) const;
  /// Sets the end positions of bodies for a step, or a substep, that ends at `seconds`.
  void move_bodies(double seconds);
  /// Begins a step that ends at `seconds`: sets the end positions of bodies, pins and the grab.
  void move_driven(double seconds);
  /// Pulls the seams of a garment together that is not sewn yet.
  void sew(std::size_t index);
  /// Whether air moves or slows cloth.
  [[nodiscard]] bool has_air() const { return scene.wind || scene.air_damping > 0; }
  void meet_air(std::size_t index);
  double work_of_sewing();
  /// Makes the collider anew where other samples than before are joined, or friction begins, and
  /// movers where edges are gathered or garments get the bending of their fabric.
  /// @return work of gathering [J]
  double follow_sewing();
  /// Makes movers anew, for cloths with other springs or bending.
  void renew_movers();
  /// Puts bodies where they are at the begin of the frame from which a run is resumed.
  void resume_bodies();
  /// Finds what of the bodies lies in themselves in the frame that begins.
  void follow_buried();
  /// Ends the step: bodies take their end positions.
  void bodies_arrive();
  /// The time at which the frame begins. [s]
  [[nodiscard]] double frame_start() const { return substep_time * (frame * scene.substeps); }
  [[nodiscard]] double frame_end() const { return substep_time * ((frame + 1) * scene.substeps); }
  /// The step that bodies have been moved for.
  [[nodiscard]] ApproachLimit::Step approached() const { return {*collider, time_step, frame}; }
  /// Number of steps, a power of 2, that moving bodies and pins require of a substep.
  /// @param begin, end  [s]
  [[nodiscard]] int subdivisions_of(double begin, double end);
  /// The level that they require of the rest of a substep; -1 where the step is short enough.
  /// @param subdivisions  of the substep by the length of this step
  [[nodiscard]] int required_level(int subdivisions);
  /// Number of equal parts of the step that pins ask for.
  [[nodiscard]] double wanted_by_pins() const;
  /// Advances by one substep, in as many steps as fast bodies and collisions require.
  /// @param number  from 0
  void substep(int number, FrameReport& report);
  /// Outcome of a trial step.
  struct Tried {
    bool refused = false;
    bool repeat = false;  // a refused step is solved again, with what the filter held back
    StepVerdict verdict = StepVerdict::calm;
    int contacts = 0;  // particles in contact
    FilterCounts filtered;
    EnergyBudget::StepWork forces_work;  // of pins and bodies, if the step is watched
    double work = 0;                     // done by pins and bodies [J]
    double pushed = 0;     // energy that response and filter added beside it while bodies moved [J]
    double lost_time = 0;  // by which a shortened step lags behind [s]
  };
  /// What may become of a trial step that is bad; halving comes first, but while seams are sewn.
  struct StepChoices {
    bool halve = false;         // it may be halved
    bool halve_wild = false;    // it may be halved if it ran away or is wild
    bool halve_fallen = false;  // it may be halved if points fell back while bodies moved
    bool repeat = false;        // it may be solved again
    // Whether it is halved if points fall back.
    [[nodiscard]] bool refuses_fallen() const { return halve || halve_fallen; }
  };
  /// Computes a trial step of all cloths, to be finished or refused by the caller.
  /// @param seconds  at the end of the step
  Tried try_step(double seconds, StepChoices choices, FrameReport& report);
  /// Puts samples of seams together that have met, which is the seams' work, not the filter's.
  void close_seams();
  /// Computes the proposals of all cloths, with contact detection at the guesses and, where solves
  /// go far, again.
  void solve_all(FrameReport& report);
  /// The work of pins and bodies on all cloths, by the forces at their proposals. [J]
  double measure_driven_work();
  /// Tells every particle the way of the pin or obstacle nearest to it, see NearestWays.
  void spread_ways();
  /// Hands ways over once through all contacts of layers and between cloths.
  void hand_ways_over();
  /// Whether layers of a cloth touch each other or another cloth.
  [[nodiscard]] bool is_layered(std::size_t index) const;
  /// Detects contacts at the guesses, and filters the guesses. @return whether anything is near
  /// that the filter must act on
  bool free_guesses();
  /// The contacts that a cloth is solved with.
  std::span<const Contact> contacts_of(std::size_t index);
  void iterate_all();
  /// Solves all cloths as one system, where they press on each other.
  void iterate_together();
  /// Whether guesses go far enough to pass through something next to cloth.
  [[nodiscard]] bool guesses_go_far() const;
  /// Whether solves moved cloth far enough from its guess to meet other contacts.
  [[nodiscard]] bool solves_go_far() const;
  /// Accepts or refuses the step by the energy that response and filter added, and removes any
  /// excess energy of an accepted step. @pre the filter is done
  void assess_step(StepChoices choices, Tried& tried);
  /// What moves cloth in this step. @pre driven things and proposals are at its end
  [[nodiscard]] EnergyBudget::Drive drive_now() const;
  void finish_step(const Tried& tried, FrameReport& report);
  void refuse_step();
  /// Whether a bad step may be solved again with contacts for what the filter held back.
  [[nodiscard]] bool may_solve_again() const {
    return movers.front().integrator->solves_contacts();
  }
  /// Shows the step to the watcher, whose time does not count as the frame's.
  void show_step(FrameReport& report) const;
  /// Begins a cloth's step, up to its first proposal.
  void propose(std::size_t index);
  /// Whether pins or bodies move in this step and the strain limit transmits part of their pull.
  [[nodiscard]] bool is_pulled(std::size_t index) const;
  /// Pushes out points that the solve left inside obstacles; not needed where it solves for
  /// contacts and left none deep.
  /// @return particles in contact
  int respond(std::size_t index);
  /// Limits strain and pushes points out of obstacles. @return particles in contact
  int correct(std::size_t index, ClothState& next, FrameReport& report);
  /// Gathers the start and proposal of every cloth for the collider.
  void gather_moving();
  void finish(std::size_t index, FrameReport& report);
  void measure(FrameReport& report);
  [[nodiscard]] Vec3d centre() const;
  /// Whether the integrator takes contacts into account; if not, cloth is only pushed out at the
  /// end of the step.
  [[nodiscard]] bool solves_contacts() const {
    return Integrators::traits_of(scene.integrator).solves_contacts;
  }
  /// Whether springs stiffen beyond the strain limit, which then holds energy.
  [[nodiscard]] bool stiffens() const {
    return std::holds_alternative<NewtonOptions>(scene.integrator);
  }
  /// The thread team of the solvers, the same for all cloths, as they may be solved together.
  [[nodiscard]] ThreadTeam& solvers() {
    for (const SimulatedCloth& cloth : cloths)
      if (cloth.model->size >= min_shared_size) return team;
    return lone_team;
  }

  Scene scene;
  std::string name;
  Progress* progress;
  ThreadTeam team, lone_team;
  double substep_time;                      // [s]
  double time_step;                         // of the step: a substep or a piece of one [s]
  double step_start = 0;                    // time at which the step begins [s]
  bool soft;                                // springs that leave all stretch to the limiter
  std::optional<double> moved_to;           // where the collider knows bodies to go [s]
  std::vector<DrivenPins> driven_pins;      // of each cloth
  std::vector<const Planes3*> body_starts;  // where the step begins; null: it does not move
  std::vector<Mover> movers;                // one a cloth
  std::unique_ptr<JointIntegrator> joint;   // of all; null: each is solved by itself
  std::vector<std::span<const Contact>> own_contacts;
  std::unique_ptr<Collider> collider;
  std::vector<MovingCloth> moving;  // of this step
  Grab grab;
  int frame = 0;
  StepWatcher* watcher = nullptr;
  StepLevels levels;
  /// Whether strain is left unlimited, as in steps that collisions shortened: displacements of the
  /// limiter do not shrink with the step, and would move cloth through itself again.
  bool unlimited = false;
  bool watched = false;  // the step's energy is checked: something is near cloth
  Garments garments{cloths, sewing, other_bending, gathers};
  ApproachLimit approach{scene, name, *this};
  SceneCrossings crossings{scene, *this};
  BuriedBodies buried{*this};
  EnergyBudget energy{cloths, movers};
  StabilityCheck stability{name, cloths, movers};
};

}  // namespace weft
