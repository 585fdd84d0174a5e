#include "weft/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>

#include <png.h>

#include "weft/core/math.h"
#include "weft/drawing.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/view/text.h"

namespace weft {

namespace {

/// Larger than any screen or poster; limits the memory that a corrupt header can request.
constexpr std::size_t max_pixels = std::size_t{1} << 28U;

/// The libpng state of one picture; the simplified interface reports errors by value, without
/// longjmp.
struct PngImage {
  png_image state{};
  PngImage() { state.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&state); }
};

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::size_t bytes = std::size_t{3} * picture.width * picture.height;
  if (picture.width < 1 || picture.height < 1 || picture.rgb.size() != bytes)
    throw OutputError(path.string(), "a picture without pixels",
                      "at least one row and column is wanted");
  PngImage image;
  image.state.width = static_cast<png_uint_32>(picture.width);
  image.state.height = static_cast<png_uint_32>(picture.height);
  image.state.format = PNG_FORMAT_RGB;
  std::string packed(PNG_IMAGE_PNG_SIZE_MAX(image.state), '\0');
  png_alloc_size_t used = packed.size();
  if (png_image_write_to_memory(&image.state, packed.data(), &used, 0, picture.rgb.data(), 0,
                                nullptr) == 0)
    throw OutputError(path.string(), image.state.message, "another size is wanted");
  packed.resize(used);
  write_file(path, [&](std::ostream& out) { out << packed; });
}

Picture read_png(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  PngImage image;
  if (png_image_begin_read_from_memory(&image.state, bytes.data(), bytes.size()) == 0)
    throw InputError(path.string(), image.state.message, "a PNG picture is wanted");
  if (std::size_t{image.state.width} * image.state.height > max_pixels)
    throw InputError(path.string(), "more than 2^28 pixels", "a smaller picture is wanted");
  image.state.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(image.state.width), static_cast<int>(image.state.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(image.state));
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&image.state, &black, picture.rgb.data(), 0, nullptr) == 0)
    throw InputError(path.string(), image.state.message, "a whole PNG picture is wanted");
  return picture;
}

namespace {

/// The colour at a position on a ramp, whose stops are evenly spaced over [0, 1].
template <std::size_t Count>
Vec3f on_ramp(const std::array<Vec3f, Count>& stops, double place) {
  const double at = std::clamp(place, 0.0, 1.0) * (Count - 1);
  const auto k = std::min(static_cast<std::size_t>(at), Count - 2);
  return stops[k] + static_cast<float>(at - static_cast<double>(k)) * (stops[k + 1] - stops[k]);
}

}  // namespace

Vec3f stretch_colour(double stretch) {
  static constexpr std::array<Vec3f, 5> stops{{{0.10F, 0.25F, 0.62F},
                                               {0.45F, 0.66F, 0.90F},
                                               {0.96F, 0.96F, 0.94F},
                                               {0.95F, 0.58F, 0.38F},
                                               {0.66F, 0.07F, 0.10F}}};
  return on_ramp(stops, 0.5 + std::log2(std::max(stretch, 1e-9)) / 4);
}

Vec3f amount_colour(double share) {
  static constexpr std::array<Vec3f, 5> stops{{{0.99F, 0.97F, 0.85F},
                                               {0.99F, 0.80F, 0.42F},
                                               {0.93F, 0.46F, 0.20F},
                                               {0.70F, 0.13F, 0.22F},
                                               {0.27F, 0.02F, 0.20F}}};
  return on_ramp(stops, share);
}

Vec3f curve_colour(int index) {
  // Hues a golden section apart, in three levels of brightness.
  const double turn = 2 * pi * 0.6180339887 * index;
  const double bright = 0.52 + 0.13 * (index % 3 - 1);
  const auto channel = [&](double phase) {
    return static_cast<float>(std::clamp(bright + 0.42 * cosine(turn - phase), 0.0, 1.0));
  };
  return {channel(0), channel(2 * pi / 3), channel(4 * pi / 3)};
}

Vec3f linear_light(Vec3f display) {
  return {display.x * display.x, display.y * display.y, display.z * display.z};
}

void set_pixel(Picture& picture, int x, int y, Vec3f colour) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + x);
  const std::array channels{colour.x, colour.y, colour.z};
  for (int k = 0; k < 3; ++k)
    picture.rgb[at + k] =
        static_cast<std::uint8_t>(std::lround(std::clamp(channels[k], 0.0F, 1.0F) * 255));
}

Picture blank_picture(int width, int height, Vec3f colour) {
  Picture picture{width, height, {}};
  picture.rgb.resize(std::size_t{3} * width * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) set_pixel(picture, x, y, colour);
  return picture;
}

void paste(Picture& picture, const Picture& part, int x, int y) {
  for (int row = std::max(0, -y); row < std::min(part.height, picture.height - y); ++row) {
    const int first = std::max(0, -x), last = std::min(part.width, picture.width - x);
    if (first >= last) return;
    const auto from = part.rgb.begin() + std::ptrdiff_t{3} * (row * part.width + first);
    std::copy(from, from + std::ptrdiff_t{3} * (last - first),
              picture.rgb.begin() + std::ptrdiff_t{3} * ((y + row) * picture.width + x + first));
  }
}

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
namespace {

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

int legend_height(int width) { return 44 * scale_for(width); }

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
  middle(legend.title, picture.width / 2, top + 3 * scale);
  const int bar = top + 17 * scale, bar_height = 9 * scale;
  for (int x = 0; x <= length; ++x)
    for (int y = 0; y < bar_height; ++y)
      set_pixel(whole, left + x, bar + y, legend.colour(static_cast<double>(x) / length));
  for (const Legend::Mark& mark : legend.marks) {
    const int x = left + static_cast<int>(std::lround(mark.place * length));
    for (int y = 0; y < bar_height + 2 * scale; ++y) set_pixel(whole, x, bar + y, ink);
    middle(mark.label, x, bar + bar_height + 3 * scale);
  }
  picture = std::move(whole);
}

}  // namespace weft
