#pragma once

#include <cmath>
#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "weft/cloth_state.h"
#include "weft/colliders.h"
#include "weft/contact.h"
#include "weft/convert.h"
#include "weft/progress.h"
#include "weft/scene.h"
#include "weft/threads.h"

namespace weft {

/// Cache of loaded surfaces, for callers that make simulations of a scene repeatedly: a conversion
/// may take seconds. Changes of the files after loading are not noticed.
class SurfaceCache {
 public:
  /// As load_surface; a surface in memory is not cached. @throws as load_surface
  LoadedSurface load(const Surface& surface, const ConvertOptions& options);
  void clear() { kept_.clear(); }

 private:
  /// The name, and the options that scenes set.
  struct Key {
    std::string name;
    int size = 0, normal_map_size = 0;
    bool keep_places = false, keep_uv = false, keep_warp = false;
    ChartChoice charts{};
    double spacing = 0, metres = 1;
    bool z_up = false;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  std::map<Key, LoadedSurface> kept_;
};

/// Times and measurements of a frame.
struct FrameReport {
  double milliseconds = 0, forces_ms = 0, solve_ms = 0, collide_ms = 0, limit_ms = 0;
  int iterations = 0;
  double residual = 0;  ///< largest of its steps
  StrainSummary strain;
  double kinetic_energy = 0, potential_energy = 0;  ///< [J]
  int contacts = 0;                                 ///< with obstacles, largest of its steps
  int self_contacts = 0;                            ///< of cloth with cloth, largest of its steps
  int stopped = 0;          ///< points that the collision filter stopped, largest of its steps
  int fell_back = 0;        ///< of these, points reset to the step's start, largest of its steps
  int whole_fell_back = 0;  ///< cloths whose points were all reset, largest of its steps
  int buried = 0;           ///< samples of bodies that lie in their body, see PlacedBody
  /// Time by which cloth lags behind, since steps that gained energy were gone in part only. [s]
  double lost_time = 0;
  double work = 0;  ///< of pins, moving bodies, wind and air [J]
  /// The minimum signed distance of a particle to an obstacle, negative on its wrong side. Bodies
  /// count within twice the thickness; infinite when nothing counts. [m]
  double smallest_gap = HUGE_VAL;
  double seam_gap = 0;   ///< largest distance of samples that are to be sewn together [m]
  Vec3d centre_of_mass;  ///< all cloths together [m]
};

struct Cloth;

/// A cloth of a running simulation, for drawing and export.
struct SimulatedCloth {
  std::string name;
  GeometryImage image;  ///< the rest shape as it was loaded
  /// Springs and masses, for the library's own sources; copies of this share it.
  std::shared_ptr<Cloth> model;
  ClothState state;
  std::optional<SourceMesh> source;          ///< unplaced, where the surface came from a mesh
  std::shared_ptr<const Garment> garment{};  ///< where it came from a sewing pattern
};
/// A body of a running simulation, for drawing and export.
struct PlacedBody {
  std::string name;
  GeometryImage image;
  /// Rotated into the world as the body is placed, before it moves, where the surface came from a
  /// mesh.
  std::optional<NormalMap> normals;
  std::optional<NormalMap> image_normals;  ///< the same as loaded
  Planes3 placed;                          ///< world, before it moves; size 0: it does not [m]
  Planes3 positions;                       ///< world, now [m]
  bool moves = false;                      ///< by motion or animation
  std::optional<SourceMesh> source;        ///< unplaced, where the surface came from a mesh
  /// Of a body that has changed its shape: which samples lie in the body itself in this frame, as
  /// where an arm enters the side (2), or leave no room for cloth before them (1). Cloth may pass
  /// through triangles at them. Empty: none. [n * n]
  std::vector<char> buried{};
};

/// A closed body that holds a cloth at the start, wholly or in part, by winding numbers.
struct StartInside {
  std::string cloth, body;
  int samples = 0;    ///< inside, mates counted once
  int particles = 0;  ///< of the cloth
  /// All particles are inside: the body is a container, which keeps the cloth in. A cloth that is
  /// inside in part is pushed out.
  bool kept_in = false;
};

/// The work of pins, moving bodies, wind and air.
struct WorkDone {
  double net = 0;    ///< [J]
  double gross = 0;  ///< sum of its absolute values over all steps [J]
  /// Energy added by the strain limit while pins or bodies moved, and by collisions while bodies
  /// moved: the part of their work that no spring of the cloth accounts for. [J]
  double pulled = 0;
  /// The minimum over the steps so far of the energy at their start, less the work until then. With
  /// later work it gives the energy above which cloth has gained energy from collisions. [J]
  double least = HUGE_VAL;
};

/// Levels of the subdivision of substeps where collisions need shorter steps; level l: 2^l steps.
struct StepLevels {
  /// The maximum level.
  static constexpr int deepest = 6;
  int first = 0;       ///< at which the next substep begins
  int most = deepest;  ///< its maximum, lowered while shorter steps do not help
  friend bool operator==(const StepLevels&, const StepLevels&) = default;
};

/// The complete state between two frames, besides the scene. Integrators carry over only the forces
/// of contacts; colliders only which samples are inside of bodies, which cloths may be tangled and
/// what a filter held back; the stepping only the levels of subdivision and the work done.
struct SimulationState {
  int frame = 0;                   ///< frames done
  std::vector<ClothState> cloths;  ///< in the scene's order
  /// Of each cloth, the collider's state beyond positions: which samples are inside of bodies, and
  /// which cloths it may be tangled with.
  std::vector<std::vector<int>> marks{};
  /// Of each cloth, the forces of its contacts in the last step.
  std::vector<std::vector<PastContact>> contacts{};
  /// Contacts for what the filter held back.
  std::vector<StruckContact> struck{};
  /// Of each cloth, where its pins hold it, which a hand may have changed. [m]
  std::vector<std::vector<Vec3d>> pin_targets{};
  /// Of each cloth whether it is a garment whose seams have closed, and slid to where they fit.
  std::vector<char> fitted{};
  StepLevels levels{};         ///< of the next substep
  WorkDone work{};             ///< up to this frame
  int frames_unexplained = 0;  ///< consecutive ones up to this, with energy that nothing put in
};

/// Samples a side that a scene's surfaces were loaded with; a mesh may need more than were asked
/// for.
struct LoadedSizes {
  std::vector<int> cloths, bodies;
};

/// Optional helpers of a Simulation.
struct SimulationHelp {
  Progress* progress = nullptr;      ///< reports loading and stepping
  SurfaceCache* surfaces = nullptr;  ///< keeps what was loaded for the next simulation
  /// Called once all surfaces are loaded, before what steps them takes its memory; may throw to
  /// refuse them.
  std::function<void(const LoadedSizes&)> loaded{};

  SimulationHelp(Progress* told = nullptr,  // NOLINT(google-explicit-constructor): most say no more
                 SurfaceCache* surface_cache = nullptr)
      : progress(told), surfaces(surface_cache) {}
};

/// The motion of an accepted step, in which every sample moves along a straight line. [m]
struct StepMotion {
  struct Path {
    const Planes3 *start, *end;
  };
  std::span<const Path> cloths, bodies;  ///< in the scene's order
};

/// Observer of every accepted step of a simulation.
class StepWatcher {
 public:
  StepWatcher() = default;
  StepWatcher(const StepWatcher&) = delete;
  StepWatcher& operator=(const StepWatcher&) = delete;
  virtual ~StepWatcher() = default;
  virtual void see(const StepMotion& step) = 0;
};

/// A running simulation of a scene.
class Simulation {
 public:
  /// Loads every surface. @throws SceneError, InputError, TopologyError
  Simulation(const Scene& scene, const std::string& name, const TeamOptions& team,
             const SimulationHelp& help = {});
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  ~Simulation();

  /// Advances by one frame.
  /// @throws Unstable naming frame, cloth and particle when a step yields a not-finite number or
  ///         runaway energy, with the integrator's advice
  FrameReport advance();

  /// Reports every step from the next one on; null: to nobody. @param watcher  kept by pointer
  void watch(StepWatcher* watcher);

  /// Copies the state; nothing is allocated when `state` has held it before.
  void save(SimulationState& state) const;
  /// Continues from a saved state of the same scene with the same bits. A grabbed sample is
  /// released.
  void restore(const SimulationState& state);

  /// Grabs the surface point of a sample from the next step on, as a pin that follows `pull`. One
  /// at a time. A sample that was pinned before stays pinned on release, at its new position.
  /// @param cloth  of cloths()  @throws SceneError for a sample outside the image
  void grab(std::size_t cloth, int sample);
  /// Target position of the grabbed point. It moves no faster than a hand, no farther from the
  /// samples around it than cloth stretches, and not into the ground. [m]
  void pull(Vec3d target);
  void let_go();
  [[nodiscard]] bool holds() const;

  /// Cloth is at rest where no more than this part of its samples is faster than this [m/s].
  static constexpr double restless_part = 0.01;
  static constexpr float resting_speed = 0.01F;
  /// Whether the last frame left cloth at rest, with all seams sewn, pins where they are to be, and
  /// without wind, a hand, or bodies that move in the scene.
  [[nodiscard]] bool is_at_rest() const;

  [[nodiscard]] int frame() const;
  [[nodiscard]] const std::vector<SimulatedCloth>& cloths() const;
  [[nodiscard]] const std::vector<PlacedBody>& bodies() const;
  /// Where the animation of a body's mesh has its vertices now, in the mesh's order; empty for a
  /// body that moves otherwise, or not, or came from an image. The samples of the body's image are
  /// blended from them. @param body  of bodies()  @return [V] world [m]
  [[nodiscard]] std::vector<Vec3d> body_vertices(std::size_t body) const;
  [[nodiscard]] const std::vector<std::string>& notes() const;  ///< repairs made while loading
  /// The closed bodies that hold cloths at the start, ordered by cloth, then by body.
  [[nodiscard]] const std::vector<StartInside>& start_insides() const;
  /// Hash of all positions and velocities, 16 hexadecimal digits.
  [[nodiscard]] std::string state_hash() const;
  [[nodiscard]] int particles() const;
  [[nodiscard]] Vec3d centre_of_mass() const;
  [[nodiscard]] double mass() const;  ///< of all cloths together [kg]
  [[nodiscard]] double side() const;  ///< of the largest cloth: the root of its area [m]
  /// Kinetic plus potential energy before the first frame [J].
  [[nodiscard]] double start_energy() const;
  /// The gap that a cloth keeps to itself and others: its material's thickness, or less where its
  /// samples are so near each other that folds would lock. [m]
  [[nodiscard]] double used_thickness(std::size_t cloth) const;
  /// The contacts of a cloth in the last step.
  [[nodiscard]] std::span<const Contact> contacts(std::size_t cloth) const;
  /// The largest distance between the two samples of a pair, for each seam of a garment; empty for
  /// other cloths. [m]
  [[nodiscard]] std::vector<double> seam_gaps(std::size_t cloth) const;
  /// How much longer the cloth beside each seam of a garment is than at rest, as a part: the
  /// largest stretch at each of its samples, on their mean; empty for other cloths.
  [[nodiscard]] std::vector<double> seam_stretches(std::size_t cloth) const;
  /// How far a garment has sunk from where it is worn: the edges of that label, its collar or
  /// waist, that are farthest below where the pattern places them, on the mean of each label, or
  /// all of a garment without labels. Places go with the bodies. 0 for other cloths. [m]
  [[nodiscard]] double sunk(std::size_t cloth) const;
  /// Counts the pairs of triangles that cross now: of cloths with themselves, with each other and
  /// with bodies, and triangles below the ground. Exact, and none of a collider's code. Costs about
  /// as much as a frame; not by several threads at once.
  [[nodiscard]] IntersectionCounts intersections() const;
  /// Number of cloth edges that crossed cloth at the start of the last step and are being
  /// untangled.
  [[nodiscard]] int crossings() const;
  /// The mean of l / r - 1 over the springs along rows and columns around each sample, now.
  /// @param strains  [n x n]
  void strain_at_samples(std::size_t cloth, Grid<float>& strains) const;
  /// The last correction that the last step's solve made to each sample, over the rest spacing.
  /// @param sizes  [n x n] @return false where the method does not iterate
  bool last_corrections(std::size_t cloth, Grid<float>& sizes) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace weft
