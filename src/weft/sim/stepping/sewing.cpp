#include "weft/sim/stepping/sewing.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace weft {
namespace {

/// Seams close within a time in which no sample goes faster, which is at least this. [m/s], [s]
constexpr double fastest = 1, least_time = 0.2;
/// Speed of samples that were held back. [m/s]
constexpr double late_speed = 0.25;
/// What was held back is let go in the first part of each such time. [s]
constexpr double let_go_for = 0.08, let_go_every = 0.2;
/// Distance up to which the samples of a class take turns in being where the others go to: where
/// one is held back at their mean, it is free where it is. [m]
constexpr double turns_within = 0.005;
/// Part of its speed that a cloth loses in a second while seams close.
constexpr double damping = 6;
/// Where a seam stays open gravity fades in after this time, and in this one. [s]
constexpr double gravity_after = 1.5, gravity_fades = 0.5;
/// Distance from their mean at which samples become one. [m]
constexpr double closed = 5e-5;

Vec3d mean_of(const Planes3& planes, std::span<const int> samples) {
  Vec3d sum;
  for (const int s : samples) sum += vec_cast<double>(planes.at(s));
  return (1 / static_cast<double>(samples.size())) * sum;
}

double farthest_from(Vec3d middle, const Planes3& planes, std::span<const int> samples) {
  double most = 0;
  for (const int s : samples)
    most = std::max(most, length(vec_cast<double>(planes.at(s)) - middle));
  return most;
}

/// The part of the distances that is left: it falls from 1 to 0, slowly at first and at last.
double part_left(double seconds, double time_to_close) {
  const double t = std::min(1.0, seconds / time_to_close);
  return 1 - t * t * (3 - 2 * t);
}

void damp(double time_step, Planes3& velocity) {
  const auto kept = static_cast<float>(1 / (1 + damping * time_step));
  for (int s = 0; s < velocity.size() * velocity.size(); ++s)
    velocity.set(s, kept * velocity.at(s));
}

}  // namespace

Sewing::Sewing(const Garment& garment, const Planes3& start)
    : garment_(garment), middle_(garment.sewn.class_count()), away_(garment.sewn.class_count()) {
  measure(start);
  const double farthest = away_.empty() ? 0 : *std::max_element(away_.begin(), away_.end());
  // part_left is steepest in the middle, by 1.5.
  time_to_close_ = std::max(least_time, 1.5 * farthest / fastest);
}

void Sewing::measure(const Planes3& position) {
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> samples = garment_.sewn.copies(k);
    if (samples.size() < 2) continue;
    middle_[k] = mean_of(position, samples);
    away_[k] = farthest_from(middle_[k], position, samples);
  }
}

double Sewing::kept_part(double away, double time_step, double seconds) const {
  if (!(away > 0)) return 0;
  const double left = part_left(seconds, time_to_close_);
  if (left > 0)
    return std::max(part_left(seconds + time_step, time_to_close_) / left,
                    1 - fastest * time_step / away);
  if (std::fmod(seconds - time_to_close_, let_go_every) >= let_go_every - let_go_for) return 1;
  return std::max(0.0, 1 - late_speed * time_step / away);
}

double Sewing::gravity_part(double seconds) const {
  const double since = seconds - std::max(gravity_after, time_to_close_);
  return std::clamp(since / gravity_fades, 0.0, 1.0);
}

void Sewing::pull(double time_step, double seconds, ClothState& state) {
  damp(time_step, state.velocity);
  measure(state.position);
  const auto step = static_cast<std::size_t>(std::llround(seconds / time_step));
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> samples = garment_.sewn.copies(k);
    if (samples.size() < 2) continue;
    const Vec3d velocity = mean_of(state.velocity, samples);
    const Vec3d goal = away_[k] < turns_within
                           ? vec_cast<double>(state.position.at(samples[step % samples.size()]))
                           : middle_[k];
    const double rate = (1 - kept_part(away_[k], time_step, seconds)) / time_step;
    for (const int s : samples) {
      const Vec3d to_goal = goal - vec_cast<double>(state.position.at(s));
      state.velocity.set(s, vec_cast<float>(velocity + rate * to_goal));
    }
  }
}

void Sewing::close(ClothState& state) const {
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> copies = garment_.sewn.copies(k);
    const Vec3d middle = mean_of(state.position, copies);
    if (copies.size() < 2 || farthest_from(middle, state.position, copies) > closed) continue;
    const auto at = vec_cast<float>(middle);
    const auto velocity = vec_cast<float>(mean_of(state.velocity, copies));
    for (const int s : garment_.sewn.mates(k)) {
      state.position.set(s, at);
      state.velocity.set(s, velocity);
    }
  }
}

BorderMates Sewing::joined(const Planes3& position) const {
  const BorderMates& sewn = garment_.sewn;
  std::vector<MateInterval> runs;
  for (const MateInterval& seam : sewn.intervals()) {
    const int back = seam.turned ? 1 : -1;
    const auto is_closed = [&](int k) {
      return position.at(sewn.sample_at(sewn.along_border(seam.first, k))) ==
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
