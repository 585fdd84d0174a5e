#pragma once

#include <filesystem>
#include <memory>

#include "apps/weft/shots.h"
#include "weft/drawing.h"
#include "weft/progress.h"
#include "weft/run_folder.h"

namespace weft::app {

/// A run: cloths and bodies drawn from their images, and the ground.
class RunSubject : public Subject {
 public:
  /// @param size  of the pictures; the rest of the view is the camera's
  /// @throws Error as Renderer
  RunSubject(RunFolder run, const ViewFrom& size);
  [[nodiscard]] int frames() const override { return run_.frames; }
  [[nodiscard]] double frame_rate() const override { return run_.frame_rate; }
  [[nodiscard]] double aspect() const override { return aspect_; }
  void add_to(Outline& outline, int frame) const override;
  /// @throws as RecordedPoints::positions
  Picture draw(int frame, const Camera& camera) override;

 private:
  RunFolder run_;
  double aspect_;
  Renderer renderer_;
};

/// Draws the last frame of a run.
Picture draw_run(const RunFolder& run, const ViewFrom& view);

/// Outline of what a camera has to see over all frames (of long runs, 48 of them).
Outline outline_of(const Subject& subject);

/// Writes all frames as a movie, which appears whole, from one camera that sees them all.
void film_run(const RunFolder& run, const std::filesystem::path& path, const ViewFrom& view,
              Progress* progress);

}  // namespace weft::app
