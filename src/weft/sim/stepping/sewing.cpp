#include "weft/sim/stepping/sewing.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace weft {
namespace {

/// Seams close by this part of their distance in a second, within these speeds. [1/s], [m/s]
constexpr double closing_rate = 4, slowest = 0.05, fastest = 1;
/// Time in which they reach that speed. [s]
constexpr double set_off = 0.25;
/// Gravity fades in between these times where a seam stays open. [s]
constexpr double gravity_from = 1.5, gravity_to = 2;
/// Distance of samples that become one. [m]
constexpr double closed = 1e-5;

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

}  // namespace

double Sewing::gravity_part(double seconds) {
  return std::clamp((seconds - gravity_from) / (gravity_to - gravity_from), 0.0, 1.0);
}

void Sewing::pull(double time_step, double seconds, ClothState& state) const {
  const double begun = std::min(1.0, (seconds + time_step) / set_off);
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> samples = garment_.sewn.copies(k);
    if (samples.size() < 2) continue;
    const Vec3d middle = mean_of(state.position, samples);
    const Vec3d velocity = mean_of(state.velocity, samples);
    const double away = farthest_from(middle, state.position, samples);
    const double speed = begun * std::clamp(closing_rate * away, slowest, fastest);
    const double per_distance = speed * time_step < away ? speed / away : 1 / time_step;
    for (const int s : samples)
      state.velocity.set(
          s, vec_cast<float>(velocity +
                             per_distance * (middle - vec_cast<double>(state.position.at(s)))));
  }
}

bool Sewing::is_closed(const Planes3& position) const {
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> samples = garment_.sewn.copies(k);
    if (farthest_from(mean_of(position, samples), position, samples) > closed) return false;
  }
  return true;
}

void Sewing::close(ClothState& state) const {
  for (int k = 0; k < garment_.sewn.class_count(); ++k) {
    const std::span<const int> copies = garment_.sewn.copies(k);
    const auto at = vec_cast<float>(mean_of(state.position, copies));
    const auto velocity = vec_cast<float>(mean_of(state.velocity, copies));
    for (const int s : garment_.sewn.mates(k)) {
      state.position.set(s, at);
      state.velocity.set(s, velocity);
    }
  }
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
