#include "weft/sim/sewing/panel_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/sim/sewing/panel_moves.h"
#include "weft/sim/sewing/panel_touching.h"
#include "weft/sim/sewing/panels_in_bodies.h"

namespace weft {
namespace {

/// Panels that stand across others, and are this high at least, begin so far above them. Lower
/// ones, as collars, hang in nobody's way. [m]
constexpr double min_height = 0.1, clear_above = 0.2;
/// Cosine of the angle between their sides from which on panels stand across each other.
constexpr double cosine_across = 0.7;

/// Panels leave others that they touch in steps of this length, up to this many. [m]
constexpr double step_apart = 0.003;
constexpr int max_steps_apart = 20;

/// Panels leave bodies in steps of this length, up to this many. [m]
constexpr double step_out = 0.02;
constexpr int max_steps_out = 25;

MovedPanels farthest_of(const std::vector<Vec3d>& shift) {
  MovedPanels found;
  for (std::size_t i = 0; i < shift.size(); ++i) {
    const double distance = length(shift[i]);
    if (distance > 0) ++found.count;
    if (distance > found.distance) found = {found.count, static_cast<int>(i), distance};
  }
  return found;
}

/// Moves panels outwards, step by step.
class StepsOut {
 public:
  /// @param length  of a step [m]  @param placed  kept by reference
  StepsOut(const BorderMates& mates, double length, Planes3& placed)
      : mates_(mates), start_(placed), placed_(placed), moved_(mates.charts().size()) {
    for (const Chart& chart : mates.charts()) step_.push_back(length * outer_side(chart, placed));
  }
  void go(const std::vector<bool>& those) {
    for (std::size_t i = 0; i < those.size(); ++i)
      if (those[i]) moved_[i] += step_[i];
    put();
  }
  [[nodiscard]] MovedPanels moved() const { return farthest_of(moved_); }
  void take_back(const std::vector<bool>& those) {
    for (std::size_t i = 0; i < those.size(); ++i)
      if (those[i]) moved_[i] = {};
    put();
  }

 private:
  void put() {
    placed_ = start_;
    move_panels(mates_, moved_, placed_);
  }

  const BorderMates& mates_;
  const Planes3 start_;
  Planes3& placed_;
  std::vector<Vec3d> step_, moved_;  // of each chart [m]
};

/// Where each panel of a garment begins.
struct PanelPlaces {
  PanelPlaces(const BorderMates& mates, const Planes3& placed)
      : lowest(mates.charts().size(), HUGE_VAL),
        highest(mates.charts().size(), -HUGE_VAL),
        middle(mates.charts().size()) {
    std::vector<int> size(mates.charts().size());
    for (int s = 0; s < placed.size() * placed.size(); ++s) {
      const int chart = panel_of(mates, s);
      const double height = placed.at(s).y;
      lowest[chart] = std::min(lowest[chart], height);
      highest[chart] = std::max(highest[chart], height);
      middle[chart] += (height - middle[chart]) / ++size[chart];
    }
    for (const Chart& chart : mates.charts()) outer.push_back(outer_side(chart, placed));
  }
  [[nodiscard]] bool stands_across(int panel, int other) const {
    return std::abs(dot(outer[panel], outer[other])) < cosine_across &&
           lowest[panel] > middle[other] && highest[panel] - lowest[panel] > min_height;
  }

  std::vector<double> lowest, highest, middle;  // [m]
  std::vector<Vec3d> outer;                     // sides
};

/// The pairs of panels that are sewn together, each twice.
std::vector<std::array<int, 2>> sewn_panels(const Garment& garment) {
  std::vector<std::array<int, 2>> sewn;
  for (const GarmentSeam& seam : garment.seams) {
    const int a = panel_of(garment.image.mates, seam.pairs.front()[0]);
    const int b = panel_of(garment.image.mates, seam.pairs.front()[1]);
    sewn.push_back({a, b});
    sewn.push_back({b, a});
  }
  return sewn;
}

bool any(const std::vector<bool>& charts) {
  return std::find(charts.begin(), charts.end(), true) != charts.end();
}

}  // namespace

MovedPanels move_out_of_bodies(const GeometryImage& panels, std::span<const PlacedBody> bodies,
                               ThreadTeam& team, Planes3& placed) {
  PanelsInBodies inside(panels, bodies, placed);
  const std::vector<bool> first = inside.find(placed, team);
  if (!any(first)) return {};
  StepsOut steps(panels.mates, step_out, placed);
  std::vector<bool> left = first;
  for (int i = 0; i < max_steps_out && any(left); ++i) {
    steps.go(left);
    left = inside.find(placed, team);
  }
  steps.take_back(left);
  std::vector<bool> out = first;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = first[i] && !left[i];
  steps.go(out);
  return steps.moved();
}

MovedPanels raise_above_others(const Garment& garment, const std::vector<char>& stay,
                               Planes3& placed) {
  const PanelPlaces places(garment.image.mates, placed);
  std::vector<Vec3d> raised(garment.panel_holds.size());
  for (const auto& [panel, other] : sewn_panels(garment))
    if (stay[panel] == 0 && garment.panel_holds[panel] == PanelHold::other_panels &&
        places.stands_across(panel, other))
      raised[panel].y =
          std::max(raised[panel].y, places.highest[other] + clear_above - places.lowest[panel]);
  move_panels(garment.image.mates, raised, placed);
  return farthest_of(raised);
}

int part_panels(const BorderMates& sewn, Planes3& placed) {
  StepsOut steps(sewn, step_apart, placed);
  const auto count = static_cast<int>(sewn.charts().size());
  int moved = 0;
  for (int i = 0; i < count; ++i) {
    std::vector<bool> this_one(count);
    this_one[i] = true;
    const auto touches_earlier = [&] {
      for (int k = 0; k < i; ++k)
        if (panels_touch(sewn, i, k, placed)) return true;
      return false;
    };
    int step = 0;
    for (; step < max_steps_apart && touches_earlier(); ++step) steps.go(this_one);
    moved += step > 0 ? 1 : 0;
  }
  return moved;
}

int lift_above_ground(const BorderMates& mates, double ground, Planes3& placed) {
  std::vector<Vec3d> lift(mates.charts().size());
  for (int s = 0; s < placed.size() * placed.size(); ++s) {
    double& height = lift[panel_of(mates, s)].y;
    height = std::max(height, ground - placed.at(s).y);
  }
  move_panels(mates, lift, placed);
  return static_cast<int>(
      std::count_if(lift.begin(), lift.end(), [](Vec3d by) { return by.y > 0; }));
}

}  // namespace weft
