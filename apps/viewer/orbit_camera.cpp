#include "apps/viewer/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace weft::viewer {
namespace {

constexpr double turn_per_pixel = 0.007;  // [rad]
constexpr double highest = 1.5;           // short of straight down, where up has no direction
constexpr double nearer_per_step = 0.88;
constexpr double min_distance = 1e-3, largest_distance = 1e4;  // [m]

double half_slope() {
  return std::sin(Camera{}.vertical_angle / 2) / std::cos(Camera{}.vertical_angle / 2);
}

}  // namespace

void OrbitCamera::resize(int width, int height, int covered) {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
  covered_ = std::clamp(covered, 0, width_ / 2);
}

void OrbitCamera::frame(const Box3d& box) {
  const double aspect = static_cast<double>(width_ - covered_) / height_;
  const Camera seen = frame_box(box, azimuth_, elevation_, aspect);
  distance_ = length(seen.eye - seen.target);
  target_ = seen.target - (0.5 * covered_ * pixel_size()) * axes().right;
}

OrbitCamera::Axes OrbitCamera::axes() const {
  const Vec3d back{std::sin(azimuth_) * std::cos(elevation_), std::sin(elevation_),
                   std::cos(azimuth_) * std::cos(elevation_)};
  const Vec3d right{std::cos(azimuth_), 0, -std::sin(azimuth_)};
  return {right, cross(back, right), back};
}

double OrbitCamera::pixel_size() const { return 2 * half_slope() * distance_ / height_; }

void OrbitCamera::orbit(Vec2d displacement) {
  azimuth_ -= turn_per_pixel * displacement.x;
  elevation_ = std::clamp(elevation_ + turn_per_pixel * displacement.y, -highest, highest);
}

void OrbitCamera::pan(Vec2d displacement) {
  const Axes a = axes();
  target_ += (-displacement.x * pixel_size()) * a.right + (displacement.y * pixel_size()) * a.up;
}

void OrbitCamera::zoom(double steps, Vec2d at) {
  double factor = 1;
  for (; steps >= 1; --steps) factor *= nearer_per_step;
  for (; steps <= -1; ++steps) factor /= nearer_per_step;
  factor *= 1 - (1 - nearer_per_step) * steps;
  const double next = std::clamp(factor * distance_, min_distance, largest_distance);
  const Vec3d kept = on_facing_plane(at, target_);
  target_ += (1 - next / distance_) * (kept - target_);
  distance_ = next;
}

Camera OrbitCamera::camera() const {
  const Axes a = axes();
  Camera camera;
  camera.target = target_;
  camera.eye = target_ + distance_ * a.back;
  camera.up = a.up;
  return camera;
}

Ray OrbitCamera::ray_through(Vec2d pixel) const {
  const Axes a = axes();
  const double x = pixel.x - 0.5 * width_, y = 0.5 * height_ - pixel.y;
  const double scale = 2 * half_slope() / height_;
  return {camera().eye, normalized((scale * x) * a.right + (scale * y) * a.up - a.back)};
}

Vec3d OrbitCamera::on_facing_plane(Vec2d pixel, Vec3d point) const {
  const Ray ray = ray_through(pixel);
  const Vec3d back = axes().back;
  return ray.from + (dot(point - ray.from, back) / dot(ray.direction, back)) * ray.direction;
}

Vec2d OrbitCamera::pixel_of(Vec3d point) const {
  const Axes a = axes();
  const Vec3d seen = point - camera().eye;
  const double depth = -dot(seen, a.back);
  if (!(depth > 0)) return {-1e6, -1e6};
  const double scale = height_ / (2 * half_slope() * depth);
  return {0.5 * width_ + scale * dot(seen, a.right), 0.5 * height_ - scale * dot(seen, a.up)};
}

}  // namespace weft::viewer
