#include <algorithm>

#include "weft/picture.h"
#include "weft/view/text.h"

namespace weft {
namespace {

constexpr Vec3f paper{1, 1, 1}, ink{0.15F, 0.15F, 0.17F};

}  // namespace

int label_height(int text_scale) { return text_height(text_scale) + panel_gap; }

Picture in_a_row(const std::vector<Panel>& panels, int text_scale) {
  int width = panel_gap * (static_cast<int>(panels.size()) - 1), height = 0;
  for (const Panel& panel : panels) {
    width += panel.picture.width;
    height = std::max(height, panel.picture.height);
  }
  const bool labelled = std::any_of(panels.begin(), panels.end(),
                                    [](const Panel& panel) { return !panel.label.empty(); });
  Picture row = blank_picture(width, height + (labelled ? label_height(text_scale) : 0), paper);
  int x = 0;
  for (const Panel& panel : panels) {
    paste(row, panel.picture, x, (height - panel.picture.height) / 2);
    const int indent = (panel.picture.width - text_width(panel.label, text_scale)) / 2;
    draw_text(row, panel.label, {x + indent, height + panel_gap / 2, text_scale}, ink);
    x += panel.picture.width + panel_gap;
  }
  return row;
}

Picture in_a_column(const std::vector<Picture>& pictures) {
  int width = 0, height = panel_gap * (static_cast<int>(pictures.size()) - 1);
  for (const Picture& picture : pictures) {
    width = std::max(width, picture.width);
    height += picture.height;
  }
  Picture column = blank_picture(width, height, paper);
  int y = 0;
  for (const Picture& picture : pictures) {
    paste(column, picture, (width - picture.width) / 2, y);
    y += picture.height + panel_gap;
  }
  return column;
}

}  // namespace weft
