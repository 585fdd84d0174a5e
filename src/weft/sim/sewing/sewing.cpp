#include "weft/sim/sewing/sewing.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// Seams close within a time in which no sample goes faster, which is at least this. [m/s], [s]
constexpr double fastest = 1, min_time = 0.2;
/// Speed of samples that were held back. [m/s]
constexpr double late_speed = 0.25;
/// What was held back is let go in the last part of each such time. [s]
constexpr double let_go_for = 0.08, let_go_every = 0.2;
/// Distance up to which the samples of a class take turns in being where the others go to: where
/// one is held back at their mean, it is free where it is. [m]
constexpr double turns_within = 0.005;
/// Samples this close to their mean have met; those beyond the other are far from it. [m]
constexpr double met = 0.002, far = 0.02;
/// A seam that is far open closes like a zip: of it those are pulled that lie up to so many samples
/// from where it has met, and in any case what is this near. [m]
constexpr int zip_reach = 3;
constexpr double near_in_zip = 0.006;
/// Bending stiffness of panels while they are sewn, that of paper; limp, they would crumple at
/// their edges and come to lie between others. [N m]
constexpr double min_bending = 1e-3;
/// Where a seam stays open gravity fades in after this time, and in this one. [s]
constexpr double gravity_after = 1.5, gravity_fades = 0.5;
/// Distance from their mean at which samples become one while all seams close, so that they go to
/// where they meet. Afterwards it is `met`: pressed onto a body they stay up to so far apart though
/// nothing is between them. [m]
constexpr double closed = 5e-5;
/// Cloth between samples is taken to hold them apart while their panels are pulled on at this part
/// of the late speed at least. Where they are stretched more, it is they that do.
constexpr double min_slack = 0.5;
/// Mean stretch of the cloth along a seam from which on it is tight.
constexpr double tight = 0.05;

/// Where a body takes more than this part of a pull, its goal is behind the body, and a seam from
/// which its panel hangs goes over it: straps over shoulders. `hanging` is how far upwards the way
/// into such a panel leads, at most.
constexpr double head_on = 0.7, hanging = -0.5;

double farthest_from(Vec3d middle, const Planes3& planes, std::span<const int> samples) {
  double most = 0;
  for (const int s : samples)
    most = std::max(most, length(vec_cast<double>(planes.at(s)) - middle));
  return most;
}

/// The part of the distances that is left: it falls from 1 to 0, slowly at first and at last.
double part_left(double seconds, double time_to_close) {
  const double t = std::clamp(seconds / time_to_close, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

}  // namespace

Sewing::Sewing(const Garment& garment, const Planes3& start)
    : garment_(garment),
      panels_(garment, start),
      unpicking_(garment),
      middle_(garment.sewn.class_count()),
      began_at_(garment.sewn.class_count()),
      away_(garment.sewn.class_count()),
      rate_(garment.sewn.class_count()),
      stretch_(garment, start),
      seams_apart_(garment, start),
      next_(garment.sewn.class_count()),
      stuck_(garment.sewn.class_count()),
      blocked_(start.size() * start.size()) {
  find_classes_along_seams();
  find_leaders();
  find_upper_edges(start);
  measure(start);
  const double farthest = away_.empty() ? 0 : *std::max_element(away_.begin(), away_.end());
  // part_left is steepest in the middle, by 1.5.
  time_to_close_ = std::max(min_time, 1.5 * farthest / fastest);
}

void Sewing::find_classes_along_seams() {
  const int n = garment_.flat.size();
  class_of_.assign(static_cast<std::size_t>(n) * n, -1);
  for (int k = 0; k < garment_.sewn.class_count(); ++k)
    for (const int s : garment_.sewn.mates(k)) class_of_[s] = k;
  for (const GarmentSeam& seam : garment_.seams) {
    std::vector<int>& classes = along_.emplace_back();
    for (const auto& [a, b] : seam.pairs)
      if (class_of_[a] >= 0) classes.push_back(class_of_[a]);
  }
}

void Sewing::find_leaders() {
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    std::vector<int>& leaders = leaders_.emplace_back();
    PanelHold hold = PanelHold::other_panels;
    for (const int s : garment_.sewn.copies(k)) hold = std::max(hold, panels_.hold_of(s));
    for (const int s : garment_.sewn.copies(k))
      if (panels_.hold_of(s) == hold) leaders.push_back(s);
  }
}

void Sewing::find_upper_edges(const Planes3& start) {
  on_upper_edge_.assign(class_of_.size(), 0);
  for (std::size_t s = 0; s < class_of_.size(); ++s)
    if (class_of_[s] >= 0)
      on_upper_edge_[s] = way_inwards(garment_, static_cast<int>(s), start).y < hanging ? 1 : 0;
}

Vec3d Sewing::mean_of_class(int index, const Planes3& planes) const {
  Vec3d mean = mean_of(planes, garment_.sewn.copies(index));
  mean.y = mean_of(planes, leaders_[index]).y;
  return mean;
}

void Sewing::measure(const Planes3& position) {
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> samples = garment_.sewn.copies(k);
    if (samples.size() < 2) continue;
    middle_[k] = mean_of_class(k, position);
    began_at_[k] = mean_of(position, samples);
    away_[k] = farthest_from(middle_[k], position, samples);
  }
}

void Sewing::begin_frame(const Planes3& position, double seconds, double length) {
  const auto since = static_cast<int>(std::lround(seconds / length)) -
                     static_cast<int>(std::ceil(time_to_close_ / length));
  if (!unpicking_.begin_frame(since, length)) return;
  measure(position);
  stretch_.find_slack(position);
  // What has nearly met was put together in every step. Where nothing else is apart it is held
  // apart, too; where more is, tight panels may keep it from closing.
  const double apart = is_nearly_closed() ? 0 : met;
  for (int k = 0; k < garment_.sewn.class_count(); ++k)
    stuck_[k] = away_[k] > apart && away_[k] < far && stretch_.slack_of(k) >= min_slack ? 1 : 0;
  unpicking_.choose(along_, stuck_);
}

/// Whether few pairs of samples are apart, and these have nearly met.
bool Sewing::is_nearly_closed() const {
  constexpr int few = 3;
  const auto is_apart = [](double away) { return away > 0; };
  const auto is_far = [](double away) { return away > met; };
  return std::none_of(away_.begin(), away_.end(), is_far) &&
         std::count_if(away_.begin(), away_.end(), is_apart) <= few;
}

bool Sewing::is_unpicked(int sample) const {
  return class_of_[sample] >= 0 && unpicking_.takes_apart(class_of_[sample]);
}

void Sewing::find_next() {
  const double within = unpicking_.closes_as_a_zip() ? near_in_zip : far;
  for (std::size_t k = 0; k < next_.size(); ++k) next_[k] = away_[k] < within ? 1 : 0;
  for (const std::vector<int>& classes : along_) {
    const auto count = static_cast<int>(classes.size());
    const auto is_met = [&](int k) { return away_[k] < met; };
    if (std::none_of(classes.begin(), classes.end(), is_met)) {
      for (const int k : classes) next_[k] = 1;
      continue;
    }
    for (int i = 0; i < count; ++i)
      for (int j = std::max(0, i - zip_reach); j <= std::min(count - 1, i + zip_reach); ++j)
        if (is_met(classes[i])) next_[classes[j]] = 1;
  }
}

double Sewing::kept_part(int index, double time_step, double seconds) const {
  const double away = away_[index];
  if (!(away > 0)) return 0;
  const double left = part_left(seconds, time_to_close_);
  if (left > 0)
    return std::max(part_left(seconds + time_step, time_to_close_) / left,
                    1 - fastest * time_step / away);
  if (next_[index] == 0) return 1;
  if (std::fmod(seconds - time_to_close_, let_go_every) >= let_go_every - let_go_for) return 1;
  return std::max(0.0, 1 - stretch_.slack_of(index) * late_speed * time_step / away);
}

double Sewing::part_closed(double seconds) const { return 1 - part_left(seconds, time_to_close_); }

double Sewing::gravity_part(double seconds) const {
  const double since = seconds - std::max(gravity_after, time_to_close_);
  return std::clamp(since / gravity_fades, 0.0, 1.0);
}

WarpWeft Sewing::bending_for(const Material& material) {
  return {std::max(material.bending.warp, min_bending),
          std::max(material.bending.weft, min_bending)};
}

/// Cloth with cloth has samples of two panels, or four.
bool Sewing::is_with_body(const PastContact& contact) const {
  if (contact.second >= 0 || contact.samples[3] >= 0) return false;
  // A corner or an edge of a triangle has no weights for its other samples.
  const int one = *std::max_element(contact.samples.begin(), contact.samples.end());
  return std::all_of(contact.samples.begin(), contact.samples.end(),
                     [&](int s) { return s < 0 || panels_.panel_of(s) == panels_.panel_of(one); });
}

void Sewing::find_blocked(std::span<const PastContact> contacts) {
  std::fill(blocked_.begin(), blocked_.end(), std::array<Vec3f, max_blocking>{});
  for (const PastContact& contact : contacts) {
    if (!is_with_body(contact)) continue;
    for (const int s : contact.samples) {
      if (s < 0) continue;
      const auto free = std::find(blocked_[s].begin(), blocked_[s].end(), Vec3f{});
      if (free != blocked_[s].end()) *free = contact.normal;
    }
  }
}

void Sewing::pull(const Step& now, ClothState& state) {
  const double time_step = now.length, seconds = now.seconds;
  measure(state.position);
  find_blocked(now.contacts);
  find_next();
  late_ = seconds >= time_to_close_;
  if (late_) stretch_.find_slack(state.position);
  const auto step = static_cast<std::size_t>(std::llround(seconds / time_step));
  for (int k = 0; k < garment_.sewn.class_count(); ++k)
    rate_[k] = (1 - kept_part(k, time_step, seconds)) / time_step;
  find_panel_pulls(state.position, step);
  panels_.carry(!late_, time_step, state.velocity);
  if (gravity_part(seconds) == 0) panels_.hold(state);
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> samples = garment_.sewn.copies(k);
    if (samples.size() < 2) continue;
    const Vec3d velocity = mean_of_class(k, state.velocity);
    for (const int s : samples)
      state.velocity.set(s, vec_cast<float>(velocity + pull_of(k, s, state.position, step)));
  }
  seams_apart_.find(state.position, 2 * fastest * time_step);
}

Vec3d Sewing::pull_of(int index, int sample, const Planes3& position, std::size_t step) const {
  if (unpicking_.takes_apart(index)) return unpicking_.retreat_of(sample, position);
  const std::span<const int> samples = garment_.sewn.copies(index);
  const Vec3d goal = away_[index] < turns_within
                         ? vec_cast<double>(position.at(samples[step % samples.size()]))
                         : middle_[index];
  const Vec3d pull = rate_[index] * (goal - vec_cast<double>(position.at(sample)));
  if (away_[index] < turns_within) return pull;
  const Vec3d along = along_bodies(sample, pull);
  const double lost = length(pull - along);
  if (on_upper_edge_[sample] == 0 || lost < head_on * length(pull)) return along;
  return along_bodies(sample, along + lost * up_along_bodies(sample));
}

Vec3d Sewing::along_bodies(int sample, Vec3d pull) const {
  for (int round = 0; round < max_blocking; ++round)
    for (const Vec3f& normal : blocked_[sample]) {
      const auto out = vec_cast<double>(normal);
      pull -= std::min(0.0, dot(pull, out)) * out;
    }
  return pull;
}

Vec3d Sewing::up_along_bodies(int sample) const {
  Vec3d up{0, 1, 0};
  for (const Vec3f& normal : blocked_[sample]) {
    const auto out = vec_cast<double>(normal);
    up -= dot(up, out) * out;
  }
  return up;
}

void Sewing::find_panel_pulls(const Planes3& position, std::size_t step) {
  panels_.begin_step();
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> samples = garment_.sewn.copies(k);
    for (std::size_t i = 0; samples.size() > 1 && i < samples.size(); ++i)
      panels_.add_pull(samples[i],
                       panels_.hold_of(samples[i]) < panels_.hold_of(leaders_[k].front()),
                       pull_of(k, samples[i], position, step));
  }
}

void Sewing::close(ClothState& state) const {
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> copies = garment_.sewn.copies(k);
    const Vec3d middle = mean_of(state.position, copies);
    if (copies.size() < 2 || farthest_from(middle, state.position, copies) > (late_ ? met : closed))
      continue;
    const auto at = vec_cast<float>(late_ ? meeting_place(k, middle) : middle);
    const auto velocity = vec_cast<float>(mean_of(state.velocity, copies));
    for (const int s : garment_.sewn.mates(k)) {
      state.position.set(s, at);
      state.velocity.set(s, velocity);
    }
  }
}

Vec3d Sewing::meeting_place(int index, Vec3d middle) const {
  Vec3d way = middle - began_at_[index];
  for (int round = 0; round < max_blocking; ++round)
    for (const int s : garment_.sewn.copies(index)) way = along_bodies(s, way);
  return began_at_[index] + way;
}

BorderMates Sewing::joined(const Planes3& position) const {
  const BorderMates& sewn = garment_.sewn;
  std::vector<MateInterval> runs;
  for (const MateInterval& seam : sewn.intervals()) {
    const int back = seam.turned ? 1 : -1;
    const auto is_closed = [&](int k) {
      const int sample = sewn.sample_at(sewn.along_border(seam.first, k));
      return !is_unpicked(sample) &&
             position.at(sample) ==
                 position.at(sewn.sample_at(sewn.along_border(seam.mate, back * k)));
    };
    for (int k = 0, begin = 0; k <= seam.count + 1; ++k) {
      if (k <= seam.count && is_closed(k)) continue;
      if (k - begin > 1)
        runs.push_back({sewn.along_border(seam.first, begin),
                        sewn.along_border(seam.mate, back * begin), k - begin - 1, seam.turned});
      begin = k + 1;
    }
  }
  return {sewn.size(), sewn.charts(), runs};
}

bool Sewing::is_closed(const Planes3& position) const {
  const auto meets = [&](const std::array<int, 2>& pair) {
    return position.at(pair[0]) == position.at(pair[1]);
  };
  return std::all_of(garment_.seams.begin(), garment_.seams.end(), [&](const GarmentSeam& seam) {
    return std::all_of(seam.pairs.begin(), seam.pairs.end(), meets);
  });
}

bool Sewing::is_tight(const Planes3& position) const {
  const std::vector<double> all = stretches(position);
  return std::any_of(all.begin(), all.end(), [](double stretch) { return stretch > tight; });
}

std::vector<double> Sewing::gaps(const Planes3& position) const {
  std::vector<double> gaps;
  for (const GarmentSeam& seam : garment_.seams) {
    double most = 0;
    for (const auto& [a, b] : seam.pairs)
      most = std::max(most, length(vec_cast<double>(position.at(b) - position.at(a))));
    gaps.push_back(most);
  }
  return gaps;
}

}  // namespace weft
