#include "weft/sim/stepping/buried_bodies.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/sim/stepping/cloth_gaps.h"

namespace weft {
namespace {

/// Leaves marks empty where there are none.
/// @param began  whether the body is where it began: sides that are next to each other from the
/// begin on crush nothing, and cloth between them would only tremble without contacts
void put_marks(const std::vector<char>& marks, bool began, PlacedBody& body) {
  body.buried = marks;
  if (began) std::replace(body.buried.begin(), body.buried.end(), char{1}, char{0});
  const bool none =
      std::all_of(body.buried.begin(), body.buried.end(), [](char mark) { return mark == 0; });
  if (none) body.buried.clear();
}

bool is_representative(const GeometryImage& image, int sample) {
  return image.mates.size() == 0 || image.mates.representative(sample) == sample;
}

int count_in_itself(const PlacedBody& body) {
  int count = 0;
  for (int s = 0; s < static_cast<int>(body.buried.size()); ++s)
    count += body.buried[s] == 2 && is_representative(body.image, s) ? 1 : 0;
  return count;
}

}  // namespace

void BuriedBodies::set_up(ThreadTeam& team) {
  for (const SimulatedCloth& cloth : loaded_.cloths) gap_ = std::min(gap_, gap_of(*cloth.model));
  for (std::size_t b = 0; b < loaded_.bodies.size(); ++b) {
    const bool keeps_in =
        std::any_of(loaded_.start_sides.begin(), loaded_.start_sides.end(),
                    [b](const StartSides& sides) { return sides.kept_in[b] != 0; });
    if (!keeps_in) look_at(b, team);
  }
}

void BuriedBodies::look_at(std::size_t index, ThreadTeam& team) {
  PlacedBody& body = loaded_.bodies[index];
  const bool deforms = loaded_.driven.motion(index).deforms();
  auto samples = std::make_unique<BuriedSamples>(
      body.image, deforms ? *loaded_.driven.ends()[index] : body.positions, gap_);
  if (!samples->closed()) return;
  std::vector<char> marks;
  samples->find(team, marks);
  put_marks(marks, true, body);
  if (deforms) changing_.push_back({index, std::move(samples), body.positions, marks, marks});
}

void BuriedBodies::recheck(ThreadTeam& team) {
  for (Changing& one : changing_) {
    PlacedBody& body = loaded_.bodies[one.body];
    one.samples->find(team, one.at_end);
    put_marks(one.at_end, at_begin(one, body.positions), body);
  }
}

bool BuriedBodies::at_begin(const Changing& one, const Planes3& positions) const {
  return largest_displacement(one.begin, positions) <= gap_;
}

void BuriedBodies::begin_frame(Collider& collider, ThreadTeam& team) {
  for (Changing& one : changing_) {
    PlacedBody& body = loaded_.bodies[one.body];
    const Planes3& end = *loaded_.driven.ends()[one.body];
    one.at_start = one.at_end;
    if (largest_displacement(body.positions, end) > 0) one.samples->find(team, one.at_end);
    for (std::size_t s = 0; s < one.at_end.size(); ++s)
      one.at_start[s] = std::max(one.at_start[s], one.at_end[s]);
    put_marks(one.at_start, at_begin(one, body.positions) && at_begin(one, end), body);
    collider.bury(one.body, body.buried);
  }
}

void BuriedBodies::tell(Collider& collider) const {
  for (std::size_t b = 0; b < loaded_.bodies.size(); ++b)
    collider.bury(b, loaded_.bodies[b].buried);
}

int BuriedBodies::count() const {
  int count = 0;
  for (const PlacedBody& body : loaded_.bodies) count += count_in_itself(body);
  return count;
}

std::string buried_text(const PlacedBody& body) {
  const int count = count_in_itself(body);
  if (count == 0) return {};
  return fmt::format("body '{}' crosses itself: {} of its samples lie in it, and keep no cloth off",
                     body.name, count);
}

}  // namespace weft
