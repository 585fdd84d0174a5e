#pragma once

#include <optional>
#include <string>

#include "apps/viewer/controls.h"
#include "apps/viewer/panel_parts.h"

namespace weft::viewer {

/// Input that the panel shows.
struct PanelInput {
  const Snapshot& snapshot;
  const Status& status;
  unsigned image_texture = 0;  ///< of OpenGL: the geometry image; 0: none
  double draw_ms = 0;          ///< the window's own work
};

/// The panel at the left, the status line at the bottom and the mark of the grabbed point. Changes
/// of the user go to the controls or into the wishes.
class Panel {
 public:
  explicit Panel(double scale) : scale_(static_cast<float>(scale)) {}

  /// Adds everything to the current frame of ImGui.
  /// @return what was requested by buttons
  Wishes show(const PanelInput& input, Controls& controls);
  /// Marks a grabbed point, and draws a line from it to the mouse. [pixels]
  void mark(Vec2d held, Vec2d mouse) const;
  void remember(const Snapshot& snapshot);  ///< for the plot

  void toggle() { visible_ = !visible_; }
  void toggle_image() { shows_image_ = !shows_image_; }
  [[nodiscard]] bool shows_image() const { return visible_ && shows_image_; }
  /// Width that the panel covers at the window's left, in window coordinates.
  [[nodiscard]] int covered() const;
  /// Whether the panel takes mouse events at a point. @param at  in window coordinates
  [[nodiscard]] bool takes_mouse(Vec2d at) const;

 private:
  void show_head(const PanelInput& input, Controls& controls, Wishes& wishes);
  void show_scene(Wishes& wishes);
  void show_methods(Wishes& wishes);
  void show_wind(Wishes& wishes);
  void show_bodies(const PanelInput& input, Wishes& wishes);
  void show_colours(const PanelInput& input, Controls& controls);
  void show_numbers(const PanelInput& input) const;
  void show_image(const PanelInput& input);
  void show_bottom_line(const PanelInput& input) const;
  void show_loading(const PanelInput& input) const;
  void follow(const PanelInput& input);
  void change(Wishes& wishes, const std::string& what) const;

  float scale_;
  bool visible_ = true, shows_image_ = true;
  std::optional<Scene> edited_;  // the scene with what is being changed
  std::uint64_t subject_ = 0;    // number of the subject of `edited_`
  StagePlot plot_;
};

}  // namespace weft::viewer
