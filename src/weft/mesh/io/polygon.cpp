#include "weft/mesh/io/polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "weft/core/orientation.h"
#include "weft/error.h"

namespace weft {
namespace {

std::vector<Triangle> fan_of(int corners) {
  std::vector<Triangle> fan;
  for (int i = 2; i < corners; ++i) fan.push_back({0, i - 1, i});
  return fan;
}

/// Of a polygon twice its area vector.
Vec3d normal_of(std::span<const Vec3d> corners) {
  Vec3d sum;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum = sum + cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

bool fan_covers(std::span<const Vec3d> corners, Vec3d normal) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    if (!(dot(cross(corners[i - 1] - corners[0], corners[i] - corners[0]), normal) > 0))
      return false;
  return true;
}

/// The corners seen along the axis that is nearest to a normal, counter-clockwise.
std::vector<Vec2d> seen_along(Vec3d normal, std::span<const Vec3d> corners) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  std::vector<Vec2d> seen;
  for (const Vec3d p : corners)
    seen.push_back(x >= y && x >= z ? Vec2d{p.y, p.z} : y >= z ? Vec2d{p.z, p.x} : Vec2d{p.x, p.y});
  const double along = x >= y && x >= z ? normal.x : y >= z ? normal.y : normal.z;
  if (along < 0)
    for (Vec2d& p : seen) p.x = -p.x;
  return seen;
}

class EarCutter {
 public:
  explicit EarCutter(std::vector<Vec2d> corners) : corners_(std::move(corners)) {
    for (int i = 0; i < static_cast<int>(corners_.size()); ++i) left_.push_back(i);
  }

  /// @return nothing where the polygon crosses itself
  std::vector<Triangle> cut() {
    while (left_.size() > 3)
      if (!cut_ear(1) && !cut_ear(0)) return {};
    if (turn_at(1) < 0) return {};
    ears_.push_back({left_[0], left_[1], left_[2]});
    return std::move(ears_);
  }

 private:
  [[nodiscard]] int around(std::size_t k) const { return left_[k % left_.size()]; }
  [[nodiscard]] int turn_at(std::size_t k) const {
    return orientation(corners_[around(k + left_.size() - 1)], corners_[around(k)],
                       corners_[around(k + 1)]);
  }

  /// Cuts off the next corner that turns left, or with `turn` 0 one that lies on the line of its
  /// neighbours: triangles without area come last.
  bool cut_ear(int turn) {
    for (std::size_t tries = 0; tries < left_.size(); ++tries, ++next_) {
      const std::size_t k = next_ % left_.size();
      if (turn_at(k) != turn || (turn > 0 && holds_another(k))) continue;
      ears_.push_back({around(k + left_.size() - 1), left_[k], around(k + 1)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(k));
      next_ = k + 1;  // the one after the next: ears all round instead of a fan of needles
      return true;
    }
    return false;
  }

  /// Whether a corner lies in the ear or on its border, but for those at its own corners.
  [[nodiscard]] bool holds_another(std::size_t k) const {
    const Vec2d a = corners_[around(k + left_.size() - 1)], b = corners_[around(k)],
                c = corners_[around(k + 1)];
    return std::any_of(left_.begin(), left_.end(), [&](int other) {
      const Vec2d p = corners_[other];
      return p != a && p != b && p != c && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
             orientation(c, a, p) >= 0;
    });
  }

  std::vector<Vec2d> corners_;
  std::vector<int> left_;  // corners that no ear has cut off yet
  std::vector<Triangle> ears_;
  std::size_t next_ = 0;
};

/// Whether exact arithmetic has room for them.
bool are_moderate(std::span<const Vec3d> corners) {
  constexpr double most = 1e99;
  return std::all_of(corners.begin(), corners.end(), [](Vec3d p) {
    return std::abs(p.x) < most && std::abs(p.y) < most && std::abs(p.z) < most;
  });
}

/// The places of a polygon's triangles; nothing where these are the fan.
std::vector<Triangle> ears_of(std::span<const Vec3d> corners) {
  if (corners.size() <= 3 || !are_moderate(corners)) return {};
  const Vec3d normal = normal_of(corners);
  if (normal == Vec3d{} || fan_covers(corners, normal)) return {};
  return EarCutter(seen_along(normal, corners)).cut();
}

std::vector<Triangle> ears_of(const TriangleMesh& mesh, std::span<const int> corners) {
  std::vector<Vec3d> points;
  for (const int corner : corners) {
    if (static_cast<std::size_t>(corner) >= mesh.positions.size()) return {};
    points.push_back(mesh.positions[corner]);
  }
  return ears_of(points);
}

}  // namespace

std::vector<Triangle> split_polygon(std::span<const Vec3d> corners) {
  std::vector<Triangle> ears = ears_of(corners);
  return ears.empty() ? fan_of(static_cast<int>(corners.size())) : ears;
}

std::vector<Triangle> add_polygon(TriangleMesh& mesh, std::span<const int> corners) {
  if (corners.size() == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return {};
  }
  std::vector<Triangle> ears = ears_of(mesh, corners);
  for (const auto& [a, b, c] : ears.empty() ? fan_of(static_cast<int>(corners.size())) : ears)
    mesh.triangles.push_back({corners[a], corners[b], corners[c]});
  return ears;
}

std::vector<Triangle> add_polygon(TriangleMesh& mesh, std::span<const int> corners,
                                  std::span<const Vec2f> uv) {
  std::vector<Triangle> ears = add_polygon(mesh, corners);
  for (const auto& [a, b, c] : ears.empty() ? fan_of(static_cast<int>(corners.size())) : ears)
    mesh.corner_uv.push_back({uv[a], uv[b], uv[c]});
  return ears;
}

void add_strip(std::vector<Triangle>& triangles, std::span<const int> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const int a = corners[i - 2];
    const int b = corners[i % 2 == 0 ? i - 1 : i];
    const int c = corners[i % 2 == 0 ? i : i - 1];
    if (a != b && b != c && c != a) triangles.push_back({a, b, c});
  }
}

void keep_whole_texture(TriangleMesh& mesh) {
  const auto finite = [](const std::array<Vec2f, 3>& corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [](Vec2f uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); });
  };
  if (mesh.corner_uv.size() == mesh.triangles.size() &&
      std::all_of(mesh.corner_uv.begin(), mesh.corner_uv.end(), finite))
    return;
  mesh.corner_uv.clear();
}

void require_surface(const TriangleMesh& mesh, std::string_view name, bool lines) {
  if (mesh.positions.empty()) throw InputError(name, "has no vertices", "a mesh is wanted");
  if (mesh.triangles.empty())
    throw InputError(name,
                     fmt::format("holds {} only: {} vertices and no faces",
                                 lines ? "lines" : "points", mesh.positions.size()),
                     surface_wanted);
  if (mesh.positions.size() > max_elements || mesh.triangles.size() > max_elements)
    throw InputError(name,
                     fmt::format("has {} vertices and {} triangles", mesh.positions.size(),
                                 mesh.triangles.size()),
                     fmt::format("at most {} of each are wanted", max_elements));
}

void require_text(std::string_view bytes, std::string_view name, std::string_view format) {
  if (bytes.empty()) throw InputError(name, "is empty", fmt::format("{} is wanted", format));
  if (bytes.find('\0') != bytes.npos)
    throw InputError(name, "holds binary data", fmt::format("{} is wanted", format));
}

}  // namespace weft
