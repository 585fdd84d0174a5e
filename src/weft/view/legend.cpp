#include <algorithm>
#include <cmath>

#include "weft/drawing.h"
#include "weft/picture.h"
#include "weft/view/text.h"

namespace weft {
namespace {

constexpr Vec3f paper{1, 1, 1}, ink{0.15F, 0.15F, 0.17F};

int scale_for(int width) { return std::max(1, width / 480); }

}  // namespace

Legend stretch_legend(const std::string& title) {
  return {title,
          [](double place) { return stretch_colour(std::exp2(4 * place - 2)); },
          {{0, "1/4"}, {0.25, "1/2"}, {0.5, "1"}, {0.75, "2"}, {1, "4"}}};
}

Legend amount_legend(const std::string& title, const std::string& largest) {
  return {title, amount_colour, {{0, "0"}, {1, largest}}};
}

int legend_height(int width) { return 38 * scale_for(width); }

void add_legend(Picture& picture, const Legend& legend) {
  const int scale = scale_for(picture.width), height = legend_height(picture.width);
  const int top = picture.height;
  Picture whole = blank_picture(picture.width, top + height, paper);
  paste(whole, picture, 0, 0);
  const int margin = std::max(16 * scale, picture.width / 16);
  const int left = margin, length = picture.width - 2 * margin;
  const auto middle = [&](const std::string& text, int x, int y) {
    draw_text(whole, text, {x - text_width(text, scale) / 2, y, scale}, ink);
  };
  middle(legend.title, picture.width / 2, top + 4 * scale);
  const int bar = top + 15 * scale, bar_height = 9 * scale;
  for (int x = 0; x <= length; ++x)
    for (int y = 0; y < bar_height; ++y)
      set_pixel(whole, left + x, bar + y, legend.colour(static_cast<double>(x) / length));
  for (const Legend::Mark& mark : legend.marks) {
    const int x = left + static_cast<int>(std::lround(mark.place * length));
    for (int y = 0; y < bar_height + 2 * scale; ++y) set_pixel(whole, x, bar + y, ink);
    middle(mark.label, x, bar + bar_height + 4 * scale);
  }
  picture = std::move(whole);
}

}  // namespace weft
