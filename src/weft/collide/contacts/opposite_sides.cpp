#include "weft/collide/contacts/opposite_sides.h"

namespace weft {
namespace {

/// The opposite side is looked for around a point this many gaps before the sample, within this
/// part of that point's distance from the closest side.
constexpr double ahead_in_gaps = 1, closer_than_near_side = 0.9;
/// Sides are opposite where the cosine of their normals is at most this.
constexpr double largest_cosine = 0.5;

}  // namespace

void OppositeSides::ask(const Near& near, int* triangle) {
  if (!(near.gap < static_cast<float>(contact_margin * gap_))) return;
  const double ahead = ahead_in_gaps * gap_;
  near_[asked_.count] = near;
  answers_[asked_.count] = triangle;
  asked_.add(near.start + static_cast<float>(ahead) * near.normal,
             closer_than_near_side * (ahead + near.gap), near.hint);
}

void OppositeSides::find(const BodyQuery& body) {
  body.closest(asked_, found_);
  for (int i = 0; i < asked_.count; ++i) {
    const int triangle = found_[i].point.triangle;
    if (triangle < 0) continue;
    const Vec3d start = vec_cast<double>(near_[i].start),
                way = start - body.point_of(start, triangle).position;
    if (dot(way, vec_cast<double>(near_[i].normal)) <= largest_cosine * length(way))
      *answers_[i] = triangle;
  }
}

}  // namespace weft
