#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "apps/weft/shots.h"
#include "apps/weft/strain_colours.h"
#include "weft/drawing.h"
#include "weft/progress.h"
#include "weft/run_folder.h"

namespace weft::app {

/// A run: cloths and bodies drawn from their images, and the ground.
class RunSubject : public Subject {
 public:
  /// @param size  of the pictures; the rest of the view is the camera's
  /// @param by_strain  whether cloths are coloured by it, with a legend
  /// @throws Error as Renderer; as StrainColours
  RunSubject(RunFolder run, const ViewFrom& size, bool by_strain = false);
  /// Strain that 99 of 100 samples have at most at a frame. @pre coloured by strain
  [[nodiscard]] double max_strain(int frame) const;
  /// @param strain  in full colour, > 0 @pre coloured by strain
  void set_full_strain(double strain) { strain_->set_full(strain); }
  [[nodiscard]] int frames() const override { return run_.frames; }
  [[nodiscard]] double frame_rate() const override { return run_.frame_rate; }
  [[nodiscard]] double aspect() const override {
    return static_cast<double>(size_.width) / size_.height;
  }
  void add_to(Outline& outline, int frame) const override;
  /// @throws as RecordedPoints::positions
  Picture draw(int frame, const Camera& camera) override;

 private:
  RunFolder run_;
  std::vector<std::vector<char>> cloth_quads_,
      body_quads_;  // how their quads are split, see DrawnSurface
  std::optional<StrainColours> strain_;
  ViewFrom size_;  // without the legend
  Renderer renderer_;
};

/// Draws the last frame of a run.
Picture draw_run(const RunFolder& run, const ViewFrom& view);

/// All frames, of long runs 48 from the first to the last.
std::vector<int> frames_to_look_at(const Subject& subject);
/// Outline of what a camera has to see over all frames.
Outline outline_of(const Subject& subject);

/// Writes all frames as a movie, which appears whole, from one camera that sees them all.
void film_run(const RunFolder& run, const std::filesystem::path& path, const ViewFrom& view,
              Progress* progress);

}  // namespace weft::app
