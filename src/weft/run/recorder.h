#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/run.h"
#include "weft/run/export/surface_record.h"

namespace weft {

/// Writes all files of a run to its folder. Files that grow get their final names at `finish`.
class Recorder {
 public:
  /// Writes the files that do not grow.
  /// @param simulation  at its start; kept by reference, as are the others
  /// @throws OutputError, as everything below
  Recorder(const Simulation& simulation, const Scene& scene, const RunOptions& options);

  /// Starts the files that grow, with frame 0.
  void start();
  /// Continues the growing files of an earlier run, at the simulation's frame.
  /// @param finished  nothing will be added: whole files are left as they are
  /// @throws InputError when they do not hold the frames up to there
  void resume(bool finished);
  void add_frame();
  /// Waits until all frames are on the disk.
  void flush();
  /// Finishes the files that grew, and lists all outputs in the report, including those that
  /// `make_of_caches` will write.
  void finish(RunReport& report);
  /// Writes the files that are converted from finished caches. They may fill the disk, so the
  /// checkpoint should be written before.
  void make_of_caches();

  /// Pairs of triangles of the written surfaces that cross now, cloths with everything; on the
  /// vertices of the input meshes where those are written.
  [[nodiscard]] std::int64_t written_crossings();

 private:
  using Records = std::vector<std::unique_ptr<SurfaceRecord>>;
  [[nodiscard]] std::filesystem::path file(const std::string& name,
                                           const std::string& ending) const;
  void record_cloths(const ExportOptions& options);
  void record_bodies(const ExportOptions& options);
  void write_image_of(const SurfaceRecord::Subject& subject);
  /// Of a cloth that is not its image at rest.
  void write_rest(const SimulatedCloth& cloth, const Placement& placement);
  void write_normals(const PlacedBody& body);
  void write_manifests(RunReport& report);
  /// Whether it is a garment with open seams.
  [[nodiscard]] bool is_open(const SurfaceRecord& record) const;
  template <class Visit>
  void each(const Visit& visit) const;

  const Simulation& simulation_;
  const Scene& scene_;
  const RunOptions& options_;
  std::vector<Planes3> body_rests_;  // placed, where a mesh is written
  Records cloths_, bodies_;
  std::vector<std::filesystem::path> rests_;  // outputs that do not grow
};

}  // namespace weft
