#include "weft/sim/motion/body_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/geometry_image.h"

namespace weft {

namespace {

Vec3d between(double part, Vec3d a, Vec3d b) { return a + part * (b - a); }

}  // namespace

MotionKey key_at(std::span<const MotionKey> path, double seconds) {
  if (seconds <= path.front().time) return path.front();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const MotionKey &a = path[i - 1], &b = path[i];
    if (seconds > b.time) continue;
    const double part = (seconds - a.time) / (b.time - a.time);
    return {seconds, between(part, a.rotate, b.rotate), between(part, a.translate, b.translate)};
  }
  return path.back();
}

double fastest_on(std::span<const MotionKey> path, double reach) {
  double fastest = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const MotionKey &a = path[i - 1], &b = path[i];
    const double distance =
        length(b.translate - a.translate) + reach * pi / 180 * length(b.rotate - a.rotate);
    fastest = std::max(fastest, distance / (b.time - a.time));
  }
  return fastest;
}

namespace {

/// The largest slope of the easing curve.
constexpr double steepest = 1.5;

PointCache load_animation(const SceneBody& body, const BodyMotion::Files& files) {
  const Animation& animation = body.animation;
  if (animation.in_memory()) check_point_cache(*animation.points, animation.name);
  PointCache cache = animation.in_memory()
                         ? *animation.points
                         : read_point_cache(animation.name, {animation.clip, files.frame_rate,
                                                             body.wait + body.lead_in});
  if (cache.times_in_frames)
    for (double& time : cache.times) time /= files.frame_rate;
  cache.times_in_frames = false;
  if (animation.in_memory()) return cache;
  for (Vec3f& p : cache.positions)
    p = vec_cast<float>(in_metres_y_up(vec_cast<double>(p), files.frame));
  return cache;
}

std::vector<BlendedVertex> one_vertex_each(const std::vector<int>& vertices) {
  std::vector<BlendedVertex> blends;
  blends.reserve(vertices.size());
  for (const int vertex : vertices) blends.push_back({{vertex, vertex, vertex}, {1, 0, 0}});
  return blends;
}

/// An animation of an image has one point per sample, or one per class of mates, as runs export
/// them.
std::vector<BlendedVertex> blends_of_image(const GeometryImage& image, const SceneBody& body,
                                           int points) {
  const int samples = image.size() * image.size();
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  const int vertices = static_cast<int>(rebuilt.sample_of.size());
  if (points == vertices) return one_vertex_each(rebuilt.vertex_of);
  if (points != samples)
    throw SceneError(body.animation.name, fmt::format("{} points", points),
                     fmt::format("{} (the samples of {}), or {} (mates joined), are wanted",
                                 samples, body.surface.name, vertices));
  std::vector<int> representatives(static_cast<std::size_t>(samples));
  for (int s = 0; s < samples; ++s)
    representatives[static_cast<std::size_t>(s)] = image.mates.representative(s);
  return one_vertex_each(representatives);
}

std::vector<BlendedVertex> blends_of(const LoadedSurface& surface, const SceneBody& body,
                                     int points) {
  if (!surface.follows) return blends_of_image(surface.image, body, points);
  if (points != surface.follows->vertices)
    throw SceneError(body.animation.name, fmt::format("{} points", points),
                     fmt::format("{}, the vertices of {}, are wanted", surface.follows->vertices,
                                 body.surface.name));
  return surface.follows->blends;
}

double farthest_from(Vec3d centre, const Planes3& positions) {
  double farthest = 0;
  for (int s = 0; s < positions.size() * positions.size(); ++s)
    farthest = std::max(farthest, length(vec_cast<double>(positions.at(s)) - centre));
  return farthest;
}

}  // namespace

BodyMotion::BodyMotion(const SceneBody& body, const LoadedSurface& surface, const Files& files)
    : origin_(body.placement.translate),
      map_(placement_map(body.placement)),
      wait_(body.wait),
      lead_in_(body.lead_in),
      path_(body.motion) {
  if (path_.empty() && body.animation.empty()) return;
  rest_ = placed_positions(surface.image, map_);
  if (!body.animation.empty()) {
    animation_ = load_animation(body, files);
    blends_ = blends_of(surface, body, animation_->points);
    for (Key* key : {&before_, &after_}) key->positions = Planes3(rest_.size());
    of_mesh_ = surface.follows.has_value();
    fastest_ = fastest_animated();
  } else {
    const double reach = farthest_from(origin_, rest_);
    fastest_ = fastest_on(path_, reach);
    if (lead_in_ > 0) {
      const MotionKey begin = key_at(path_, 0);
      const std::vector<MotionKey> lead{{0, {}, {}}, {lead_in_, begin.rotate, begin.translate}};
      fastest_ = std::max(fastest_, steepest * fastest_on(lead, reach));
    }
  }
}

double BodyMotion::since_wait(double time) const noexcept { return std::max(0.0, time - wait_); }

double BodyMotion::led_in(double seconds) const noexcept {
  if (seconds >= lead_in_) return 1;
  const double part = std::max(0.0, seconds / lead_in_);
  return part * part * (3 - 2 * part);
}

MotionKey BodyMotion::key_now(double seconds) const noexcept {
  const double share = led_in(seconds);
  const MotionKey key = key_at(path_, std::max(0.0, seconds - lead_in_));
  return {seconds, share * key.rotate, share * key.translate};
}

BodyMotion::Instant BodyMotion::instant_at(double seconds) const noexcept {
  const std::vector<double>& times = animation_->times;
  const auto next = std::upper_bound(times.begin(), times.end(), seconds);
  const int last = animation_->samples() - 1;
  const int before = std::max(0, static_cast<int>(next - times.begin()) - 1);
  const int after = std::min(before + 1, last);
  if (after == before) return {before, before, 0};
  return {before, after, std::max(0.0, seconds - times[before]) / (times[after] - times[before])};
}

Vec3d BodyMotion::animated(const Instant& instant, const BlendedVertex& blend) const noexcept {
  const auto blended = [&](int index) {
    const std::span<const Vec3f> points = animation_->sample(index);
    Vec3d sum;
    for (std::size_t k = 0; k < 3; ++k)
      sum +=
          blend.weights[k] * vec_cast<double>(points[static_cast<std::size_t>(blend.vertices[k])]);
    return sum;
  };
  const Vec3d a = blended(instant.before);
  return map_.point(instant.part > 0 ? a + instant.part * (blended(instant.after) - a) : a);
}

void BodyMotion::set_key(int sample, Key& key, ThreadTeam& team) const noexcept {
  if (key.sample == sample) return;
  key.sample = sample;
  const int n = rest_.size();
  team.run([&](Worker& worker) {
    const Range rows = worker.share(n);
    for (int r = rows.first; r < rows.last; ++r)
      for (int c = 0; c < n; ++c)
        key.positions.set(r, c,
                          vec_cast<float>(animated({sample, sample, 0},
                                                   blends_[static_cast<std::size_t>(r) * n + c])));
  });
}

namespace {

/// Goes a part of the way from one row to another.
void interpolate(const float* from, const float* to, float part, int count, float* out) {
#pragma omp simd
  for (int c = 0; c < count; ++c) out[c] = from[c] + part * (to[c] - from[c]);
}

std::array<float*, 3> rows_of(Planes3& planes, int row) {
  return {planes.x.row(row), planes.y.row(row), planes.z.row(row)};
}
}  // namespace

void BodyMotion::place_animated(double seconds, Planes3& positions, ThreadTeam& team) noexcept {
  const Instant instant = instant_at(std::max(0.0, seconds - lead_in_));
  if (after_.sample == instant.before) std::swap(before_, after_);
  set_key(instant.before, before_, team);
  set_key(instant.after, after_, team);
  const int n = rest_.size();
  const auto part = static_cast<float>(instant.part), share = static_cast<float>(led_in(seconds));
  team.run([&](Worker& worker) {
    const Range rows = worker.share(n);
    for (int r = rows.first; r < rows.last; ++r) {
      const auto from = rows_of(before_.positions, r), to = rows_of(after_.positions, r),
                 rest = rows_of(rest_, r);
      const std::array<float*, 3> out = rows_of(positions, r);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        interpolate(from[axis], to[axis], part, n, out[axis]);
        if (share < 1) interpolate(rest[axis], out[axis], share, n, out[axis]);
      }
    }
  });
}

void BodyMotion::place_rigid(double seconds, Planes3& positions, ThreadTeam& team) const noexcept {
  const MotionKey key = key_now(seconds);
  const PlacementMap turn = placement_map({{1, 1, 1}, key.rotate, key.translate});
  const int n = rest_.size();
  team.run([&](Worker& worker) {
    const Range rows = worker.share(n);
    for (int r = rows.first; r < rows.last; ++r)
      for (int c = 0; c < n; ++c) {
        const Vec3d rest = vec_cast<double>(rest_.at(r, c));
        positions.set(r, c, vec_cast<float>(origin_ + turn.point(rest - origin_)));
      }
  });
}

void BodyMotion::place(double time, Planes3& positions, ThreadTeam& team) noexcept {
  if (animation_)
    place_animated(since_wait(time), positions, team);
  else
    place_rigid(since_wait(time), positions, team);
}

std::vector<Vec3d> BodyMotion::vertices(double time, std::span<const Vec3d> rest) const {
  std::vector<Vec3d> positions;
  if (!of_mesh_) return positions;
  const double seconds = since_wait(time), share = led_in(seconds);
  const Instant instant = instant_at(std::max(0.0, seconds - lead_in_));
  positions.reserve(rest.size());
  for (std::size_t v = 0; v < rest.size(); ++v) {
    const auto vertex = static_cast<int>(v);
    const Vec3d there = animated(instant, {{vertex, vertex, vertex}, {1, 0, 0}});
    const Vec3d start = map_.point(rest[v]);
    positions.push_back(share < 1 ? start + share * (there - start) : there);
  }
  return positions;
}

double BodyMotion::fastest_animated() const {
  double fastest = 0;
  for (int s = 0; s < rest_.size() * rest_.size(); ++s) {
    const BlendedVertex& blend = blends_[static_cast<std::size_t>(s)];
    Vec3d before = animated({0, 0, 0}, blend);
    if (lead_in_ > 0)
      fastest =
          std::max(fastest, steepest * length(before - vec_cast<double>(rest_.at(s))) / lead_in_);
    for (int k = 1; k < animation_->samples(); ++k) {
      const Vec3d there = animated({k, k, 0}, blend);
      const double seconds = animation_->times[k] - animation_->times[k - 1];
      fastest = std::max(fastest, length(there - before) / seconds);
      before = there;
    }
  }
  return fastest;
}

void DrivenBodies::add(BodyMotion motion) {
  places_.push_back(motion.moves() ? std::make_unique<Planes3>(motion.size()) : nullptr);
  ends_.push_back(places_.back().get());
  motions_.push_back(std::move(motion));
}

void DrivenBodies::move_to(double seconds, ThreadTeam& team) noexcept {
  for (std::size_t i = 0; i < motions_.size(); ++i)
    if (places_[i]) motions_[i].place(seconds, *places_[i], team);
}

bool DrivenBodies::any_moves() const {
  return std::any_of(ends_.begin(), ends_.end(), [](const Planes3* end) { return end != nullptr; });
}

double DrivenBodies::fastest() const {
  double fastest = 0;
  for (const BodyMotion& motion : motions_) fastest = std::max(fastest, motion.fastest());
  return fastest;
}

}  // namespace weft
