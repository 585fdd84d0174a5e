#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/collide/intersections.h"
#include "weft/sim/export/pc2_writer.h"
#include "weft/sim/export/surface_points.h"
#include "weft/sim/run.h"

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
  /// Puts the files that grew in their places and names everything in the report.
  void finish(RunReport& report);

  /// What cloths pass through as everything stands now: each itself, the others, bodies, the
  /// ground.
  [[nodiscard]] IntersectionCounts intersections();

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& name,
                                           const std::string& ending) const;
  /// What has a point cache: cloths, and bodies that move.
  struct Moving {
    std::string name;
    const SurfacePoints* points;
    const Planes3* positions;  ///< now [m]
    [[nodiscard]] std::vector<Vec3f> gather() const { return points->gather(*positions); }
  };
  void write_surface(const std::string& name, const GeometryImage& image, const Planes3& positions,
                     const SurfacePoints& points);
  void write_body(const PlacedBody& body);

  const Simulation& simulation_;
  const Scene& scene_;
  const RunOptions& options_;
  std::vector<SurfacePoints> cloths_, bodies_;
  std::vector<Moving> moving_;                      // where caches are wanted
  std::vector<std::unique_ptr<Pc2Writer>> caches_;  // one for each that is not whole yet
  std::vector<std::filesystem::path> outputs_;
  std::optional<IntersectionCheck> check_;  // made where it is asked for
};

}  // namespace weft
