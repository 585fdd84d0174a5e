#include "bench/plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/picture.h"
#include "weft/view/text.h"

namespace weft::bench {
namespace {

constexpr int width = 960, height = 640, left = 90, right = 210, top = 40, bottom = 60;
constexpr int text_scale = 2, marker = 4;
constexpr Vec3f black{0.1F, 0.1F, 0.1F}, strong{0.7F, 0.7F, 0.7F}, weak{0.9F, 0.9F, 0.9F};

/// One axis: logarithms of what it shows and the pixels that it runs over.
struct Axis {
  double low = HUGE_VAL, high = -HUGE_VAL;
  int from = 0, to = 0;

  void include(double value) {
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  void widen() {
    const double room = 0.05 * std::max(high - low, 0.1);
    low -= room;
    high += room;
  }
  [[nodiscard]] int pixel(double value) const {
    const double share = (std::log10(value) - low) / (high - low);
    return from + static_cast<int>(std::lround(share * (to - from)));
  }
  /// 1, 2 and 5 times the powers of ten within.
  [[nodiscard]] std::vector<double> ticks() const {
    std::vector<double> values;
    for (int power = static_cast<int>(std::floor(low)); power <= high; ++power)
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10.0, power);
        if (std::log10(value) >= low && std::log10(value) <= high) values.push_back(value);
      }
    return values;
  }
};

struct Pixel {
  int x, y;
};

void draw_line(Picture& picture, Pixel a, Pixel b, Vec3f colour) {
  const int steps = std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1});
  for (int i = 0; i <= steps; ++i) {
    const int x = a.x + (b.x - a.x) * i / steps, y = a.y + (b.y - a.y) * i / steps;
    set_pixel(picture, x, y, colour);
    set_pixel(picture, x, y + 1, colour);
  }
}

void draw_marker(Picture& picture, Pixel at, Vec3f colour) {
  for (int y = -marker; y <= marker; ++y)
    for (int x = -marker; x <= marker; ++x)
      if (x * x + y * y <= marker * marker + 1) set_pixel(picture, at.x + x, at.y + y, colour);
}

void draw_ticks(Picture& picture, const Axis& x, const Axis& y) {
  const auto is_power = [](double value) {
    return std::abs(std::log10(value) - std::round(std::log10(value))) < 1e-9;
  };
  for (const double value : x.ticks()) {
    const int at = x.pixel(value);
    draw_line(picture, {at, y.from}, {at, y.to}, is_power(value) ? strong : weak);
    const std::string label = fmt::format("{:g}", value);
    draw_text(picture, label, {at - text_width(label, text_scale) / 2, y.from + 8, text_scale},
              black);
  }
  for (const double value : y.ticks()) {
    const int at = y.pixel(value);
    draw_line(picture, {x.from, at}, {x.to, at}, is_power(value) ? strong : weak);
    const std::string label = fmt::format("{:g}", value);
    draw_text(
        picture, label,
        {x.from - 8 - text_width(label, text_scale), at - text_height(text_scale) / 2, text_scale},
        black);
  }
}

}  // namespace

Picture draw_plot(const Plot& plot) {
  Picture picture = blank_picture(width, height, {1, 1, 1});
  Axis x{HUGE_VAL, -HUGE_VAL, left, width - right}, y{HUGE_VAL, -HUGE_VAL, height - bottom, top};
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) {
      x.include(point.x);
      y.include(point.y);
    }
  x.widen();
  y.widen();
  draw_ticks(picture, x, y);
  draw_text(picture, plot.x_label,
            {(x.from + x.to - text_width(plot.x_label, text_scale)) / 2, height - 26, text_scale},
            black);
  draw_text(picture, plot.y_label, {8, 8, text_scale}, black);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    const Vec3f colour = curve_colour(static_cast<int>(i));
    const auto place = [&](const PlotPoint& point) {
      return Pixel{x.pixel(point.x), y.pixel(point.y)};
    };
    for (std::size_t k = 0; k < series.points.size(); ++k) {
      if (k > 0) draw_line(picture, place(series.points[k - 1]), place(series.points[k]), colour);
      draw_marker(picture, place(series.points[k]), colour);
    }
    const Pixel legend{width - right + 20, top + 14 + 26 * static_cast<int>(i)};
    draw_marker(picture, legend, colour);
    draw_text(picture, series.name, {legend.x + 14, legend.y - 8, text_scale}, black);
  }
  return picture;
}

}  // namespace weft::bench
