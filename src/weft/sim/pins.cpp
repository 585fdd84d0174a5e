#include "weft/sim/pins.h"

#include <cmath>

#include "weft/core/error.h"

namespace weft {
namespace {

struct Pinner {
  Cloth& cloth;

  void operator()(const ImagePin& at) const { hold(sample_at(cloth.size, at.uv)); }

  void operator()(const NearestPin& at) const {
    int nearest = 0;
    double least = HUGE_VAL;
    for (int s = 0; s < cloth.size * cloth.size; ++s) {
      const double squared = squared_length(vec_cast<double>(cloth.rest.at(s)) - at.point);
      if (squared < least) {
        least = squared;
        nearest = s;
      }
    }
    hold(nearest);
  }

  void operator()(const RegionPin& at) const {
    // A sample on the region's edge is within, also when its place rounds.
    constexpr double hair = 1e-9;
    const double steps = cloth.size - 1;
    const int first_row = static_cast<int>(std::ceil(at.lower.y * steps - hair));
    const int last_row = static_cast<int>(std::floor(at.upper.y * steps + hair));
    const int first_col = static_cast<int>(std::ceil(at.lower.x * steps - hair));
    const int last_col = static_cast<int>(std::floor(at.upper.x * steps + hair));
    if (first_row > last_row || first_col > last_col)
      throw SceneError("pins", "a region that holds no sample",
                       "a larger region or a larger cloth size is wanted");
    for (int r = first_row; r <= last_row; ++r)
      for (int c = first_col; c <= last_col; ++c) hold(r * cloth.size + c);
  }

  void hold(int sample) const { pin(cloth, sample, vec_cast<double>(cloth.rest.at(sample))); }
};

}  // namespace

int sample_at(int size, Vec2d uv) {
  const int row = static_cast<int>(std::lround(uv.y * (size - 1)));
  const int col = static_cast<int>(std::lround(uv.x * (size - 1)));
  return row * size + col;
}

void pin_places(Cloth& cloth, std::span<const PinPlace> places) {
  for (const PinPlace& place : places) std::visit(Pinner{cloth}, place);
}

}  // namespace weft
