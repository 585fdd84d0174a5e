#include "apps/viewer/controls.h"

#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace weft::viewer {

Wishes Controls::take_wishes() { return std::exchange(wishes_, {}); }

void Controls::play(bool running) {
  running_ = running;
  ask(Play{running});
}

void Controls::step() {
  running_ = false;
  ask(StepOnce{});
}

void Controls::set_colouring(const Colouring& colouring) {
  if (colouring == colouring_) return;
  colouring_ = colouring;
  ask(Recolour{colouring});
}

void Controls::handle(const Event& event, const Snapshot& snapshot, OrbitCamera& camera,
                      bool over_panel) {
  if (const auto* pressed = std::get_if<MousePressed>(&event)) {
    at_ = pressed->at;
    if (!over_panel && drag_ == Drag::none) press(*pressed, snapshot, camera);
  } else if (const auto* released = std::get_if<MouseReleased>(&event)) {
    move(released->at, camera);
    if (released->button == button_) release();
  } else if (const auto* moved = std::get_if<MouseMoved>(&event)) {
    move(moved->at, camera);
  } else if (const auto* wheel = std::get_if<WheelTurned>(&event)) {
    if (!over_panel) camera.zoom(wheel->steps, wheel->at);
  } else if (const auto* dropped = std::get_if<FileDropped>(&event)) {
    ask(Open{dropped->path});
  } else if (const auto* pressed_key = std::get_if<KeyPressed>(&event)) {
    key(*pressed_key);
  }
}

void Controls::press(const MousePressed& event, const Snapshot& snapshot,
                     const OrbitCamera& camera) {
  button_ = event.button;
  drag_ = event.button == MouseButton::left ? Drag::orbit : Drag::pan;
  if (event.button != MouseButton::left || !snapshot.subject || !snapshot.subject->scene) return;
  held_ = pick_cloth(camera.ray_through(event.at), snapshot);
  if (!held_) return;
  drag_ = Drag::cloth;
  ask(Grab{held_->cloth, held_->sample});
}

void Controls::release() {
  if (drag_ == Drag::cloth) ask(LetGo{});
  held_.reset();
  drag_ = Drag::none;
}

void Controls::move(Vec2d at, OrbitCamera& camera) {
  const Vec2d displacement = at - at_;
  at_ = at;
  if (drag_ == Drag::orbit) camera.orbit(displacement);
  if (drag_ == Drag::pan) camera.pan(displacement);
  if (drag_ == Drag::cloth) ask(Pull{camera.on_facing_plane(at, held_->point)});
}

void Controls::key(const KeyPressed& event) {
  switch (event.key) {
    case GLFW_KEY_SPACE:
      return play(!running_);
    case GLFW_KEY_PERIOD:
      return step();
    case GLFW_KEY_R:
      return ask(Reset{});
    case GLFW_KEY_F:
      wishes_.frame = true;
      return;
    case GLFW_KEY_H:
      wishes_.toggle_panel = true;
      return;
    case GLFW_KEY_I:
      wishes_.toggle_image = true;
      return;
    case GLFW_KEY_S:
      (event.shift ? wishes_.whole_window : wishes_.picture) = true;
      return;
    case GLFW_KEY_C: {
      Colouring next = colouring_;
      next.by =
          static_cast<ColourBy>((static_cast<std::size_t>(next.by) + 1) % colour_names.size());
      return set_colouring(next);
    }
    case GLFW_KEY_ESCAPE:
      wishes_.close = true;
      return;
    default:
      return;
  }
}

}  // namespace weft::viewer
