#include "weft/view/gl/matrix.h"

#include <cmath>

#include "weft/core/math.h"

namespace weft::gl {
namespace {

/// A row of a matrix: dot(direction, point) + offset.
struct Row {
  Vec3d direction;
  double offset = 0;
};

Matrix from_rows(const std::array<Row, 4>& rows) {
  Matrix m{};
  for (int r = 0; r < 4; ++r) {
    m[r] = static_cast<float>(rows[r].direction.x);
    m[4 + r] = static_cast<float>(rows[r].direction.y);
    m[8 + r] = static_cast<float>(rows[r].direction.z);
    m[12 + r] = static_cast<float>(rows[r].offset);
  }
  return m;
}

/// scale * dot(direction, point - origin) + shift
Row measured(Vec3d direction, Vec3d origin, double scale, double shift) {
  return {scale * direction, shift - scale * dot(direction, origin)};
}

Matrix parallel_with(const Frame& frame, Vec3d centre, double scale, double shift) {
  return from_rows({measured(frame.right, centre, scale, shift),
                    measured(frame.up, centre, scale, shift),
                    measured(-frame.back, centre, scale, shift), Row{{}, 1}});
}

}  // namespace

Frame frame_towards(Vec3d back, Vec3d up) {
  const Vec3d b = normalized(back);
  const bool along = squared_length(cross(up, b)) < 1e-12 * squared_length(up);
  const Vec3d other = std::abs(b.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1};
  const Vec3d right = normalized(cross(along ? other : up, b));
  return {right, cross(b, right), b};
}

Matrix perspective(const Camera& camera, double aspect, double near, double far) {
  const Frame frame = frame_towards(camera.eye - camera.target, camera.up);
  const double half = camera.vertical_angle / 2;
  const double zoom = cosine(half) / sine(half);
  const double range = far - near;
  Row depth = measured(-frame.back, camera.eye, (far + near) / range, 0);
  depth.offset -= 2 * far * near / range;
  return from_rows({measured(frame.right, camera.eye, zoom / aspect, 0),
                    measured(frame.up, camera.eye, zoom, 0), depth,
                    measured(-frame.back, camera.eye, 1, 0)});
}

Matrix parallel(const Frame& frame, Vec3d centre, double radius) {
  return parallel_with(frame, centre, 1 / radius, 0);
}

Matrix parallel_texture(const Frame& frame, Vec3d centre, double radius) {
  return parallel_with(frame, centre, 1 / (2 * radius), 0.5);
}

}  // namespace weft::gl
