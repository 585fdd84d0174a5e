#include "weft/param/four_corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace weft {
namespace {

/// The angles of all triangles at each disk vertex together. [rad]
std::vector<double> angles_of(const DiskMesh& disk) {
  std::vector<double> angle(disk.positions.size(), 0.0);
  for (const Triangle& t : disk.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d at = disk.positions[t[k]];
      const Vec3d a = disk.positions[t[(k + 1) % 3]] - at, b = disk.positions[t[(k + 2) % 3]] - at;
      angle[t[k]] += std::atan2(length(cross(a, b)), dot(a, b));
    }
  return angle;
}

bool is_one_free_border(const CutDisk& cut) {
  if (cut.paths.size() != 1) return false;
  const BorderPath& path = cut.paths[0];
  return path.mate < 0 && path.curve < 0 && path.intervals == 0;
}

/// Border vertices that turn by a right angle, give or take; nothing where others turn too.
std::vector<int> sharp_turns(const DiskMesh& disk) {
  constexpr double min_corner = std::numbers::pi / 3, max_elsewhere = std::numbers::pi / 6;
  const std::vector<double> angle = angles_of(disk);
  std::vector<int> corners;
  for (std::size_t b = 0; b < disk.border.size(); ++b) {
    const double turn = std::numbers::pi - angle[disk.border[b]];
    if (turn >= min_corner)
      corners.push_back(static_cast<int>(b));
    else if (std::abs(turn) > max_elsewhere)
      return {};
  }
  return corners;
}

/// Lengths of the sides from each corner to the next.
std::array<double, 4> side_lengths(const DiskMesh& disk, const std::array<int, 4>& corners) {
  const std::size_t size = disk.border.size();
  std::array<double, 4> sides{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t b = corners[k]; b != static_cast<std::size_t>(corners[(k + 1) % 4]);
         b = (b + 1) % size)
      sides[k] +=
          length(disk.positions[disk.border[(b + 1) % size]] - disk.positions[disk.border[b]]);
  return sides;
}

bool is_within(double ratio, double a, double b) {
  return std::max(a, b) <= ratio * std::min(a, b);
}

/// A curved strip has need of more samples along than across, and so of a map that turns them.
bool fit_a_chart(const DiskMesh& disk, const std::array<double, 4>& sides) {
  constexpr double max_taper = 8, max_aspect = 2, max_aspect_of_flat = 12;
  const double aspect = (sides[0] + sides[2]) / (sides[1] + sides[3]);
  const bool has_aspect = is_within(max_aspect, aspect, 1) ||
                          (is_within(max_aspect_of_flat, aspect, 1) && is_flat(disk));
  return has_aspect && is_within(max_taper, sides[0], sides[2]) &&
         is_within(max_taper, sides[1], sides[3]);
}

}  // namespace

bool is_flat(const DiskMesh& disk) {
  constexpr double min_part = 0.999;
  Vec3d sum;
  double area = 0;
  for (const auto& [a, b, c] : disk.triangles) {
    const Vec3d own =
        cross(disk.positions[b] - disk.positions[a], disk.positions[c] - disk.positions[a]);
    sum += own;
    area += length(own);
  }
  return length(sum) >= min_part * area;
}

std::optional<std::array<int, 4>> four_corners(const CutDisk& cut) {
  if (!is_one_free_border(cut)) return std::nullopt;
  const std::vector<int> turns = sharp_turns(cut.disk);
  if (turns.size() != 4) return std::nullopt;
  const std::array<int, 4> corners{turns[0], turns[1], turns[2], turns[3]};
  if (!fit_a_chart(cut.disk, side_lengths(cut.disk, corners))) return std::nullopt;
  return corners;
}

CutDisk parted_at(const std::array<int, 4>& corners, CutDisk cut, ChartSize size) {
  const std::array<double, 4> sides = side_lengths(cut.disk, corners);
  const auto vertex = [&](std::size_t k) { return cut.disk.border[corners[k]]; };
  std::size_t first = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (vertex(k) < vertex(first)) first = k;
  const bool wide =
      sides[first] + sides[(first + 2) % 4] > sides[(first + 1) % 4] + sides[(first + 3) % 4];
  if (!size.is_square() && wide != (size.cols > size.rows)) first = (first + 1) % 4;
  const BorderPath whole = cut.paths[0];
  const auto border = static_cast<int>(cut.disk.border.size());
  cut.paths.clear();
  for (std::size_t k = 0; k < 4; ++k) {
    const int from = corners[(first + k) % 4], to = corners[(first + k + 1) % 4];
    BorderPath side = whole;
    side.first = from;
    side.edges = (to - from + border) % border;
    side.intervals = (k % 2 == 0 ? size.cols : size.rows) - 1;
    cut.paths.push_back(side);
  }
  return cut;
}

}  // namespace weft
