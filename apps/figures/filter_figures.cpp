#include <algorithm>
#include <cmath>

#include "apps/figures/figures.h"
#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/neighbours.h"
#include "weft/picture.h"

namespace weft::figures {
namespace {

constexpr int size = 33;       // n
constexpr int patch_size = 9;  // n_l
constexpr int nodes = 9;       // n_g
constexpr int step = (size - 1) / (nodes - 1);
/// h^2 k / m of neighbouring particles: how far one step carries a force.
constexpr double reach = 3;
constexpr int cell = 7;  // [pixels]

/// Weights of all particles of a grid, one plane.
using Weights = std::vector<double>;

/// A row of W for a grid of particles of equal mass, joined as those of the cloth are.
Weights filter_row(int side, double mass, int row, int col) {
  FilterGrid grid;
  grid.size = side;
  for (int s = 0; s < side * side; ++s) grid.particle_of.push_back(s);
  grid.mass.assign(grid.particle_of.size(), mass);
  grid.time_step = 1;
  for (int d = 0; d < spring_directions; ++d) {
    grid.stiffness[d] = Grid<double>(side, side);
    const auto [down, right] = spring_offsets[d];
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c) {
        const bool inside = r + down < side && c + right >= 0 && c + right < side;
        grid.stiffness[d](r, c) = inside ? reach : 0;
      }
  }
  ThreadTeam team(1);
  const Grid<float> filter = filter_matrix(grid, team);
  Weights weights;
  for (int s = 0; s < side * side; ++s) weights.push_back(filter(row * side + col, s));
  return weights;
}

/// Weights of the patch around a particle, at their places in the cloth.
Weights local_weights(int row, int col) {
  const auto first = [](int i) { return std::clamp(i - patch_size / 2, 0, size - patch_size); };
  const int top = first(row), left = first(col);
  const Weights patch = filter_row(patch_size, 1, row - top, col - left);
  Weights weights(static_cast<std::size_t>(size) * size, 0);
  for (int r = 0; r < patch_size; ++r)
    for (int c = 0; c < patch_size; ++c)
      weights[(top + r) * size + left + c] = patch[r * patch_size + c];
  return weights;
}

/// Response of every particle to a force at a coarse one: W_g at nodes, bilinear between them.
Weights global_weights(int row, int col) {
  const Weights coarse = filter_row(nodes, step * step, row / step, col / step);
  Weights weights;
  for (int r = 0; r < size; ++r)
    for (int c = 0; c < size; ++c) {
      const int i = std::min(r / step, nodes - 2), j = std::min(c / step, nodes - 2);
      const double v = static_cast<double>(r - i * step) / step;
      const double u = static_cast<double>(c - j * step) / step;
      const auto at = [&](int down, int right) { return coarse[(i + down) * nodes + j + right]; };
      weights.push_back((1 - v) * ((1 - u) * at(0, 0) + u * at(0, 1)) +
                        v * ((1 - u) * at(1, 0) + u * at(1, 1)));
    }
  return weights;
}

/// Draws each weight by the square root of its part of the largest; grid nodes as dots.
Picture draw_weights(const Weights& weights, bool with_nodes) {
  const double largest = *std::max_element(weights.begin(), weights.end());
  Picture picture = blank_picture(size * cell, size * cell, {1, 1, 1});
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const int r = y / cell, c = x / cell;
      const double share = std::sqrt(std::max(0.0, weights[r * size + c] / largest));
      const bool on_node = with_nodes && r % step == 0 && c % step == 0 &&
                           std::abs(y % cell - cell / 2) <= 1 && std::abs(x % cell - cell / 2) <= 1;
      set_pixel(picture, x, y, on_node ? Vec3f{0.1F, 0.3F, 0.6F} : amount_colour(0.9 * share));
    }
  return picture;
}

}  // namespace

void draw_filters(const std::filesystem::path& folder) {
  constexpr int middle = size / 2;
  write_png(folder / "filters.png",
            in_a_row({{draw_weights(local_weights(middle, middle), false), "(a) local"},
                      {draw_weights(local_weights(2, 5), false), "at a border"},
                      {draw_weights(global_weights(middle, middle), true), "(b) global"},
                      {draw_weights(filter_row(size, 1, middle, middle), false), "exact"}}));
}

}  // namespace weft::figures
