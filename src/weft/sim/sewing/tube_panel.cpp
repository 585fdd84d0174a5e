#include "weft/sim/sewing/tube_panel.h"

#include <algorithm>
#include <cmath>

#include "weft/core/math.h"
#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// Edges of a tube are this far apart, as a part of the panel's width. Those of a dart, and both
/// ends of a ring that is cut, are nearer.
constexpr double min_apart = 0.5;
/// Where a panel tapers to less than this part of its mean width it is rolled up as if it did not.
constexpr double min_width = 0.25;
/// The part of a half turn that no sample goes beyond.
constexpr double max_turned = 0.95;
/// Turns that are tried.
constexpr int turns = 24;
/// Points on an axis.
constexpr int points_on_axis = 9;

}  // namespace

TubePanel::TubePanel(const Garment& garment, int panel, const Planes3& placed) : placed_(placed) {
  const BorderMates& mates = garment.image.mates;
  for (int s = 0; s < placed.size() * placed.size(); ++s)
    if (panel_of(mates, s) == panel) samples_.push_back(s);
  out_ = outer_side(mates.charts()[panel], placed);
  for (const GarmentSeam& seam : garment.seams) {
    const bool first = panel_of(mates, seam.pairs.front()[0]) == panel;
    const bool second = panel_of(mates, seam.pairs.front()[1]) == panel;
    if (first && second && is_across_panel(seam.pairs)) add_to_seam(seam.pairs);
    for (const auto& [a, b] : seam.pairs)
      if (first != second) sewn_to_.push_back(first ? Pair{a, b} : Pair{b, a});
  }
  if (!is_tube()) return;
  set_axes(seam_);
  fit();
}

/// Each pair from the same side to the other, whichever edge a stitch names first.
void TubePanel::add_to_seam(std::span<const Pair> pairs) {
  const auto across = [&](const Pair& pair) { return at(pair[1]) - at(pair[0]); };
  const bool same = seam_.empty() || dot(across(seam_.front()), across_) > 0;
  for (const auto& [a, b] : pairs) seam_.push_back(same ? Pair{a, b} : Pair{b, a});
}

Vec3d TubePanel::at(int sample) const { return vec_cast<double>(placed_.at(sample)); }

void TubePanel::set_axes(std::span<const Pair> seam) {
  Vec3d apart;
  middle_ = {};
  for (const auto& [a, b] : seam) {
    apart += at(b) - at(a);
    middle_ += (0.5 / static_cast<double>(seam.size())) * (at(a) + at(b));
  }
  width_ = length(apart) / static_cast<double>(seam.size());
  across_ = normalized(apart - dot(apart, out_) * out_);
  along_ = cross(out_, across_);
}

bool TubePanel::is_across_panel(std::span<const Pair> seam) {
  set_axes(seam);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const int s : samples_) {
    const double across = dot(at(s) - middle_, across_);
    low = std::min(low, across);
    high = std::max(high, across);
  }
  return width_ > min_apart * (high - low);
}

/// Fits lines to the width between the edges and to its middle, over the place along the seam.
void TubePanel::fit() {
  double squares = 0, widths = 0, centres = 0;
  from_ = HUGE_VAL;
  to_ = -HUGE_VAL;
  for (const auto& [a, b] : seam_) {
    const Vec3d from = 0.5 * (at(a) + at(b)) - middle_;
    const double along = dot(from, along_);
    squares += along * along;
    widths += along * dot(at(b) - at(a), across_);
    centres += along * dot(from, across_);
    from_ = std::min(from_, along);
    to_ = std::max(to_, along);
  }
  if (!(squares > 0)) return;
  widening_ = widths / squares;
  leaning_ = centres / squares;
}

// Beyond the ends of the seam as at them: a sleeve's cap narrows there.

double TubePanel::radius_at(double along, const Tube& tube) const {
  const double width = width_ + widening_ * std::clamp(along, from_, to_);
  return std::max(min_width * width_, width) / (2 * pi * tube.part);
}

double TubePanel::centre_at(double along) const { return leaning_ * std::clamp(along, from_, to_); }

double TubePanel::angle_of(int sample, const Tube& tube) const {
  const Vec3d from = at(sample) - middle_;
  const double along = dot(from, along_);
  return (dot(from, across_) - centre_at(along)) / radius_at(along, tube);
}

Vec3d TubePanel::rolled_at(int sample, const Tube& tube) const {
  const double along = dot(at(sample) - middle_, along_), radius = radius_at(along, tube);
  const double angle = angle_of(sample, tube) + tube.turn;
  const double side = centre_at(along) + tube.across + radius * sine(angle);
  const double depth = radius_at(0, tube) - radius * cosine(angle) - tube.out;
  return middle_ + side * across_ + along * along_ - depth * out_;
}

Planes3 TubePanel::rolled(const Tube& tube) const {
  Planes3 rolled = placed_;
  for (const int s : samples_) rolled.set(s, vec_cast<float>(rolled_at(s, tube)));
  return rolled;
}

bool TubePanel::has_gap(const Tube& tube) const {
  return std::all_of(samples_.begin(), samples_.end(),
                     [&](int s) { return std::abs(angle_of(s, tube)) < max_turned * pi; });
}

double TubePanel::best_turn(Tube tube) const {
  double best = 0, least = HUGE_VAL;
  for (int i = 0; i < turns && !sewn_to_.empty(); ++i) {
    tube.turn = 2 * pi * i / turns;
    double squares = 0;
    for (const auto& [own, other] : sewn_to_)
      squares += squared_length(rolled_at(own, tube) - at(other));
    if (squares < least) best = tube.turn;
    least = std::min(least, squares);
  }
  return best;
}

std::vector<Vec3d> TubePanel::axis(const Tube& tube) const {
  std::vector<Vec3d> points;
  for (int i = 0; i < points_on_axis; ++i) {
    const double along = from_ + (to_ - from_) * (i + 0.5) / points_on_axis;
    const double depth = radius_at(0, tube) - tube.out;
    points.push_back(middle_ + (centre_at(along) + tube.across) * across_ + along * along_ -
                     depth * out_);
  }
  return points;
}

}  // namespace weft
