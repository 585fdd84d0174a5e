#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "weft/core/progress.h"
#include "weft/run/export/motion_writers.h"
#include "weft/run/frame_intersections.h"
#include "weft/run/verification.h"
#include "weft/sim/simulation.h"

namespace weft {

struct RunOptions {
  std::filesystem::path folder{};  ///< where everything is written
  std::vector<std::string> exports{"obj", "pc2"};
  WrittenOn on = WrittenOn::automatic;  ///< whose vertices are written
  bool unwelded = false;  ///< write every sample instead of joining mates; none of a mesh's then
  /// Count intersections in every frame, not in the last one only, and look at every step.
  bool verify = false;
  int threads = 1;
  InstructionSet instructions = best_instruction_set();
  Progress* progress = nullptr;
  /// Told at the start, in one line each, what is better known before the run ends.
  std::function<void(const std::string& line)> tell{};
  /// Frames between two checkpoints; 0: none; nothing: every five seconds.
  std::optional<int> checkpoint_frames{};
  bool resume = false;  ///< go on where the folder's checkpoint stands, if it has one
  /// Where the scene is written once it is known to run; empty: nowhere.
  std::filesystem::path scene_file{};
};

/// What `simulate` reports: the fields of its JSON, and more.
struct RunReport {
  int frames = 0, particles = 0, threads = 1, substeps = 1;
  std::string scene, integrator;
  double time_step = 0;              ///< [s]
  double start_energy = 0;           ///< kinetic plus potential, of frame 0 [J]
  double mass = 0;                   ///< of all cloths [kg]
  std::vector<FrameReport> history;  ///< one a frame, from frame 1
  /// Of each cloth: its name, and the gap that it kept to cloth [m].
  std::vector<std::pair<std::string, double>> thickness_used;
  std::vector<StartInside> start_insides;
  StrainSummary strain;  ///< last frame
  int contacts_max = 0, self_contacts_max = 0;
  FrameIntersections intersections;          ///< of the last frame; with verify: of the worst one
  IntersectionCounts start_intersections;    ///< of frame 0
  std::optional<Verification> verification;  ///< with verify
  /// The first frame from which on no cloth crosses itself or another: 0 where none did at the
  /// start; nothing where some still do.
  std::optional<int> untangled_frame;
  std::vector<Vec3d> centre_of_mass;  ///< frame 0 first
  std::string state_hash;
  std::uint64_t estimated_memory = 0;  ///< before the start [bytes]
  std::vector<std::string> notes;
  std::vector<std::filesystem::path> outputs;
};

/// Runs a whole scene into a folder, which is made when missing: for each cloth and body its
/// geometry image NAME.exr (at rest, unplaced) and what is exported of it; caches.json, which tells
/// what that is; frames.csv; weft-run.json, by which open_run_folder finds it again. When the run
/// stops early by error or interruption, what was finished is kept: files appear whole, with the
/// frames there are, and a checkpoint of the last of them. A run that was killed goes on at its
/// last checkpoint; either way it ends in the bits and the report (but for times) of one that never
/// stopped.
/// @throws UsageError for an export that is not known, or a mesh's vertices asked for where a cloth
/// is a geometry image; OutputError; what Simulation throws;
/// SceneError when the memory that is there can certainly not hold it; InputError for a checkpoint
/// that is damaged, of another version or another scene; Interrupted
RunReport run_scene(const Scene& scene, const std::string& name, const RunOptions& options);

}  // namespace weft
