#include "apps/figures/panels.h"

#include <algorithm>

#include "weft/view/palette.h"
#include "weft/view/text.h"

namespace weft::figures {
namespace {

constexpr int gap = 14, text_scale = 2;
constexpr Vec3f paper{1, 1, 1}, ink{0.15F, 0.15F, 0.17F};

}  // namespace

Picture in_a_row(const std::vector<Panel>& panels) {
  int width = gap * (static_cast<int>(panels.size()) - 1), height = 0;
  for (const Panel& panel : panels) {
    width += panel.picture.width;
    height = std::max(height, panel.picture.height);
  }
  Picture row = blank_picture(width, height + text_height(text_scale) + gap, paper);
  int x = 0;
  for (const Panel& panel : panels) {
    paste(row, panel.picture, x, 0);
    const int indent = (panel.picture.width - text_width(panel.label, text_scale)) / 2;
    draw_text(row, panel.label, {x + indent, height + gap / 2, text_scale}, ink);
    x += panel.picture.width + gap;
  }
  return row;
}

Picture in_a_column(const std::vector<Picture>& pictures) {
  int width = 0, height = gap * (static_cast<int>(pictures.size()) - 1);
  for (const Picture& picture : pictures) {
    width = std::max(width, picture.width);
    height += picture.height;
  }
  Picture column = blank_picture(width, height, paper);
  int y = 0;
  for (const Picture& picture : pictures) {
    paste(column, picture, (width - picture.width) / 2, y);
    y += picture.height + gap;
  }
  return column;
}

Picture draw_on_white(SurfaceDrawing drawing, const ViewFrom& view) {
  drawing.on_white = true;
  return draw_surface(drawing, view);
}

}  // namespace weft::figures
