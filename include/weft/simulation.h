#pragma once

#include <cmath>
#include <compare>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "weft/cloth_state.h"
#include "weft/contact.h"
#include "weft/convert.h"
#include "weft/progress.h"
#include "weft/scene.h"
#include "weft/threads.h"

namespace weft {

/// Keeps surfaces that were loaded, for those who make a scene's simulation again and again: what
/// took seconds to convert is there at once the next time. Files that changed since are not looked
/// at again.
class SurfaceCache {
 public:
  /// As load_surface, where a surface in memory is not kept. @throws as it
  LoadedSurface load(const Surface& surface, const ConvertOptions& options);
  void clear() { kept_.clear(); }

 private:
  /// What of the options scenes set.
  struct Key {
    std::string name;
    int size = 0, normal_map_size = 0;
    bool keep_places = false;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  std::map<Key, LoadedSurface> kept_;
};

/// What one frame cost and came to.
struct FrameReport {
  double milliseconds = 0, forces_ms = 0, solve_ms = 0, collide_ms = 0, limit_ms = 0;
  int iterations = 0;
  double residual = 0;  ///< largest of its steps
  StrainSummary strain;
  double kinetic_energy = 0, potential_energy = 0;  ///< [J]
  int contacts = 0;                                 ///< with obstacles, largest of its steps
  int self_contacts = 0;                            ///< of cloth with cloth, largest of its steps
  int stopped = 0;          ///< points that the collision filter held back, largest of its steps
  int fell_back = 0;        ///< of these, points put back to the step's start, largest of its steps
  int whole_fell_back = 0;  ///< cloths of which all points were, largest of its steps
  double work = 0;          ///< of pins, moving bodies and wind [J]
  /// The least signed distance of a particle to an obstacle, negative inside; known up to twice the
  /// thickness, infinite where nothing is known to be near. [m]
  double smallest_gap = HUGE_VAL;
  Vec3d centre_of_mass;  ///< all cloths together [m]
};

struct Cloth;

/// A cloth of a running simulation, for those who draw or export it.
struct SimulatedCloth {
  std::string name;
  GeometryImage image;  ///< the rest shape as it was loaded
  /// Springs and masses, for the library's own sources; copies of this share it.
  std::shared_ptr<Cloth> model;
  ClothState state;
  std::optional<SourceMesh> source;  ///< unplaced, where the surface came from a mesh
};
struct PlacedBody {
  std::string name;
  GeometryImage image;
  /// Rotated into the world, where the surface came from a mesh and the body stands still.
  std::optional<NormalMap> normals;
  std::optional<NormalMap> image_normals;  ///< the same as loaded
  Planes3 positions;                       ///< world, now [m]
  bool moves = false;                      ///< by motion or animation
  std::optional<SourceMesh> source;        ///< unplaced, where the surface came from a mesh
};

/// A closed body that a cloth begins inside of, wholly or in part, by winding numbers.
struct StartInside {
  std::string cloth, body;
  int samples = 0;    ///< inside, mates counted once
  int particles = 0;  ///< of the cloth
  /// All are: the body is a container, which keeps the cloth in. What is inside in part is pushed
  /// out.
  bool kept_in = false;
};

/// What pins, moving bodies and wind did.
struct WorkDone {
  double net = 0;    ///< [J]
  double gross = 0;  ///< sum of its sizes, step by step [J]
  /// What the strain limit added while pins or bodies moved, and collisions while bodies did: the
  /// part of their work that no spring of the cloth explains. [J]
  double pulled = 0;
  /// The least energy that collisions have seen so far, less net: with new work the most that cloth
  /// may hold. [J]
  double least = HUGE_VAL;
};

/// Into which steps substeps are split that collisions ask shorter ones for; level l: 2^l of them.
struct StepLevels {
  /// A substep is not split further than this.
  static constexpr int deepest = 6;
  int first = 0;       ///< with which the next substep begins
  int most = deepest;  ///< to which it may go: less while shorter steps turned out to be no help
  friend bool operator==(const StepLevels&, const StepLevels&) = default;
};

/// All that the next frame depends on besides the scene: integrators carry over from one frame to
/// the next only what contacts did, colliders which samples are inside of bodies, and which cloths
/// may be tangled; and the length of steps that collisions asked for.
struct SimulationState {
  int frame = 0;                   ///< frames done
  std::vector<ClothState> cloths;  ///< in the scene's order
  /// Of each cloth, what the collider knows of it beyond positions: which samples are inside of
  /// bodies, and what it may be tangled with.
  std::vector<std::vector<int>> marks{};
  /// Of each cloth, what contacts did in the last step.
  std::vector<std::vector<PastContact>> contacts{};
  StepLevels levels{};  ///< of the next substep
  WorkDone work{};      ///< up to this frame
};

/// Who helps a scene to life.
struct SimulationHelp {
  Progress* progress = nullptr;      ///< told of loading and stepping
  SurfaceCache* surfaces = nullptr;  ///< keeps what was loaded for the next simulation

  SimulationHelp(Progress* told = nullptr,  // NOLINT(google-explicit-constructor): most say no more
                 SurfaceCache* surface_cache = nullptr)
      : progress(told), surfaces(surface_cache) {}
};

/// A step that stands: every sample goes straight. [m]
struct StepMotion {
  struct Path {
    const Planes3 *start, *end;
  };
  std::span<const Path> cloths, bodies;  ///< in the scene's order
};

/// Is shown every step of a run.
class StepWatcher {
 public:
  StepWatcher() = default;
  StepWatcher(const StepWatcher&) = delete;
  StepWatcher& operator=(const StepWatcher&) = delete;
  virtual ~StepWatcher() = default;
  virtual void see(const StepMotion& step) = 0;
};

/// A scene brought to life.
class Simulation {
 public:
  /// Loads every surface. @throws SceneError, InputError, TopologyError
  Simulation(const Scene& scene, const std::string& name, const TeamOptions& team,
             const SimulationHelp& help = {});
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  ~Simulation();

  /// Advances by one frame.
  /// @throws SceneError naming frame, cloth and particle when a step yields a not-finite number or
  /// runaway
  ///         energy, with the integrator's advice
  FrameReport advance();

  /// Shows it every step from the next on; null: nobody. @param watcher  kept by pointer
  void watch(StepWatcher* watcher);

  /// Copies the state; nothing is allocated when `state` has held it before.
  void save(SimulationState& state) const;
  /// Goes on from a saved state of the same scene: what follows has the same bits. What was grabbed
  /// is let go.
  void restore(const SimulationState& state);

  /// Holds the surface point of a sample from the next step on, as a pin that follows `pull`. One
  /// at a time. A sample that is pinned already stays pinned when it is let go, where it was taken
  /// to.
  /// @param cloth  of cloths()  @throws SceneError for a sample outside the image
  void grab(std::size_t cloth, int sample);
  /// Where what is grabbed shall go. It goes no faster than a hand and no farther from the samples
  /// around it than cloth stretches, and does not enter the ground. [m]
  void pull(Vec3d target);
  void let_go();
  [[nodiscard]] bool holds() const;

  [[nodiscard]] int frame() const;
  [[nodiscard]] const std::vector<SimulatedCloth>& cloths() const;
  [[nodiscard]] const std::vector<PlacedBody>& bodies() const;
  [[nodiscard]] const std::vector<std::string>& notes() const;  ///< repairs made while loading
  /// In the order of cloths, then of bodies.
  [[nodiscard]] const std::vector<StartInside>& start_insides() const;
  /// Of all positions and velocities, 16 hexadecimal digits.
  [[nodiscard]] std::string state_hash() const;
  [[nodiscard]] int particles() const;
  [[nodiscard]] Vec3d centre_of_mass() const;
  [[nodiscard]] double mass() const;  ///< of all cloths together [kg]
  /// Kinetic plus potential energy before the first frame [J].
  [[nodiscard]] double start_energy() const;
  /// The gap that a cloth keeps to itself and others: its material's thickness, or less where its
  /// samples are so near each other that folds would lock. [m]
  [[nodiscard]] double used_thickness(std::size_t cloth) const;
  /// What the last step found to press on a cloth.
  [[nodiscard]] std::span<const Contact> contacts(std::size_t cloth) const;
  /// Edges of cloth that passed through cloth at the start of the last step, and are being
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
