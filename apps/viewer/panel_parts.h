#pragma once

struct GLFWwindow;
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/drawing.h"

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

}  // namespace weft::viewer
