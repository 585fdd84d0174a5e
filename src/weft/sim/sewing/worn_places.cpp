#include "weft/sim/sewing/worn_places.h"

#include <algorithm>

#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// Those of all panels: holes follow some of them and count for nothing.
std::vector<int> all_samples(const Garment& garment) {
  const int n = garment.sewn.size();
  std::vector<int> samples;
  for (int s = 0; s < n * n; ++s)
    if (!garment.sewn.is_hole(s)) samples.push_back(s);
  return samples;
}

}  // namespace

WornPlaces::WornPlaces(const Garment& garment, const Planes3& placed,
                       std::span<const TiedSurface> bodies) {
  for (const GarmentLabel& label : garment.labels)
    places_.push_back({label.samples, mean_of(placed, label.samples)});
  if (places_.empty()) {
    std::vector<int> samples = all_samples(garment);
    const Vec3d middle = mean_of(placed, samples);
    places_.push_back({std::move(samples), middle});
  }
  std::vector<Vec3d> middles;
  for (const Place& place : places_) middles.push_back(place.middle);
  const std::vector<std::optional<TiedPlace>> tied = tie_to_nearest(middles, bodies);
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i].tied = tied[i];
}

double WornPlaces::sunk(const Planes3& now, std::span<const PlacedBody> bodies) const {
  double most = 0;
  for (const Place& place : places_) {
    const Vec3d wanted =
        place.tied ? tied_place(*place.tied, bodies[place.tied->body].positions) : place.middle;
    most = std::max(most, wanted.y - mean_of(now, place.samples).y);
  }
  return most;
}

}  // namespace weft
