#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "weft/colliders.h"
#include "weft/point_cache.h"
#include "weft/progress.h"
#include "weft/scene.h"
#include "weft/simulation.h"

namespace weft {

/// All formats of --export, in the order of the documentation.
std::span<const std::string_view> export_formats();

/// Whose vertices are exported: by the format (the source mesh of a cloth for OBJ, PC2, MDD and
/// GLB, the image for the others), always the image's, or always the mesh's.
enum class WrittenOn { automatic, image, input };
/// The name on the command line: auto, image, input.
std::string_view name_of(WrittenOn on);
/// Whether a format exports the source mesh where there is one. Never EXR, which is the image.
bool is_on_input(std::string_view format, WrittenOn on);

/// The intersections in a frame that was checked.
struct FrameIntersections {
  int frame = 0;  ///< the first with as many; 0 when there are none
  IntersectionCounts counts;
};

/// The largest count of all frames, and the first frame that has it; 0 without any.
struct WorstCount {
  int frame = 0;
  std::int64_t count = 0;
  void add(int at, std::int64_t found) {
    if (found > count) *this = {at, found};
  }
};

/// Failures that are not found by counting crossing triangles at the ends of frames.
struct Verification {
  WorstCount passed;     ///< vertex-face and edge-edge pairs that met within a step
  WorstCount swallowed;  ///< points that moved to the wrong side of a closed body
  WorstCount written;    ///< pairs of triangles that cross in the exported meshes
  [[nodiscard]] bool good() const {
    return passed.count == 0 && swallowed.count == 0 && written.count == 0;
  }
};

/// A seam that is not closed.
struct OpenSeam {
  std::string cloth, name;  ///< the name: PANEL.EDGE-PANEL.EDGE
  double gap = 0;           ///< [m]
};

/// A seam whose cloth is stretched, as it is too narrow for what it goes round.
struct TightSeam {
  std::string cloth, name;  ///< as of open ones
  double stretch = 0;       ///< of the cloth beside it, as a part: see Simulation::seam_stretches
};

/// The seams of all garments of a run.
struct SeamsReport {
  int count = 0, closed = 0;
  std::vector<OpenSeam> open{};    ///< in the last frame, the widest first
  std::vector<TightSeam> tight{};  ///< by more than 10 % in the last frame, the tightest first
  double largest_gap = 0;          ///< in the last frame [m]
  std::optional<int> frames{};     ///< the first frame in which all were closed; nothing: none was
};

struct RunOptions {
  std::filesystem::path folder{};  ///< where everything is written
  std::vector<std::string> exports{"obj", "pc2"};
  WrittenOn on = WrittenOn::automatic;  ///< whose vertices are exported
  bool unwelded = false;  ///< write every sample instead of joining mates; none of a mesh's then
  /// Count intersections in every frame, not in the last one only, and check every step.
  bool verify = false;
  int threads = 1;
  InstructionSet instructions = best_instruction_set();
  Progress* progress = nullptr;
  /// Receives warnings at the start of the run, one line each.
  std::function<void(const std::string& line)> tell{};
  /// Frames between two checkpoints; 0: none; nothing: every five seconds.
  std::optional<int> checkpoint_frames{};
  bool resume = false;      ///< continue from the folder's checkpoint, if it has one
  bool until_rest = false;  ///< end where Simulation::is_at_rest, before the scene's last frame
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
  double side = 0;                   ///< of the largest cloth: the root of its area [m]
  std::vector<FrameReport> history;  ///< one a frame, from frame 1
  /// Of each cloth: its name, and the gap that it kept to cloth [m].
  std::vector<std::pair<std::string, double>> thickness_used;
  std::vector<StartInside> start_insides;
  std::optional<SeamsReport> seams;   ///< where a cloth is a garment
  std::vector<std::string> fell_off;  ///< garments that sank by more than 20 cm
  StrainSummary strain;               ///< last frame
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

/// What users are told of how a simulation begins: cloth inside of bodies, triangles that cross,
/// cloth below the ground. A line each. @param scene  that it is of  @param counts  of its start
std::vector<std::string> begin_notes(const Simulation& simulation, const Scene& scene,
                                     const IntersectionCounts& counts);

/// Runs a whole scene into a folder, which is made when missing: for each cloth and body its
/// geometry image NAME.exr (at rest, unplaced) and its exports; caches.json, which describes the
/// exports; frames.csv; weft-run.json, which open_run_folder reads. When the run stops early by
/// error or interruption, the finished frames are kept in complete files, with a checkpoint of the
/// last one. A killed run resumes at its last checkpoint. Either way a resumed run gives the bits
/// and the report (but for times) of one that never stopped.
/// @throws UsageError for an unknown export, or a mesh's vertices asked for where a cloth is a
///         geometry image; OutputError; what Simulation throws; SceneError when the available
///         memory can certainly not hold it; InputError for a checkpoint that is damaged, of
///         another version or another scene; Interrupted
RunReport run_scene(const Scene& scene, const std::string& name, const RunOptions& options);

/// A run as one JSON object, the contract of `simulate --json`.
std::string to_json(const RunReport& report);

/// The largest rise of kinetic plus potential energy above an earlier minimum, less the work of
/// pins, moving bodies, wind and air in between. [J]
double energy_gained(const RunReport& report);
/// The same as a part of what the cloths' weight does over 1 m; 0: they weigh nothing.
double relative_energy_gained(const RunReport& report);

/// Writes positions over time as a point cache (PC2), as runs export them: one sample a frame.
/// @throws InputError as check_point_cache; OutputError
void write_pc2(const std::filesystem::path& path, const PointCache& cache);

/// The vertices of the mesh that a cloth was made from, carried along by its samples: what exports
/// on the input write.
class CarriedVertices {
 public:
  /// @param simulation  at any frame; not needed afterwards
  /// @param placement   of the cloth in the scene
  /// @throws UsageError where the cloth was made from an image
  CarriedVertices(const Simulation& simulation, std::size_t cloth, const Placement& placement);
  CarriedVertices(const CarriedVertices&) = delete;
  CarriedVertices& operator=(const CarriedVertices&) = delete;
  ~CarriedVertices();
  /// Positions of all vertices, in the order of the mesh. [V] y up [m]
  /// @param samples  of the cloth at some frame [n x n] [m]
  [[nodiscard]] std::vector<Vec3f> positions(const Planes3& samples) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The columns of frames.csv, one line with its end.
std::string frames_csv_header();
/// One frame as a line of frames.csv.
/// @param particles  of all cloths
std::string frames_csv_line(int frame, const FrameReport& report, int particles);

/// Estimates the peak memory of a run from the sizes in the scene, within a quarter for scenes of
/// 257 samples a side and more. Excludes the conversion of meshes, some hundred bytes a triangle.
/// Reads the geometry images among the surfaces, and the sewing patterns, of which it takes what
/// they need at least. @throws InputError for images
/// @return bytes
std::uint64_t estimate_memory(const Scene& scene);
/// The same of surfaces that are loaded.
std::uint64_t estimate_memory(const Scene& scene, const LoadedSizes& sizes);

/// Refuses a scene that can certainly not run in the available memory.
/// @param bytes      of the estimate
/// @param available  see available_memory
/// @throws SceneError when the estimate, wrong by a quarter, is still more
void check_memory(std::uint64_t bytes, std::uint64_t available, const std::string& scene);

/// Whether a run may be short of memory: the estimate exceeds four fifths of what is available.
bool is_memory_short(std::uint64_t bytes, std::uint64_t available);

/// An amount of memory as text: "1.3 GB", "45 MB". MB of 10^6 bytes.
std::string memory_text(std::uint64_t bytes);

/// Memory that this process may still allocate: what the system reports as available, or less where
/// a control group's limit (a container's, a batch job's) leaves less. Nothing where the system
/// does not report it.
/// @param root  of the file system, for tests
/// @return bytes
std::optional<std::uint64_t> available_memory(const std::filesystem::path& root = "/");

}  // namespace weft
