#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/drawing.h"
#include "weft/simulation.h"

struct GLFWwindow;

namespace weft::viewer {

// Small pieces of the panel.

/// A collapsible heading. @return whether it is open
bool begin_section(const char* title);
/// A drop-down list. @param chosen  the name shown, replaced by a choice
/// @param otherwise  shown where `chosen` is empty
/// @return whether another name was chosen
bool choose(const char* label, const std::vector<std::string>& names, std::string& chosen,
            const char* otherwise = "");
/// A line with a name at the left and its value at the right.
void number_line(const char* name, const std::string& value);
/// The title of a legend, and its colour scale with marks where it has one.
void show_legend(const Legend& legend);

std::vector<std::string> strings(std::span<const std::string_view> names);
/// The last part of a path.
std::string short_name(const std::string& path);

/// A context of Dear ImGui on a window, with this program's font and colours. The window's
/// callbacks are kept.
class PanelContext {
 public:
  /// @param scale  of text, 1 on a usual screen
  PanelContext(GLFWwindow* window, double scale);
  PanelContext(const PanelContext&) = delete;
  PanelContext& operator=(const PanelContext&) = delete;
  ~PanelContext();

  static void begin();  ///< begins a frame
  static void draw();   ///< draws the frame
};

/// Plot of the costs of the last frames, stacked by stage.
class StagePlot {
 public:
  /// Adds a frame; the last number again is ignored, a smaller one clears the plot.
  void add(int frame, const FrameReport& report);
  void clear() { count_ = 0; }
  /// Draws the plot at the panel's current position, with its key. @param height  [pixels]
  void show(float height) const;

 private:
  static constexpr std::size_t stages = 4, kept = 120;
  using Costs = std::array<float, stages>;  // [ms]
  [[nodiscard]] const Costs& at(std::size_t i) const {
    return costs_[(next_ + kept - count_ + i) % kept];
  }
  [[nodiscard]] float largest() const;
  [[nodiscard]] Costs usual() const;

  std::array<Costs, kept> costs_{};
  std::size_t next_ = 0, count_ = 0;
  int last_frame_ = -1;
};

}  // namespace weft::viewer
