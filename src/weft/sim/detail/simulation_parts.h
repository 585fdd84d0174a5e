#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/cloth/coarse_limit.h"
#include "weft/cloth/strain_limit.h"
#include "weft/sim/attachments.h"
#include "weft/sim/driven_bodies.h"
#include "weft/sim/grab.h"
#include "weft/sim/pins.h"
#include "weft/sim/runaway.h"
#include "weft/sim/simulation.h"
#include "weft/sim/step_pieces.h"

namespace weft {

/// Smaller cloths are stepped by one thread: what others would save they would spend waiting.
inline constexpr int least_shared_size = 97;
/// The gap that a cloth keeps to obstacles. [m]
double gap_of(const Cloth& cloth);

/// What moves one cloth.
struct Mover {
  std::unique_ptr<Integrator> integrator;
  std::optional<Wind> wind;
  RunawayCheck runaway;
  StrainLimit limit;
  CoarseLimit coarse_limit;
};

struct Simulation::Parts {
  Parts(const Scene& given_scene, std::string given_name, const TeamOptions& given_team,
        const SimulationHelp& help)
      : scene(given_scene),
        name(std::move(given_name)),
        progress(help.progress),
        shelf(help.surfaces),
        team(given_team),
        lone_team({1, given_team.instructions}),
        substep_time(1 / (scene.frame_rate * scene.substeps)),
        time_step(substep_time),
        soft(std::holds_alternative<TwoLevelOptions>(scene.integrator)) {}

  LoadedSurface load(const std::string& surface, ConvertOptions options, const std::string& what);
  Cloth make(const SceneCloth& wanted, const Planes3& rest, const BorderMates& mates) const;
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
    return guesses() || std::holds_alternative<ImplicitOptions>(scene.integrator);
  }
  /// Whether the integrator's proposal is a guess before it has solved, at which contacts are
  /// found.
  [[nodiscard]] bool guesses() const {
    return std::holds_alternative<NewtonOptions>(scene.integrator) ||
           std::holds_alternative<MultigridOptions>(scene.integrator);
  }
  /// Who steps a cloth.
  [[nodiscard]] ThreadTeam& solvers(std::size_t index) {
    return cloths[index].cloth.size < least_shared_size ? lone_team : team;
  }

  Scene scene;
  std::string name;
  Progress* progress;
  SurfaceShelf* shelf;  // none: everything is loaded anew
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
  Grab grab;
  int frame = 0;
};

}  // namespace weft
