#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "weft/drawing.h"
#include "weft/error.h"

namespace weft {
namespace {

/// Columns of a 3 x 3 matrix.
using Matrix3 = std::array<Vec3f, 3>;

/// Tangents along u and v, and the unit normal.
struct Frame {
  Vec3f u, v, normal;
};

Frame frame_at(const Planes3& grid, const Chart& chart, int row, int col) {
  const int last_row = chart.row + chart.rows - 1, last_col = chart.col + chart.cols - 1;
  Frame frame;
  frame.u = grid.at(row, std::min(col + 1, last_col)) - grid.at(row, std::max(col - 1, chart.col));
  frame.v = grid.at(std::min(row + 1, last_row), col) - grid.at(std::max(row - 1, chart.row), col);
  frame.normal = normalized(cross(frame.u, frame.v));
  return frame;
}

Vec3f times(const Matrix3& m, Vec3f v) { return v.x * m[0] + v.y * m[1] + v.z * m[2]; }

/// The inverse transpose of the linear map from one frame to the other; all zero where a frame has
/// no area.
Matrix3 normal_map_of(const Frame& from, const Frame& to) {
  const Vec3f area = cross(to.u, to.v);
  const float size = dot(area, to.normal);
  if (!(size > 0) || !(squared_length(from.normal) > 0)) return {};
  const Vec3f along_u = (1 / size) * cross(to.v, to.normal);
  const Vec3f along_v = (1 / size) * cross(to.normal, to.u);
  const auto column = [&](float u, float v, float n) {
    return u * along_u + v * along_v + n * to.normal;
  };
  return {column(from.u.x, from.v.x, from.normal.x), column(from.u.y, from.v.y, from.normal.y),
          column(from.u.z, from.v.z, from.normal.z)};
}

/// A position between two of `count` samples of a row or a column.
struct Between {
  int first = 0, second = 0;
  float share = 0;  // weight of the second
};
Between between(double at, int begin, int count) {
  const int first = std::clamp(static_cast<int>(at), begin, begin + std::max(0, count - 2));
  return {first, std::min(first + 1, begin + count - 1), static_cast<float>(at - first)};
}

class Carrying {
 public:
  Carrying(const Planes3& rest, const NormalMap& normals, const Planes3& moved,
           const BorderMates* mates);
  NormalMap run();

 private:
  void map_samples(const Chart& chart);
  void join(std::span<const int> mates);
  void carry(const Chart& chart, NormalMap& carried) const;
  [[nodiscard]] Vec3f carried(const Chart& chart, const Between& down, const Between& across,
                              Vec3f before) const;

  const Planes3 &rest_, &moved_;
  const NormalMap& before_;
  const BorderMates* mates_;  // null: one chart, of which nothing is joined
  std::vector<Chart> charts_;
  double samples_a_texel_;
  std::vector<Matrix3> maps_;  // [n * n]
};

Carrying::Carrying(const Planes3& rest, const NormalMap& normals, const Planes3& moved,
                   const BorderMates* mates)
    : rest_(rest),
      moved_(moved),
      before_(normals),
      mates_(mates != nullptr && mates->size() == rest.size() ? mates : nullptr),
      samples_a_texel_((rest.size() - 1.0) / (normals.size() - 1.0)),
      maps_(static_cast<std::size_t>(rest.size()) * rest.size()) {
  if (mates_ != nullptr)
    charts_ = mates_->charts();
  else
    charts_.push_back({"", 0, 0, rest.size(), rest.size()});
}

NormalMap Carrying::run() {
  for (const Chart& chart : charts_) map_samples(chart);
  if (mates_ != nullptr)
    for (int k = 0; k < mates_->class_count(); ++k) join(mates_->copies(k));
  NormalMap carried{Planes3(before_.size())};
  carried.normal.y.fill(1);
  for (const Chart& chart : charts_) carry(chart, carried);
  return carried;
}

void Carrying::map_samples(const Chart& chart) {
  for (int r = chart.row; r < chart.row + chart.rows; ++r)
    for (int c = chart.col; c < chart.col + chart.cols; ++c)
      maps_[static_cast<std::size_t>(r) * rest_.size() + c] =
          normal_map_of(frame_at(rest_, chart, r, c), frame_at(moved_, chart, r, c));
}

/// The maps are of directions in the world, so that those of mates have a mean.
void Carrying::join(std::span<const int> mates) {
  Matrix3 sum{};
  for (const int s : mates)
    for (int k = 0; k < 3; ++k) sum[k] += maps_[s][k];
  for (const int s : mates) maps_[s] = sum;
}

void Carrying::carry(const Chart& chart, NormalMap& carried) const {
  // Texels of a chart are those that lie on it, a rounding aside.
  const auto texels = [&](int first, int count) {
    constexpr double little = 1e-6;
    return std::array{
        static_cast<int>(std::ceil(first / samples_a_texel_ - little)),
        static_cast<int>(std::floor((first + count - 1) / samples_a_texel_ + little))};
  };
  const auto [top, bottom] = texels(chart.row, chart.rows);
  const auto [left, right] = texels(chart.col, chart.cols);
  for (int r = top; r <= bottom; ++r) {
    const Between down = between(r * samples_a_texel_, chart.row, chart.rows);
    for (int c = left; c <= right; ++c) {
      const Between across = between(c * samples_a_texel_, chart.col, chart.cols);
      carried.normal.set(r, c, this->carried(chart, down, across, before_.normal.at(r, c)));
    }
  }
}

Vec3f Carrying::carried(const Chart& chart, const Between& down, const Between& across,
                        Vec3f before) const {
  const auto at = [&](int row, int col) {
    return normalized(times(maps_[static_cast<std::size_t>(row) * rest_.size() + col], before));
  };
  const auto along = [&](int row) {
    return (1 - across.share) * at(row, across.first) + across.share * at(row, across.second);
  };
  const Vec3f after =
      normalized((1 - down.share) * along(down.first) + down.share * along(down.second));
  if (squared_length(after) > 0) return after;
  return frame_at(moved_, chart, down.first, across.first).normal;
}

}  // namespace

NormalMap carried_normals(const Planes3& rest, const NormalMap& normals, const Planes3& moved,
                          const BorderMates* mates) {
  if (moved.size() != rest.size() || rest.size() < 2 || normals.size() < 2)
    throw UsageError("normals of a moved surface", "grids of different sizes",
                     "the same samples before and after are wanted");
  return Carrying(rest, normals, moved, mates).run();
}

}  // namespace weft
