#include "weft/sim/stepping/buried_bodies.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "weft/sim/stepping/cloth_gaps.h"

namespace weft {
namespace {

/// Leaves marks empty where there are none.
void put_marks(const std::vector<char>& marks, PlacedBody& body) {
  const bool none = std::all_of(marks.begin(), marks.end(), [](char mark) { return mark == 0; });
  if (none)
    body.buried.clear();
  else
    body.buried = marks;
}

bool is_representative(const GeometryImage& image, int sample) {
  return image.mates.size() == 0 || image.mates.representative(sample) == sample;
}

int count_in_itself(const GeometryImage& image, const std::vector<char>& marks) {
  int count = 0;
  for (int s = 0; s < static_cast<int>(marks.size()); ++s)
    count += marks[s] == 2 && is_representative(image, s) ? 1 : 0;
  return count;
}

}  // namespace

void BuriedBodies::set_up(ThreadTeam& team) {
  counts_.assign(loaded_.bodies.size(), 0);
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
  counts_[index] = count_in_itself(body.image, marks);
  if (deforms) changing_.push_back({index, std::move(samples), body.positions, marks, marks});
}

void BuriedBodies::note_moved() {
  for (Changing& one : changing_)
    one.moved =
        one.moved || largest_displacement(one.begin, *loaded_.driven.ends()[one.body]) > gap_;
}

void BuriedBodies::note_moved_before(std::span<const double> frame_ends, ThreadTeam& team) {
  const auto has_moved = [](const Changing& one) { return one.moved; };
  for (Changing& one : changing_) one.moved = false;
  for (const double seconds : frame_ends) {
    if (std::all_of(changing_.begin(), changing_.end(), has_moved)) return;
    loaded_.driven.move_to(seconds, team);
    note_moved();
  }
}

void BuriedBodies::recheck(ThreadTeam& team) {
  for (Changing& one : changing_) {
    one.samples->find(team, one.at_end);
    put_marks(one.moved ? one.at_end : std::vector<char>(), loaded_.bodies[one.body]);
  }
}

void BuriedBodies::begin_frame(Collider& collider, ThreadTeam& team) {
  note_moved();
  for (Changing& one : changing_) {
    PlacedBody& body = loaded_.bodies[one.body];
    const Planes3& end = *loaded_.driven.ends()[one.body];
    one.at_start = one.at_end;
    if (largest_displacement(body.positions, end) > 0) one.samples->find(team, one.at_end);
    for (std::size_t s = 0; s < one.at_end.size(); ++s)
      one.at_start[s] = std::max(one.at_start[s], one.at_end[s]);
    counts_[one.body] = count_in_itself(body.image, one.at_start);
    if (one.moved) put_marks(one.at_start, body);
    collider.bury(one.body, body.buried);
  }
}

void BuriedBodies::tell(Collider& collider) const {
  for (std::size_t b = 0; b < loaded_.bodies.size(); ++b)
    collider.bury(b, loaded_.bodies[b].buried);
}

int BuriedBodies::count() const { return std::accumulate(counts_.begin(), counts_.end(), 0); }

std::vector<std::string> BuriedBodies::notes() const {
  std::vector<std::string> notes;
  for (std::size_t b = 0; b < counts_.size(); ++b)
    if (counts_[b] > 0)
      notes.push_back(fmt::format("body '{}' crosses itself: {} of its samples lie in it",
                                  loaded_.bodies[b].name, counts_[b]));
  return notes;
}

}  // namespace weft
