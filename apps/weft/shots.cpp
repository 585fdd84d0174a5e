#include "apps/weft/shots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/weft/drawing.h"
#include "weft/error.h"
#include "weft/picture.h"

namespace weft::app {
namespace {

constexpr double min_turn = 4;        // [s]
constexpr double max_turn_rate = 30;  // [1/s]
constexpr int min_part = 32;          // [pixels]

int text_scale_of(int height) { return std::max(1, (height + 100) / 240); }

/// Frame of a subject at a time, played at its own rate; the last one after its end.
int frame_at_time(const Subject& subject, double seconds) {
  const double frame = std::floor(seconds * subject.frame_rate() + 0.5);
  return static_cast<int>(std::min(frame, subject.frames() - 1.0));
}

}  // namespace

int frame_of(const Subject& subject, int frame) {
  const int last = subject.frames() - 1;
  return frame < 0 || last == 0 ? last : frame;
}

ViewFrom part_of_row(const ViewFrom& view, int count) {
  ViewFrom part = view;
  if (count == 1) return part;
  part.width = (view.width - panel_gap * (count - 1)) / count;
  part.height = view.height - label_height(text_scale_of(view.height));
  if (std::min(part.width, part.height) < min_part)
    throw UsageError("--width", "too little room for all", "a larger picture is wanted");
  return part;
}

Shots::Shots(std::vector<std::unique_ptr<Subject>> subjects, std::vector<std::string> labels,
             const ViewFrom& view)
    : subjects_(std::move(subjects)), labels_(std::move(labels)), view_(view) {
  labels_.resize(subjects_.size());
}

bool Shots::any_flat() const {
  return std::any_of(subjects_.begin(), subjects_.end(),
                     [](const auto& subject) { return subject->is_flat(); });
}

bool Shots::any_moves() const { return frames() > 1; }

int Shots::frames() const {
  int max = 1;
  for (const auto& subject : subjects_) max = std::max(max, subject->frames());
  return max;
}

double Shots::frame_rate() const {
  const auto longest =
      std::max_element(subjects_.begin(), subjects_.end(),
                       [](const auto& a, const auto& b) { return a->frames() < b->frames(); });
  return (*longest)->frame_rate();
}

Outline Shots::outline_at(int frame) const {
  Outline seen;
  for (const auto& subject : subjects_) subject->add_to(seen, frame_of(*subject, frame));
  return seen;
}

Outline Shots::outline() const {
  Outline seen;
  for (const auto& subject : subjects_) seen.add(outline_of(*subject));
  return seen;
}

Picture Shots::still(int frame) {
  std::vector<int> frames;
  for (const auto& subject : subjects_) frames.push_back(frame_of(*subject, frame));
  return draw(frames, view_.azimuth, outline_at(frame).points());
}

Shots::Take Shots::playing(double max_rate) const {
  Take take;
  take.plays = true;
  take.rate = std::min(frame_rate(), max_rate);
  for (const auto& subject : subjects_) {
    const double seconds = (subject->frames() - 1) / subject->frame_rate();
    take.count = std::max(take.count, 1 + static_cast<int>(std::floor(seconds * take.rate + 0.5)));
  }
  take.points = outline().points();
  return take;
}

Shots::Take Shots::turning(std::optional<int> frame) const {
  Take take;
  if (!frame && any_moves()) {
    take = playing(max_turn_rate);
    take.points = outline().points_turning();
  } else {
    take.frame = frame.value_or(-1);
    take.points = outline_at(take.frame).points_turning();
  }
  take.turns = true;
  take.count = std::max(take.count, static_cast<int>(std::ceil(min_turn * take.rate)));
  return take;
}

Picture Shots::draw(const Take& take, int i) {
  std::vector<int> frames;
  for (const auto& subject : subjects_)
    frames.push_back(take.plays ? frame_at_time(*subject, i / take.rate)
                                : frame_of(*subject, take.frame));
  const double turned = take.turns ? 2 * std::numbers::pi * i / take.count : 0;
  return draw(frames, view_.azimuth + turned, take.points);
}

Picture Shots::draw(const std::vector<int>& frames, double azimuth,
                    const std::vector<Vec3d>& points) {
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < subjects_.size(); ++k) {
    Subject& subject = *subjects_[k];
    const Camera camera = frame_points(points, azimuth, view_.elevation, subject.aspect());
    panels.push_back({subject.draw(frames[k], camera), labels_[k]});
  }
  if (panels.size() == 1 && panels[0].label.empty()) return std::move(panels[0].picture);
  return in_a_row(panels, text_scale_of(view_.height));
}

}  // namespace weft::app
