#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/garment.h"
#include "weft/run/export/motion_writer.h"

namespace weft {

/// How surfaces are written.
struct ExportOptions {
  std::filesystem::path folder;
  std::vector<std::string> formats;
  WrittenOn on = WrittenOn::automatic;
  bool unwelded = false;
  double frame_rate = 60;  ///< [1/s]
  MeshFrame files;         ///< unit and axes of what is written
};

/// A written file of a surface.
struct WrittenFile {
  std::filesystem::path path;
  std::string format;
  bool on_input = false;
  int vertices = 0;
};

/// All files of one cloth or body.
class SurfaceRecord {
 public:
  struct Subject {
    std::string name;
    const GeometryImage* image = nullptr;
    const Planes3* now = nullptr;        ///< current positions of the samples [m]
    const Planes3* rest = nullptr;       ///< placed samples at rest, as is the mesh [m]
    const SourceMesh* source = nullptr;  ///< null: the image came from no mesh
    PlacementMap placement;
    bool moves = true;
    const Garment* garment = nullptr;  ///< null: the surface is no sewing pattern
    /// Current world positions of the source's vertices where more is known of them than where the
    /// samples are [m]; null, or gives none: they follow the samples.
    std::function<std::vector<Vec3d>()> vertices{};
  };
  /// @param subject  what it points to must outlive this
  SurfaceRecord(const Subject& subject, const ExportOptions& options);
  SurfaceRecord(const SurfaceRecord&) = delete;
  SurfaceRecord& operator=(const SurfaceRecord&) = delete;

  /// Writes the files that do not grow, at the current positions. @throws OutputError, as all that
  /// follows
  void write_still_files();
  /// Starts the files that grow, with frame 0.
  void start();
  /// @throws InputError unless the files hold the frames up to `frame`
  void check_resumable(int frame) const;
  void resume(int frame, bool finished);
  void add(int frame);
  void flush();
  /// Finishes the files that grew, and writes a garment as it is now.
  void finish();
  /// Writes the files that are converted from finished caches.
  void make_of_caches();

  [[nodiscard]] std::vector<std::filesystem::path> outputs() const;
  [[nodiscard]] std::vector<WrittenFile> written() const;
  [[nodiscard]] const SurfacePoints& grid() const { return grid_; }
  [[nodiscard]] const Subject& subject() const { return subject_; }
  /// The mesh's own vertices where any format shows them, else the samples.
  [[nodiscard]] const ExportedSurface& shown() const { return surface(on_input_.has_value()); }
  /// Their current positions, in the unit and axes of files.
  [[nodiscard]] std::vector<Vec3f> points() const { return points(on_input_.has_value()); }
  [[nodiscard]] const ExportedSurface& samples() const { return on_image_; }
  /// The file name of the point cache of the samples; empty: there is none.
  [[nodiscard]] std::string image_cache() const { return image_cache_; }

 private:
  struct Writer {
    std::string format;
    bool on_input;
    std::unique_ptr<MotionWriter> files;
  };
  [[nodiscard]] bool shows_input(std::string_view format) const {
    return on_input_.has_value() && is_on_input(format, options_.on);
  }
  [[nodiscard]] const ExportedSurface& surface(bool on_input) const {
    return on_input ? *on_input_ : on_image_;
  }
  [[nodiscard]] std::vector<Vec3f> points(bool on_input) const;
  [[nodiscard]] MotionFrame frame(int number, bool on_input) const {
    return {number, *subject_.now, surface(on_input), points(on_input)};
  }
  [[nodiscard]] MotionPlace place(bool on_input) const;
  void add_writer(const std::string& format, bool on_input);
  void add_writers();
  void write_draped();
  template <class Visit>
  void each_frame(int frame, const Visit& visit) const;

  Subject subject_;
  ExportOptions options_;
  SurfacePoints grid_, sewn_;
  ExportedSurface on_image_;
  std::optional<ExportedSurface> on_input_;  // or the sewn garment
  std::string image_cache_;
  std::vector<Writer> writers_;  // caches first: others are converted from them
  std::vector<WrittenFile> still_;
  std::vector<std::filesystem::path> images_;  // of panels
};

}  // namespace weft
