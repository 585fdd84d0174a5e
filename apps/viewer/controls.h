#pragma once

#include <optional>
#include <vector>

#include "apps/viewer/command_queue.h"
#include "apps/viewer/orbit_camera.h"
#include "apps/viewer/picking.h"
#include "apps/viewer/window.h"

namespace weft::viewer {

/// Requests of the user, by mouse, key or panel.
struct Wishes {
  std::vector<Command> commands{};
  bool close = false;
  bool picture = false;       ///< of the scene alone
  bool whole_window = false;  ///< a picture with everything
  bool frame = false;         ///< show the whole subject
  bool toggle_panel = false;
  bool toggle_image = false;  ///< the geometry image in the panel
};

/// Translates events of mouse and keys into wishes and camera motion.
class Controls {
 public:
  explicit Controls(bool running) : running_(running) {}

  /// Moves the camera at once; adds everything else to the wishes.
  /// @param over_panel  whether the mouse is over something that takes its events
  void handle(const Event& event, const Snapshot& snapshot, OrbitCamera& camera, bool over_panel);
  void play(bool running);
  void step();
  /// Returns the wishes since the last call.
  [[nodiscard]] Wishes take_wishes();

  [[nodiscard]] bool running() const { return running_; }
  /// The sample that the mouse holds.
  [[nodiscard]] const std::optional<ClothHit>& held() const { return held_; }
  [[nodiscard]] Vec2d mouse() const { return at_; }
  [[nodiscard]] const Colouring& colouring() const { return colouring_; }
  void set_colouring(const Colouring& colouring);

 private:
  enum class Drag { none, cloth, orbit, pan };
  void press(const MousePressed& event, const Snapshot& snapshot, const OrbitCamera& camera);
  void release();
  void move(Vec2d at, OrbitCamera& camera);
  void key(const KeyPressed& event);
  template <class Asked>
  void ask(Asked command) {
    wishes_.commands.emplace_back(std::move(command));
  }

  Wishes wishes_;
  bool running_;
  Drag drag_ = Drag::none;
  MouseButton button_ = MouseButton::left;  // the one that drags
  Vec2d at_;
  std::optional<ClothHit> held_;
  Colouring colouring_;
};

}  // namespace weft::viewer
