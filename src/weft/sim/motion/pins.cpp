#include "weft/sim/motion/pins.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/sim/motion/body_motion.h"
#include "weft/sim/placement.h"
#include "weft/simulation.h"

namespace weft {
namespace {

/// Largest distance from the neighbouring samples, in rest lengths: the strain limit lets cloth
/// stretch a little.
constexpr double max_stretch = 1.08;

/// Moves a towards b, by at most `max`.
Vec3d towards(Vec3d a, Vec3d b, double max) {
  const double distance = length(b - a);
  return distance > max ? a + (max / distance) * (b - a) : b;
}

/// Next position of a pin, limited so that it overstretches no spring to the neighbours of its
/// copies. Neighbours are extrapolated by their velocity along the displacement; so the pin gives
/// way no more than it must where the cloth is taut and springs back.
/// @param displacement  of the pin in the step [m]
Vec3d within_reach(const SimulatedCloth& held, const Pin& pin, double time_step,
                   Vec3d displacement) {
  const Cloth& cloth = *held.model;
  Vec3d place = vec_cast<double>(held.state.position.at(pin.sample)) + displacement;
  const Vec3d ahead = normalized(displacement);
  for_each_beside(cloth, pin, [&](int copy, int r, int c) {
    const Vec3d rest = vec_cast<double>(cloth.rest.at(r, c) - cloth.rest.at(copy));
    const double along = dot(vec_cast<double>(held.state.velocity.at(r, c)), ahead);
    const Vec3d there = vec_cast<double>(held.state.position.at(r, c)) +
                        std::min(std::max(0.0, along) * time_step, length(displacement)) * ahead;
    place = towards(there, place, max_stretch * length(rest));
  });
  return place;
}

struct Pinner {
  Cloth& cloth;
  std::vector<int>& held;  // pins of the cloth

  void operator()(const ImagePin& at) const {
    const int sample = sample_at(cloth.size, at.uv);
    if (cloth.mates.is_hole(sample))
      throw SceneError(
          "pins", "a place between the charts of the image",
          "a place in one of them, or the point of the surface that is nearest, is wanted");
    hold(sample);
  }

  void operator()(const NearestPin& at) const {
    int nearest = 0;
    double min = HUGE_VAL;
    for (int s = 0; s < cloth.size * cloth.size; ++s) {
      const double squared =
          squared_length(vec_cast<double>(cloth.start_positions().at(s)) - at.point);
      if (squared < min) {
        min = squared;
        nearest = s;
      }
    }
    hold(nearest);
  }

  void operator()(const RegionPin& at) const {
    // A sample on the region's edge is inside, despite rounding.
    constexpr double hair = 1e-9;
    const double steps = cloth.size - 1;
    const int first_row = static_cast<int>(std::ceil(at.lower.y * steps - hair));
    const int last_row = static_cast<int>(std::floor(at.upper.y * steps + hair));
    const int first_col = static_cast<int>(std::ceil(at.lower.x * steps - hair));
    const int last_col = static_cast<int>(std::floor(at.upper.x * steps + hair));
    const std::size_t before = held.size();
    for (int r = first_row; r <= last_row; ++r)
      for (int c = first_col; c <= last_col; ++c)
        if (!cloth.mates.is_hole(r * cloth.size + c)) hold(r * cloth.size + c);
    if (held.size() == before)
      throw SceneError("pins", "a region that holds no sample",
                       "a larger region or a larger cloth size is wanted");
  }

  void hold(int sample) const {
    held.push_back(pin(cloth, sample, vec_cast<double>(cloth.start_positions().at(sample))));
  }
};

/// The motion of pins whose targets are still their rest positions.
PinMotion motion_of(const Cloth& cloth, const ScenePin& place, std::vector<int> held) {
  PinMotion motion;
  motion.path = place.path;
  for (const int index : held) {
    motion.rest.push_back(cloth.pins[static_cast<std::size_t>(index)].target);
    motion.centre += (1 / static_cast<double>(held.size())) * motion.rest.back();
  }
  motion.pins = std::move(held);
  return motion;
}

}  // namespace

int sample_at(int size, Vec2d uv) {
  const int row = static_cast<int>(std::lround(uv.y * (size - 1)));
  const int col = static_cast<int>(std::lround(uv.x * (size - 1)));
  return row * size + col;
}

std::vector<int> pin_place(Cloth& cloth, const PinPlace& place) {
  std::vector<int> held;
  std::visit(Pinner{cloth, held}, place);
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  return held;
}

void let_go(std::span<const int> held, std::vector<PinMotion>& motions) {
  for (PinMotion& motion : motions)
    for (std::size_t i = motion.pins.size(); i-- > 0;)
      if (std::find(held.begin(), held.end(), motion.pins[i]) != held.end()) {
        motion.pins.erase(motion.pins.begin() + static_cast<std::ptrdiff_t>(i));
        motion.rest.erase(motion.rest.begin() + static_cast<std::ptrdiff_t>(i));
      }
}

std::vector<PinMotion> pin_places(Cloth& cloth, std::span<const ScenePin> places) {
  std::vector<PinMotion> motions;
  for (const ScenePin& place : places) {
    std::vector<int> held = pin_place(cloth, place.place);
    let_go(held, motions);
    if (!place.path.empty()) motions.push_back(motion_of(cloth, place, std::move(held)));
  }
  return motions;
}

void move_pins(std::span<const PinMotion> motions, double seconds, Cloth& cloth) {
  for (const PinMotion& motion : motions) {
    const MotionKey key = key_at(motion.path, seconds);
    const PlacementMap map = placement_map({{1, 1, 1}, key.rotate, key.translate});
    for (std::size_t i = 0; i < motion.pins.size(); ++i)
      cloth.pins[static_cast<std::size_t>(motion.pins[i])].target =
          motion.centre + map.point(motion.rest[i] - motion.centre);
  }
}

double fastest_pin(std::span<const PinMotion> motions) {
  double fastest = 0;
  for (const PinMotion& motion : motions) {
    double reach = 0;
    for (const Vec3d& place : motion.rest) reach = std::max(reach, length(place - motion.centre));
    fastest = std::max(fastest, fastest_on(motion.path, reach));
  }
  return fastest;
}

void Grab::take(std::size_t cloth, int sample, SimulatedCloth& held) {
  const std::size_t pins = held.model->pins.size();
  pin_ = pin(*held.model, sample, {});
  added_ = held.model->pins.size() > pins;
  cloth_ = cloth;
  Pin& hand = held.model->pins[static_cast<std::size_t>(pin_)];
  wanted_ = hand.target = vec_cast<double>(held.state.position.at(hand.sample));
}

void Grab::move(double time_step, std::optional<double> ground, SimulatedCloth& held) const {
  Pin& pin = held.model->pins[static_cast<std::size_t>(pin_)];
  const Vec3d here = vec_cast<double>(held.state.position.at(pin.sample));
  const Vec3d displacement = towards(here, wanted_, hand_speed * time_step) - here;
  Vec3d next = within_reach(held, pin, time_step, displacement);
  const double thickness = held.model->material.thickness;
  if (ground) next.y = std::max(next.y, std::min(here.y, *ground + thickness));
  pin.target = next;
}

void Grab::let_go(Cloth& held) {
  if (added_) unpin_last(held);
  pin_ = -1;
}

}  // namespace weft
