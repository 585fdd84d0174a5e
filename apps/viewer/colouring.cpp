#include "apps/viewer/colouring.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "weft/camera.h"
#include "weft/picture.h"

namespace weft::viewer {
namespace {

constexpr Vec3f pale{0.80F, 0.80F, 0.78F}, dark{0.20F, 0.21F, 0.23F};        // display
constexpr Vec3f touching{0.85F, 0.16F, 0.10F}, folded{0.95F, 0.62F, 0.10F};  // display
/// Strain shown in full colour where a material has no strain limit.
constexpr double usual_limit = 0.05;
/// Powers of ten of the residual that the scale covers.
constexpr double residual_decades = 6;
/// Width of the band that shows mates: 1 / band_part of the side, at least min_band samples.
constexpr int band_part = 32, min_band = 2;

void fit(Planes3& colours, int n) {
  if (colours.size() != n) colours = Planes3(n);
}

void fill(Planes3& colours, Vec3f display) {
  const Vec3f light = linear_light(display);
  for (Grid<float>* plane : {&colours.x, &colours.y, &colours.z})
    plane->fill(plane == &colours.x ? light.x : plane == &colours.y ? light.y : light.z);
}

double full_strain(double limit) { return limit > 0 ? limit : usual_limit; }

/// Longest side of the box; 1 for a point.
double side_of(const Box3d& box) {
  const Vec3d e = box.extent();
  const double side = std::max({e.x, e.y, e.z});
  return side > 0 ? side : 1;
}

}  // namespace

void colour_strain(const Grid<float>& strains, double limit, Planes3& colours) {
  fit(colours, strains.rows());
  const double full = full_strain(limit);
  for (int r = 0; r < colours.size(); ++r)
    for (int c = 0; c < colours.size(); ++c)
      colours.set(r, c, linear_light(stretch_colour(std::exp2(2 * double{strains(r, c)} / full))));
}

void colour_residual(const Grid<float>& corrections, Planes3& colours) {
  fit(colours, corrections.rows());
  for (int r = 0; r < colours.size(); ++r)
    for (int c = 0; c < colours.size(); ++c) {
      const double decades = std::log10(std::max(1e-30, double{corrections(r, c)}));
      const double share = std::clamp(1 + decades / residual_decades, 0.0, 1.0);
      colours.set(r, c, linear_light(amount_colour(share)));
    }
}

void colour_contacts(std::span<const Contact> contacts, int size, Planes3& colours) {
  fit(colours, size);
  fill(colours, pale);
  for (const Contact& contact : contacts) {
    float sum = 0;
    for (const float weight : contact.weights) sum += weight;
    const Vec3f light = linear_light(sum > 0.5F ? touching : folded);
    for (std::size_t k = 0; k < contact.samples.size(); ++k)
      if (contact.weights[k] != 0) colours.set(contact.samples[k], light);
  }
}

void colour_mates(const BorderMates& mates, Planes3& colours) {
  const int n = mates.size(), steps = 4 * (n - 1);
  fit(colours, n);
  fill(colours, pale);
  std::vector<int> pair(static_cast<std::size_t>(steps), -1);
  for (std::size_t i = 0; i < mates.intervals().size(); ++i) {
    const MateInterval& run = mates.intervals()[i];
    for (int k = 0; k <= run.count; ++k) {
      pair[(run.first + k) % steps] = static_cast<int>(i);
      pair[(run.mate - k + steps) % steps] = static_cast<int>(i);
    }
  }
  const int band = std::max(min_band, (n - 1) / band_part);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      // The border position that lies straight outwards on the nearest side.
      const std::array<int, 4> away{r, n - 1 - c, n - 1 - r, c};
      const auto side = std::min_element(away.begin(), away.end());
      if (*side >= band) continue;
      const std::array<int, 4> along{c, (n - 1) + r, 2 * (n - 1) + (n - 1 - c),
                                     3 * (n - 1) + (n - 1 - r)};
      const int number = pair[along[side - away.begin()] % steps];
      colours.set(r, c, linear_light(number < 0 ? dark : curve_colour(number)));
    }
}

void colour_mip(int level, int size, Planes3& colours) {
  fit(colours, size);
  const int kinds = 5;
  for (int r = 0; r < size; ++r)
    for (int c = 0; c < size; ++c) {
      const int row = std::min(r, size - 2) >> level, col = std::min(c, size - 2) >> level;
      const Vec3f own = curve_colour((3 * row + col) % kinds);
      const float share = (row + col) % 2 == 0 ? 0.75F : 0.25F;
      colours.set(r, c, linear_light(share * own + (1 - share) * Vec3f{1, 1, 1}));
    }
}

void colour_stretch(const Planes3& positions, Planes3& colours) {
  const int n = positions.size();
  fit(colours, n);
  Grid<float> step(n, n);
  double squares = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const int up = std::max(r - 1, 0), down = std::min(r + 1, n - 1);
      const int left = std::max(c - 1, 0), right = std::min(c + 1, n - 1);
      const Vec3f u = (1.0F / static_cast<float>(right - left)) *
                      (positions.at(r, right) - positions.at(r, left));
      const Vec3f v =
          (1.0F / static_cast<float>(down - up)) * (positions.at(down, c) - positions.at(up, c));
      const float squared = 0.5F * (squared_length(u) + squared_length(v));
      step(r, c) = squared;
      squares += double{squared} / (double{1} * n * n);
    }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      colours.set(r, c,
                  linear_light(stretch_colour(
                      std::sqrt(std::max(1e-12, step(r, c) / std::max(squares, 1e-30))))));
}

void colour_positions(const Planes3& positions, Planes3& colours) {
  fit(colours, positions.size());
  const Box3d box = bounds(positions);
  const double scale = 1 / side_of(box);
  for (int r = 0; r < positions.size(); ++r)
    for (int c = 0; c < positions.size(); ++c) {
      const Vec3d cube = scale * (vec_cast<double>(positions.at(r, c)) - box.lower);
      colours.set(r, c, linear_light(vec_cast<float>(cube)));
    }
}

Legend legend_of(const Colouring& colouring, double limit) {
  Legend legend;
  const auto percent = [](double part) { return fmt::format("{:+.3g} %", 100 * part); };
  switch (colouring.by) {
    case ColourBy::strain:
      legend.title = "stretch springs, mean at each sample";
      legend.colour = [](double place) { return stretch_colour(std::exp2(4 * place - 2)); };
      legend.marks = {
          {0, percent(-full_strain(limit))}, {0.5, "0"}, {1, percent(full_strain(limit))}};
      return legend;
    case ColourBy::residual:
      legend.title = "last correction, in sample spacings";
      legend.colour = amount_colour;
      legend.marks = {{0, "1e-6"}, {0.5, "1e-3"}, {1, "1"}};
      return legend;
    case ColourBy::stretch:
      legend.title = "step of the image, in mean steps";
      legend.colour = [](double place) { return stretch_colour(std::exp2(4 * place - 2)); };
      legend.marks = {{0, "1/4"}, {0.5, "1"}, {1, "4"}};
      return legend;
    case ColourBy::contacts:
      legend.title = "red: touches bodies or ground; yellow: touches cloth";
      return legend;
    case ColourBy::mates:
      legend.title = "one colour for both sides of a seam; dark: open border";
      return legend;
    case ColourBy::mip:
      legend.title = fmt::format("one cell: a texel of level {}, {} samples wide", colouring.level,
                                 1 << colouring.level);
      return legend;
    case ColourBy::positions:
      legend.title = "red, green, blue: x, y, z";
      return legend;
    case ColourBy::plain:
      break;
  }
  return legend;
}

}  // namespace weft::viewer
