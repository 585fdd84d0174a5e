#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/collide/intersections.h"
#include "weft/run.h"
#include "weft/run/export/surface_record.h"

namespace weft {

/// Everything that a run leaves in its folder. Files that grow appear under their names at
/// `finish`.
class Recorder {
 public:
  /// Writes what does not grow. @param simulation  at its start; kept by reference, as are the
  /// others
  /// @throws OutputError, as everything below
  Recorder(const Simulation& simulation, const Scene& scene, const RunOptions& options);

  /// Begins the files that grow, with frame 0.
  void start();
  /// Goes on with those of an earlier run, at the simulation's frame.
  /// @param finished  nothing will be added: whole files are left as they are
  /// @throws InputError when they do not hold the frames up to there
  void resume(bool finished);
  void add_frame();
  /// Waits until all frames are on the disk.
  void flush();
  /// Puts the files that grew in their places and names everything in the report, what
  /// `make_of_caches` will leave, too.
  void finish(RunReport& report);
  /// Makes the files that are made of those. They take room that may be missing: whatever tells how
  /// to go on is better written before.
  void make_of_caches();

  /// What cloths pass through as everything stands now: each itself, the others, bodies, the
  /// ground.
  [[nodiscard]] IntersectionCounts intersections();
  /// Pairs of triangles of what is written that cross now: cloths with all, on the meshes' own
  /// vertices where those are written.
  [[nodiscard]] std::int64_t written_crossings();

 private:
  using Records = std::vector<std::unique_ptr<SurfaceRecord>>;
  [[nodiscard]] std::filesystem::path file(const std::string& name,
                                           const std::string& ending) const;
  void record_cloths(const ExportOptions& options);
  void record_bodies(const ExportOptions& options);
  void write_rest(const SurfaceRecord::Subject& subject);
  void write_normals(const PlacedBody& body);
  void write_manifests(RunReport& report);
  template <class Visit>
  void each(const Visit& visit) const;

  const Simulation& simulation_;
  const Scene& scene_;
  const RunOptions& options_;
  std::vector<Planes3> body_rests_;  // placed, where a mesh is written
  Records cloths_, bodies_;
  std::vector<std::filesystem::path> rests_;  // outputs that do not grow
  std::optional<IntersectionCheck> check_;    // made where it is asked for
};

}  // namespace weft
