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
#include "weft/collide/intersections.h"
#include "weft/sim/loading/load_scene.h"
#include "weft/sim/stepping/adaptive_substeps.h"
#include "weft/sim/stepping/driven_work.h"
#include "weft/sim/stepping/runaway.h"
#include "weft/simulation.h"

namespace weft {

/// The gap that a cloth keeps to obstacles. [m]
double gap_of(const Cloth& cloth);

/// The gap that a cloth keeps to itself and to other cloths. [m]
double self_gap_of(const Cloth& cloth);

/// The integrator, limiters and meters of one cloth, with their results of the current step.
struct Mover {
  std::unique_ptr<Integrator> integrator;
  std::optional<Wind> wind;
  RunawayCheck runaway;
  StrainLimit limit;
  std::optional<CoarseLimit> coarse_limit;  ///< of soft springs
  EnergyMeter meter;
  DrivenWork driven_work;
  /// Energies of this step: at its start, after the wind; after solve and strain limit; at its end.
  Energy start, solved, end;
  Planes3 calm_velocity;     // velocities before the wind and the seams [m/s]
  Planes3 guess;             // filtered positions before the solve [m]
  double unsewn_energy = 0;  // before a step in which seams are pulled together [J]
  // Of this step: work of the wind, energy added by the strain limit while something pulled. [J]
  double wind_work = 0, pulled_work = 0;
  bool limited = false;  // a strain limiter works on the proposals of this step
};

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
  /// Refuses cloths that begin in the same place.
  void check_apart();
  /// Creates the collider, with the bodies at their current positions.
  void make_collider_of_scene();
  void note_too_fast();
  /// The speed that wind, bodies and moving pins may lend a cloth [m/s].
  [[nodiscard]] double drive_of(std::size_t index) const;
  /// Sets the end positions of bodies for a step, or a substep, that ends at `seconds`.
  void move_bodies(double seconds);
  /// Begins a step that ends at `seconds`: sets the end positions of bodies, pins and the grab.
  void move_driven(double seconds);
  /// Pulls the seams of a garment together that is not sewn yet.
  void sew(std::size_t index);
  [[nodiscard]] bool is_sewing() const;
  double work_of_sewing();
  /// Puts samples of seams in one place that the proposals bring next to each other.
  void bring_seams_together();
  /// Whether a cloth has no friction and is stiff: seams that close slide over what is between
  /// them, and panels do not crumple, until gravity acts on what stays open.
  [[nodiscard]] bool slides(std::size_t index) const;
  /// Makes the collider anew where other samples than before are joined, or friction begins, and
  /// gives garments the bending of their fabric then.
  void follow_sewing();
  /// Makes movers anew, for fabrics that resist bending in another way.
  void renew_movers();
  /// Ends the step: bodies take their end positions.
  void bodies_arrive();
  /// Advances by one substep, in as many steps as fast bodies and collisions require.
  /// @param number  from 0
  void substep(int number, FrameReport& report);
  /// Number of steps, a power of 2, that moving bodies require of a substep ending at `seconds`.
  [[nodiscard]] int subdivisions_until(double seconds);
  /// The level that moving bodies require of the rest of a substep where they are faster in this
  /// step than over the whole of it, as at a key of their path; -1 where the step is short enough.
  /// @param subdivisions  of the substep by the length of this step
  [[nodiscard]] int required_level(int subdivisions);
  /// Number of parts that moving bodies require of this step, for which they have been moved.
  double wanted_parts();
  /// Refuses bodies too fast for so many subdivisions of a substep. @throws SceneError
  void check_speed(double subdivisions) const;
  /// Outcome of a trial step.
  struct Tried {
    bool refused = false;
    bool repeat = false;  // a refused step is solved again, with what the filter held back
    StepVerdict verdict = StepVerdict::calm;
    int contacts = 0;  // particles in contact
    FilterCounts filtered;
    double work = 0;    // done by pins and bodies [J]
    double pushed = 0;  // energy added by response and filter while bodies moved [J]
  };
  /// What may become of a trial step that is bad; halving comes first.
  struct StepChoices {
    bool halve = false;         // it may be halved
    bool halve_fallen = false;  // it may be halved if points fell back while bodies moved
    bool repeat = false;        // it may be solved again
  };
  /// Computes a trial step of all cloths, to be finished or refused by the caller.
  /// @param seconds  at the end of the step
  Tried try_step(double seconds, StepChoices choices, FrameReport& report);
  /// Computes the proposals of all cloths, with contact detection at the guesses and, where solves
  /// go far, again.
  void solve_all(FrameReport& report);
  /// Tells the measures of work what acts on each cloth.
  void expect_driven_work();
  /// Detects contacts at the guesses, and filters the guesses. @return whether anything is near
  /// that the filter must act on
  bool free_guesses();
  void iterate_all();
  /// Solves all cloths as one system, where they press on each other.
  void iterate_together();
  /// Whether guesses go far enough to pass through something next to cloth.
  [[nodiscard]] bool guesses_go_far() const;
  /// Whether solves moved cloth far enough from its guess to meet other contacts.
  [[nodiscard]] bool solves_go_far() const;
  /// Computes max_energy from the smallest energy so far, and tells integrators what they may add
  /// in the step. @pre the wind has been applied
  void lend();
  /// Accepts or refuses the step by the energy that response and filter added, and removes any
  /// excess energy of an accepted step. @pre the filter is done
  void assess_step(StepChoices choices, Tried& tried);
  void take_excess(double excess);
  /// The part of an excess that take_excess can remove [J].
  [[nodiscard]] double removable(double excess) const;
  /// Whether the linearisation errors of the solves exceed the energy limit: the step is too long.
  [[nodiscard]] bool solve_is_lost();
  void finish_step(const Tried& tried, FrameReport& report);
  void refuse_step();
  /// Whether a bad step may be solved again with contacts for what the filter held back.
  [[nodiscard]] bool may_solve_again() const {
    return movers.front().integrator->solves_contacts();
  }
  /// Shows the step to the watcher, whose time does not count as the frame's.
  void show_step(FrameReport& report) const;
  /// Checks proposals before the filter, which would hide runaway motion. @return whether motion is
  /// sane
  bool check_for_runaway(double seconds, bool may_refuse);
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
  /// Makes what counts intersections, at its first use.
  void make_check();
  [[noreturn]] void stop_unstable(std::size_t index, BadParticle particle) const;
  void measure(FrameReport& report);
  /// Stop a run whose energy rose without explanation, or whose springs are strained too far.
  void check_energy(const FrameReport& report, double own);
  void check_strain(std::size_t index, const StrainSummary& strain) const;
  [[noreturn]] void stop_torn(std::size_t index, const std::string& found) const;
  [[nodiscard]] std::string advice_for(std::size_t index) const;
  [[nodiscard]] Vec3d centre() const;
  /// Whether the integrator takes contacts into account; if not, cloth is only pushed out at the
  /// end of the step.
  [[nodiscard]] bool heeds_contacts() const {
    return Integrators::traits_of(scene.integrator).heeds_contacts;
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
  double substep_time;                     // [s]
  double time_step;                        // of the step: a substep or a piece of one [s]
  double step_start = 0;                   // time at which the step begins [s]
  double max_approach_in_step = 0;         // of a body towards cloth [m]
  ClothReach reach;                        // of one cloth in a substep
  bool soft;                               // springs that leave all stretch to the limiter
  std::optional<double> moved_to;          // where the collider knows bodies to go [s]
  std::vector<Mover> movers;               // one a cloth
  std::unique_ptr<JointIntegrator> joint;  // of all; null: each is solved by itself
  std::vector<std::span<const Contact>> own_contacts;
  std::unique_ptr<Collider> collider;
  std::vector<char> sliding;        // of each cloth: whether the collider's friction is none
  std::vector<MovingCloth> moving;  // of this step
  std::vector<std::vector<Triangle>> checked_triangles;  // of cloths, then bodies
  std::optional<IntersectionCheck> check;                // of what they and the ground cross
  Grab grab;
  int frame = 0;
  StepWatcher* watcher = nullptr;
  int frames_beyond = 0;  // consecutive frames with unexplained energy
  StepLevels levels;
  WorkDone work;
  double max_energy = HUGE_VAL;  // of cloths at the end of the step, before its work [J]
  double lent = 0;               // part of it that contacts and the filter may lend [J]
  Energy start_energy;           // before the first frame
  /// Whether strain is left unlimited, as in steps that collisions shortened: displacements of the
  /// limiter do not shrink with the step, and would move cloth through itself again.
  bool unlimited = false;
  bool watched = false;       // the step's energy is checked: something is near cloth
  bool known_energy = false;  // start energies of movers are up to date
};

}  // namespace weft
