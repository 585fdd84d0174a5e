#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/run.h"

namespace weft {

/// The point cache of a surface of a finished run.
struct RecordedPoints {
  std::vector<int> vertex_of;   ///< [n * n] point of the cache for each sample
  std::filesystem::path cache;  ///< PC2
  int points = 0, frames = 0;   ///< of the cache; frame 0 is the start
  MeshFrame files;              ///< unit and up axis of its points

  /// Positions of the surface at a frame. [n x n] world [m]
  /// @throws InputError when the cache is cut short; UsageError when there is no such frame
  [[nodiscard]] Planes3 positions(int frame) const;
};

struct RecordedCloth {
  std::string name;
  GeometryImage image;  ///< at rest, unplaced
  RecordedPoints recorded;
  /// Positions at rest, panels and textures laid flat; empty in folders of versions that did not
  /// write it. [n x n] [m]
  Planes3 rest;
  /// Samples that are one particle: also those of seams that are sewn in the run.
  BorderMates mates;
};

/// Tells how far a recorded cloth is stretched.
class RecordedStrain {
 public:
  /// @pre the cloth's rest shape is there
  explicit RecordedStrain(const RecordedCloth& cloth);
  RecordedStrain(RecordedStrain&&) noexcept;
  RecordedStrain& operator=(RecordedStrain&&) = delete;
  ~RecordedStrain();
  /// As Simulation::strain_at_samples. @param positions  [n x n] [m]
  [[nodiscard]] Grid<float> at_samples(const Planes3& positions) const;

 private:
  struct Springs;
  std::unique_ptr<Springs> springs_;
};

struct RecordedBody {
  std::string name;
  GeometryImage image;
  std::optional<NormalMap> normals;        ///< in the world, before the start
  Planes3 positions;                       ///< before the start, world [m]
  std::optional<RecordedPoints> recorded;  ///< of a body that moves

  /// Positions of the body at a frame. @throws as RecordedPoints::positions
  [[nodiscard]] Planes3 positions_at(int frame) const {
    return recorded ? recorded->positions(frame) : positions;
  }
};

/// The output of run_scene in a folder, for drawing.
struct RunFolder {
  std::string scene;
  double frame_rate = 60;        ///< [1/s]
  int frames = 0;                ///< samples in the caches, frame 0 included
  std::optional<double> ground;  ///< [m]
  std::vector<RecordedCloth> cloths;
  std::vector<RecordedBody> bodies;
};

/// Opens a folder of run_scene. @throws InputError when the folder holds no run, or its files do
/// not fit together
RunFolder open_run_folder(const std::filesystem::path& folder);

}  // namespace weft
