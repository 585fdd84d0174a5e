#include "weft/sim/sewing/seams_apart.h"

#include <algorithm>

#include "weft/sim/sewing/near_classes.h"
#include "weft/sim/sewing/panel_moves.h"
#include "weft/sim/sewing/unpicking.h"

namespace weft {
namespace {

/// The distance that seams keep: at least this, and that of samples along them, as only these are
/// looked at. [m]
constexpr double min_distance = 0.01;
/// Seams that begin nearer to each other keep this part of that distance, as below a crotch.
constexpr double part_of_start = 0.8;
/// What is nearer than so many times the distance along the sewn garment comes together, as at a
/// crotch.
constexpr double distances_along = 3;
/// Cosine of the angle between the ways into the panels of two seams and the way between these,
/// from which on the seams face each other. In line, as down a sleeve and its cuff, or past each
/// other they do not.
constexpr double facing = 0.3;

/// The mean distance of samples that follow each other along seams. [m]
double spacing_of(const Garment& garment) {
  double sum = 0;
  int count = 0;
  for (const GarmentSeam& seam : garment.seams)
    for (std::size_t i = 0; i + 1 < seam.pairs.size(); ++i, ++count)
      sum += length(vec_cast<double>(garment.flat.at(seam.pairs[i + 1][0]) -
                                     garment.flat.at(seam.pairs[i][0])));
  return count > 0 ? sum / count : 0;
}

}  // namespace

SeamsApart::SeamsApart(const Garment& garment, const Planes3& start)
    : garment_(garment),
      distance_(std::max(min_distance, spacing_of(garment))),
      near_(near_classes(garment, distances_along * distance_)),
      places_(garment.sewn.class_count()) {
  for (int k = 0; k < garment.sewn.class_count(); ++k)
    if (garment.sewn.copies(k).size() > 1) order_.push_back(k);
  find_places(start);
  starts_ = places_;
}

void SeamsApart::find_places(const Planes3& position) {
  for (const int k : order_) {
    const std::span<const int> copies = garment_.sewn.copies(k), two = copies.first(2);
    places_[k] = {mean_of(position, two),
                  normalized(way_inwards(garment_, two[0], position) +
                             way_inwards(garment_, two[1], position)),
                  std::all_of(copies.begin(), copies.end(),
                              [&](int s) { return position.at(s) == position.at(two[0]); })};
  }
}

void SeamsApart::find(const Planes3& position, double way) {
  contacts_.clear();
  find_places(position);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const double one = places_[a].middle.x, other = places_[b].middle.x;
    return one != other ? one < other : a < b;
  });
  for (std::size_t i = 0; i < order_.size(); ++i)
    for (std::size_t j = i + 1; j < order_.size(); ++j) {
      const int a = order_[i], b = order_[j];
      if (places_[b].middle.x - places_[a].middle.x >= distance_ + way) break;
      if (may_pass(a, b)) add(a, b, way);
    }
}

bool SeamsApart::may_pass(int a, int b) const {
  const Place &one = places_[a], &other = places_[b];
  if (one.closed && other.closed) return false;
  const Vec3d way = normalized(other.middle - one.middle);
  return dot(one.inwards, way) < -facing && dot(other.inwards, way) > facing &&
         !std::binary_search(near_[a].begin(), near_[a].end(), b);
}

void SeamsApart::add(int a, int b, double way) {
  const Vec3d between = places_[b].middle - places_[a].middle;
  const double now = length(between), began = length(starts_[b].middle - starts_[a].middle);
  const double kept = std::min(distance_, part_of_start * began);
  if (now >= kept + way) return;
  const std::span<const int> ones = garment_.sewn.copies(a), others = garment_.sewn.copies(b);
  Contact& contact = contacts_.emplace_back();
  contact.samples = {others[0], others[1], ones[0], ones[1]};
  contact.weights = {0.5F, 0.5F, -0.5F, -0.5F};
  contact.normal = vec_cast<float>(normalized(between));
  // What is nearer already stays where it is: pushed apart, wide seams tear the cloth beside them.
  contact.offset = static_cast<float>(std::min(kept, now));
}

}  // namespace weft
