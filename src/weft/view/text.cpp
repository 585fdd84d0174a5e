#include "weft/view/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>

#include "weft/picture.h"

namespace weft {
namespace {

constexpr int line_height = 12;  // [pixels] at scale 1

/// DejaVu Sans, read once.
class Font {
 public:
  Font() {
    std::ifstream in(WEFT_FONT, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes_.data());
    is_there_ = !bytes_.empty() && stbtt_InitFont(&info_, data, 0) != 0;
  }
  [[nodiscard]] bool is_there() const { return is_there_; }
  [[nodiscard]] const stbtt_fontinfo* info() const { return &info_; }
  /// Pixels a unit of the font. @pre it is there
  [[nodiscard]] float unit(int scale) const {
    return stbtt_ScaleForPixelHeight(&info_, static_cast<float>(line_height * scale));
  }
  /// From a line's upper edge. [pixels]
  [[nodiscard]] int baseline(int scale) const {
    int ascent = 0, descent = 0, gap = 0;
    stbtt_GetFontVMetrics(&info_, &ascent, &descent, &gap);
    return static_cast<int>(std::lround(static_cast<float>(ascent) * unit(scale)));
  }

 private:
  std::vector<char> bytes_;
  stbtt_fontinfo info_{};
  bool is_there_ = false;
};

const Font& font() {
  static const Font only;
  return only;
}

/// The character that begins at a byte; moves `at` behind it.
int next_character(std::string_view text, std::size_t& at) {
  constexpr int replacement = 0xfffd;
  const auto lead = static_cast<unsigned char>(text[at++]);
  if (lead < 0x80) return lead;
  const int more = lead >= 0xf0 && lead < 0xf8   ? 3
                   : lead >= 0xe0 && lead < 0xf0 ? 2
                   : lead >= 0xc2 && lead < 0xe0 ? 1
                                                 : 0;
  if (more == 0) return replacement;
  int character = lead & (0x3f >> more);
  for (int k = 0; k < more; ++k) {
    if (at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xc0) != 0x80)
      return replacement;
    character = character << 6 | (static_cast<unsigned char>(text[at++]) & 0x3f);
  }
  return character;
}

/// Calls visit(character, x) with where each begins, in pixels from the line's left edge.
/// @return where the next would begin
template <class Visit>
float for_characters(std::string_view text, int scale, const Visit& visit) {
  const float unit = font().unit(scale);
  float x = 0;
  int before = 0;
  for (std::size_t at = 0; at < text.size();) {
    const int character = next_character(text, at);
    if (before != 0)
      x += unit *
           static_cast<float>(stbtt_GetCodepointKernAdvance(font().info(), before, character));
    visit(character, x);
    int advance = 0, bearing = 0;
    stbtt_GetCodepointHMetrics(font().info(), character, &advance, &bearing);
    x += unit * static_cast<float>(advance);
    before = character;
  }
  return x;
}

void blend_pixel(Picture& picture, int x, int y, Vec3f colour, float share) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  const std::size_t i = std::size_t{3} * (static_cast<std::size_t>(y) * picture.width + x);
  const Vec3f below = (1.0F / 255) * Vec3f{static_cast<float>(picture.rgb[i]),
                                           static_cast<float>(picture.rgb[i + 1]),
                                           static_cast<float>(picture.rgb[i + 2])};
  set_pixel(picture, x, y, (1 - share) * below + share * colour);
}

/// @param x  [pixels] fractions move the character between pixels  @param baseline  its row
void draw_character(Picture& picture, int character, float x, int baseline, int scale,
                    Vec3f colour) {
  const float unit = font().unit(scale), whole = std::floor(x);
  int left = 0, top = 0, right = 0, bottom = 0;
  stbtt_GetCodepointBitmapBoxSubpixel(font().info(), character, unit, unit, x - whole, 0, &left,
                                      &top, &right, &bottom);
  const int width = right - left, height = bottom - top;
  if (width <= 0 || height <= 0) return;
  std::vector<unsigned char> cover(static_cast<std::size_t>(width) * height);
  stbtt_MakeCodepointBitmapSubpixel(font().info(), cover.data(), width, height, width, unit, unit,
                                    x - whole, 0, character);
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c)
      if (const int share = cover[static_cast<std::size_t>(r) * width + c]; share > 0)
        blend_pixel(picture, static_cast<int>(whole) + left + c, baseline + top + r, colour,
                    static_cast<float>(share) / 255);
}

}  // namespace

bool has_font() { return font().is_there(); }

int text_width(std::string_view text, int scale) {
  if (!has_font()) return static_cast<int>(text.size()) * line_height * scale / 2;
  return static_cast<int>(std::ceil(for_characters(text, scale, [](int, float) {})));
}

int text_height(int scale) { return line_height * scale; }

void draw_text(Picture& picture, std::string_view text, TextPlace place, Vec3f colour) {
  if (!has_font()) return;
  const int baseline = place.y + font().baseline(place.scale);
  for_characters(text, place.scale, [&](int character, float x) {
    draw_character(picture, character, static_cast<float>(place.x) + x, baseline, place.scale,
                   colour);
  });
}

}  // namespace weft
