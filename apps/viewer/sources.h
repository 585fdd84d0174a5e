#pragma once

#include <optional>
#include <vector>

#include "apps/viewer/source.h"
#include "weft/run_folder.h"

namespace weft::viewer {

/// A scene that is simulated.
class SceneSource final : public Source {
 public:
  /// @throws as Simulation
  SceneSource(const Scene& scene, const std::string& name, const SourceMaker& maker);
  /// Continues from the state of another source, whose scene has the same shapes.
  void continue_from(const SceneSource& other);

  [[nodiscard]] double frame_rate() const override;
  [[nodiscard]] int frame() const override { return simulation_.frame(); }
  bool advance() override;
  void reset() override;
  void grab(std::size_t cloth, int sample) override;
  void pull(Vec3d target) override { simulation_.pull(target); }
  void let_go() override { simulation_.let_go(); }
  void show(const Colouring& colouring, Snapshot& snapshot) const override;

 private:
  void colour(const Colouring& colouring, std::size_t cloth, Planes3& colours) const;

  Simulation simulation_;
  SimulationState start_;
  FrameReport report_;
};

/// A recorded run; starts again after its last frame.
class RunSource final : public Source {
 public:
  /// @throws InputError as open_run_folder
  RunSource(const std::string& folder, const SourceMaker& maker);
  [[nodiscard]] double frame_rate() const override { return run_.frame_rate; }
  [[nodiscard]] int frame() const override { return frame_; }
  bool advance() override;
  void reset() override { show_frame(0); }
  void show(const Colouring& colouring, Snapshot& snapshot) const override;

 private:
  void show_frame(int frame);
  void colour(const Colouring& colouring, std::size_t cloth, Planes3& colours) const;

  RunFolder run_;
  std::vector<std::optional<RecordedStrain>> strains_;  // of each cloth, where its rest is known
  int frame_ = 0;
  std::vector<Planes3> cloths_, bodies_;
};

/// A surface that does not move: an image, or a mesh that is converted to one.
class StillSource final : public Source {
 public:
  /// @throws as load_surface
  StillSource(const std::string& name, const SourceMaker& maker);
  void show(const Colouring& colouring, Snapshot& snapshot) const override;
};

/// Colours that depend on the surface only; nothing (size 0) for those that need a simulation.
void colour_surface(const Colouring& colouring, const BorderMates& mates, const Planes3& positions,
                    Planes3& colours);

}  // namespace weft::viewer
