#include "weft/run.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/run/begin_notes.h"
#include "weft/run/checkpoint.h"
#include "weft/run/checkpoint_clock.h"
#include "weft/run/disk_reservation.h"
#include "weft/run/recorder.h"
#include "weft/run/run_identity.h"
#include "weft/run/standstill_notes.h"
#include "weft/scene_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// Upper bounds on the sizes of frames.csv and the manifests [bytes].
constexpr std::size_t min_room = 16384, room_of_surface = 1024, room_of_frame = 256;

/// Stretch along a seam beyond which a garment is too narrow there.
constexpr double max_stretch = 0.1;
/// How far the collar or waist of a garment may sink before it counts as fallen off. [m]
constexpr double max_sunk = 0.2;

std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

void check_exports(const Scene& scene, const RunOptions& options) {
  const auto known = export_formats();
  for (const std::string& format : options.exports)
    if (std::find(known.begin(), known.end(), format) == known.end())
      throw UsageError("--export", fmt::format("unknown format '{}'", format),
                       "known are: " + listed(known));
  if (options.on != WrittenOn::input) return;
  if (options.unwelded)
    throw UsageError("--unwelded", "goes with the image's samples, --on input with a mesh",
                     "one of both is wanted");
  for (const SceneCloth& cloth : scene.cloths)
    if (cloth.surface.image || (!cloth.surface.mesh && is_image_name(cloth.surface.name)))
      throw UsageError("--on input",
                       fmt::format("the cloth '{}' is a geometry image, {}, which holds no mesh",
                                   cloth.name, cloth.surface.name),
                       "the mesh that it was made from in its place, or --on image, is wanted");
}

/// The part of a report that is known before the first frame.
RunReport start_report(const Simulation& simulation, const Scene& scene, const std::string& name,
                       int threads) {
  RunReport report;
  report.scene = name;
  report.particles = simulation.particles();
  report.threads = threads;
  report.substeps = scene.substeps;
  report.integrator = name_of(scene.integrator);
  report.time_step = 1 / (scene.frame_rate * scene.substeps);
  report.notes = simulation.notes();
  report.start_energy = simulation.start_energy();
  report.mass = simulation.mass();
  report.side = simulation.side();
  for (std::size_t i = 0; i < simulation.cloths().size(); ++i)
    report.thickness_used.emplace_back(simulation.cloths()[i].name, simulation.used_thickness(i));
  report.start_insides = simulation.start_insides();
  report.centre_of_mass.push_back(simulation.centre_of_mass());
  return report;
}

void add_to_report(RunReport& report, const FrameReport& frame) {
  ++report.frames;
  report.history.push_back(frame);
  report.strain = frame.strain;
  report.contacts_max = std::max(report.contacts_max, frame.contacts);
  report.self_contacts_max = std::max(report.self_contacts_max, frame.self_contacts);
  report.centre_of_mass.push_back(frame.centre_of_mass);
}

class Run {
 public:
  Run(const Scene& scene, const std::string& name, const RunOptions& options)
      : scene_(scene),
        options_(options),
        path_(checkpoint_path(options.folder)),
        clock_(options.checkpoint_frames),
        simulation_(scene, name, {options.threads, options.instructions}, help(name)),
        report_(start_report(simulation_, scene, name, options.threads)) {
    if (options.verify) {
      verifier_.emplace(simulation_, scene.ground);
      simulation_.watch(&*verifier_);
      report_.verification.emplace();
    }
    if (!clock_.off() || options.resume)
      point_.identity = run_identity(scene, simulation_, options);
    point_.start_centre = report_.centre_of_mass.front();
    report_.estimated_memory = memory_;
  }

  void start() {
    // A checkpoint of an earlier run would not match the files that begin now.
    std::error_code ignored;
    fs::remove(path_, ignored);
    make_recorder().start();
    reserve();
    tell_start();
    simulation_.save(point_.state);
    if (options_.resume)
      report_.notes.push_back(
          fmt::format("{}: nothing to resume, begun at frame 0", options_.folder.string()));
  }

  void resume(const Checkpoint& from) {
    check(from);
    Recorder& recorder = make_recorder();
    tell_start();
    simulation_.restore(from.state);
    recorder.resume(is_done());
    reserve();
    point_.state = from.state;
    for (const FrameReport& frame : from.history) add_to_report(report_, frame);
    report_.intersections = from.intersections;
    report_.untangled_frame = from.untangled_frame;
    if (verifier_) {
      verifier_->begin();
      report_.verification = from.verification;
    }
    last_written_ = from.state.frame;
    report_.notes.push_back(is_done() ? fmt::format("{}: finished already, nothing is left to do",
                                                    options_.folder.string())
                                      : fmt::format("{}: resumed after frame {}",
                                                    options_.folder.string(), from.state.frame));
  }

  RunReport go() {
    try {
      while (!is_done()) advance();
      if (simulation_.frame() < scene_.frames)
        report_.notes.push_back(fmt::format("at rest in frame {}", simulation_.frame()));
      update(options_.progress, "simulate", 1);
      if (!options_.verify) {
        report_.intersections = {};
        keep_worst(simulation_.intersections());
      }
      note_untangling();
      note_crossed_bodies();
      note_what_stood_still(report_);
      report_garments();
      report_.state_hash = simulation_.state_hash();
    } catch (...) {
      keep_what_fits();
      throw;
    }
    keep();
    return std::move(report_);
  }

 private:
  [[nodiscard]] bool is_done() const {
    return simulation_.frame() == scene_.frames ||
           (options_.until_rest && simulation_.is_at_rest());
  }

  void report_seams(std::size_t cloth) {
    if (!report_.seams) report_.seams.emplace();
    SeamsReport& seams = *report_.seams;
    const std::vector<double> gaps = simulation_.seam_gaps(cloth),
                              stretches = simulation_.seam_stretches(cloth);
    const SimulatedCloth& sewn = simulation_.cloths()[cloth];
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      ++seams.count;
      seams.largest_gap = std::max(seams.largest_gap, gaps[k]);
      if (gaps[k] == 0)
        ++seams.closed;
      else
        seams.open.push_back({sewn.name, sewn.garment->seams[k].name, gaps[k]});
      if (stretches[k] > max_stretch)
        seams.tight.push_back({sewn.name, sewn.garment->seams[k].name, stretches[k]});
    }
    std::ranges::stable_sort(seams.open, std::ranges::greater(), &OpenSeam::gap);
    std::ranges::stable_sort(seams.tight, std::ranges::greater(), &TightSeam::stretch);
  }

  void report_garments() {
    for (std::size_t i = 0; i < simulation_.cloths().size(); ++i) {
      if (!simulation_.cloths()[i].garment) continue;
      if (simulation_.sunk(i) > max_sunk) report_.fell_off.push_back(simulation_.cloths()[i].name);
      report_seams(i);
    }
    const auto closed = std::find_if(report_.history.begin(), report_.history.end(),
                                     [](const FrameReport& frame) { return frame.seam_gap == 0; });
    if (report_.seams && closed != report_.history.end())
      report_.seams->frames = static_cast<int>(closed - report_.history.begin()) + 1;
  }

  Recorder& make_recorder() {
    if (!options_.scene_file.empty()) write_scene(options_.scene_file, scene_);
    recorder_.emplace(simulation_, scene_, options_);
    return *recorder_;
  }

  void check(const Checkpoint& from) const {
    const std::string difference = identity_difference(from.identity, point_.identity);
    if (!difference.empty())
      throw InputError(path_.string(), "is of another scene: " + difference,
                       "the same scene, or a run without --resume, is wanted");
    const auto& cloths = simulation_.cloths();
    if (!std::equal(cloths.begin(), cloths.end(), from.state.cloths.begin(),
                    from.state.cloths.end(),
                    [](const SimulatedCloth& cloth, const ClothState& state) {
                      return cloth.model->size == state.position.size();
                    }))
      throw InputError(path_.string(), "does not fit to its scene",
                       "a run without --resume starts afresh");
    if (from.state.frame > scene_.frames)
      throw InputError(path_.string(), fmt::format("is of frame {}", from.state.frame),
                       fmt::format("at least {} frames are wanted", from.state.frame));
  }

  void tell(const std::string& line) {
    if (options_.tell) options_.tell(line);
  }

  void tell_start() {
    for (const std::string& line : report_.notes) tell(line);
    const IntersectionCounts counts = simulation_.intersections();
    report_.start_intersections = counts;
    for (const std::string& line : begin_notes(simulation_, scene_, counts)) tell(line);
    if (tangled_pairs(counts) == 0) report_.untangled_frame = 0;
  }

  /// Counts intersections: in every frame with verify, else only while cloths that crossed at the
  /// start are known to cross still, by an earlier count or by the collider.
  void count_intersections() {
    const bool began_tangled = tangled_pairs(report_.start_intersections) > 0;
    const bool tangled = began_tangled && (!report_.untangled_frame || simulation_.crossings() > 0);
    if (!options_.verify && !tangled) return;
    const IntersectionCounts counts = simulation_.intersections();
    if (began_tangled && tangled_pairs(counts) > 0) {
      report_.untangled_frame.reset();
    } else if (!report_.untangled_frame) {
      report_.untangled_frame = simulation_.frame();
    }
    if (options_.verify) verify(counts);
  }

  void verify(const IntersectionCounts& counts) {
    keep_worst(counts);
    verifier_->count_frame(simulation_.frame(), *report_.verification);
    if (options_.on == WrittenOn::input)
      report_.verification->written.add(simulation_.frame(), recorder_->written_crossings());
  }

  void note_crossed_bodies() {
    if (report_.start_intersections.bodies == 0) return;
    const auto left = simulation_.intersections().bodies;
    if (left > 0)
      report_.notes.push_back(fmt::format(
          "in the last frame {} pairs of triangles of cloths and bodies cross still", left));
  }

  void note_untangling() {
    if (!report_.untangled_frame) {
      const IntersectionCounts counts = simulation_.intersections();
      report_.notes.push_back("cloth is still tangled: in the last frame " + tangle_text(counts));
    } else if (*report_.untangled_frame > 0) {
      report_.notes.push_back(fmt::format("what crossed at the start is apart since frame {}",
                                          *report_.untangled_frame));
    }
  }

  void keep_worst(const IntersectionCounts& counts) {
    if (counts.total() > report_.intersections.counts.total())
      report_.intersections = {simulation_.frame(), counts};
  }

  void advance() {
    const FrameReport done = simulation_.advance();
    recorder_->add_frame();
    add_to_report(report_, done);
    count_intersections();
    if (clock_.off()) return;
    simulation_.save(point_.state);
    if (!clock_.is_due(report_.frames)) return;
    recorder_->flush();
    write_point();
  }

  /// Reserves disk space for what `keep` writes when frames have filled the disk.
  void reserve() {
    const std::size_t surfaces = scene_.cloths.size() + scene_.bodies.size();
    const auto frames = static_cast<std::size_t>(scene_.frames);
    reservation_.emplace(options_.folder / "room",
                         min_room + room_of_surface * surfaces + room_of_frame * frames);
  }

  /// Finishes all files with the frames so far, and writes the checkpoint.
  void keep() {
    reservation_.reset();
    recorder_->finish(report_);
    if (!options_.scene_file.empty())
      report_.outputs.insert(report_.outputs.begin(), options_.scene_file);
    if (!clock_.off()) {
      if (last_written_ != report_.frames) write_point();
      report_.outputs.push_back(path_);
    }
    recorder_->make_of_caches();
  }

  /// Keeps what still fits. A second output error would only hide the first.
  void keep_what_fits() {
    try {
      keep();
    } catch (const OutputError&) {
      return;
    }
  }

  void write_point() {
    point_.history = report_.history;
    point_.intersections = report_.intersections;
    point_.untangled_frame = report_.untangled_frame;
    point_.verification = report_.verification.value_or(Verification{});
    write_checkpoint(path_, point_);
    last_written_ = report_.frames;
    clock_.written();
  }

  /// Estimates the memory again by the sizes that surfaces came out with.
  SimulationHelp help(const std::string& name) {
    SimulationHelp wanted(options_.progress);
    wanted.loaded = [this, &name](const LoadedSizes& sizes) {
      memory_ = estimate_memory(scene_, sizes);
      const bool larger = memory_ > estimate_memory(scene_);
      if (const auto available = available_memory(); larger && available)
        check_memory(memory_, *available, name);
    };
    return wanted;
  }

  const Scene& scene_;
  const RunOptions& options_;
  fs::path path_;  // of the checkpoint
  CheckpointClock clock_;
  std::uint64_t memory_ = 0;  // that the run is estimated to take [bytes]
  Simulation simulation_;
  RunReport report_;
  std::optional<Verifier> verifier_;
  std::optional<Recorder> recorder_;
  Checkpoint point_;  // its state is that of the last finished frame
  int last_written_ = -1;
  std::optional<DiskReservation> reservation_;
};

}  // namespace

RunReport run_scene(const Scene& scene, const std::string& name, const RunOptions& options) {
  check_exports(scene, options);
  check_inputs_stay(scene, name, options);
  if (const auto available = available_memory())
    check_memory(estimate_memory(scene), *available, name);
  const WantedFolder folder(options.folder);
  const FolderLock lock(options.folder);
  std::optional<Checkpoint> found;
  if (options.resume) found = read_checkpoint(checkpoint_path(options.folder));
  Run run(scene, name, options);
  if (found) {
    run.resume(*found);
  } else {
    run.start();
  }
  RunReport report = run.go();
  return report;
}

}  // namespace weft
