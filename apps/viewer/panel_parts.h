#pragma once

struct GLFWwindow;
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/drawing.h"

namespace weft::viewer {

// Small pieces of the panel.

/// A heading that folds what follows. @return whether it is open
bool begin_section(const char* title);
/// A list to choose from. @param chosen  the name shown, renewed by a choice
/// @param otherwise  shown where it is none of the names
/// @return whether something else was chosen
bool choose(const char* label, const std::vector<std::string>& names, std::string& chosen,
            const char* otherwise = "");
/// A name on the left, its value at the right.
void number_line(const char* name, const std::string& value);
/// The colour scale with its marks, or the sentence alone.
void show_legend(const Legend& legend);

std::vector<std::string> strings(std::span<const std::string_view> names);
/// The last part of a path.
std::string short_name(const std::string& path);

/// Dear ImGui on a window while it lives, dressed for this program. The window's callbacks are
/// kept.
class PanelContext {
 public:
  /// @param scale  how large text shall be, 1 on a usual screen
  PanelContext(GLFWwindow* window, double scale);
  PanelContext(const PanelContext&) = delete;
  PanelContext& operator=(const PanelContext&) = delete;
  ~PanelContext();

  static void begin();  ///< a frame
  static void draw();   ///< what was put into it since
};

}  // namespace weft::viewer
