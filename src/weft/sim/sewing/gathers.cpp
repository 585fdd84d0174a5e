#include "weft/sim/sewing/gathers.h"

#include <cmath>

#include "weft/cloth/border_springs.h"
#include "weft/cloth/seam_lengths.h"

namespace weft {
namespace {

/// Lengths change this many times, as each change takes new solvers.
constexpr int stages = 16;
/// Springs that are shorter by less than this part begin as they are sewn.
constexpr float min_gathered_part = 0.01F;
/// How far samples begin out of their panels, as a part of what is gathered between them.
constexpr float ripple_part = 1e-4F;

/// The normal of a flat panel, from a cell at one of its samples.
Vec3f normal_at(const BorderMates& mates, const Planes3& positions, int sample) {
  const int row = sample / positions.size(), col = sample % positions.size();
  for (const int r : {row, row - 1})
    for (const int c : {col, col - 1}) {
      if (!mates.has_cell(r, c)) continue;
      const Vec3f corner = positions.at(r, c);
      return normalized(cross(positions.at(r, c + 1) - corner, positions.at(r + 1, c) - corner));
    }
  return {};
}

}  // namespace

Gathers::Gathers(Cloth& cloth) {
  for (const int direction : {stretch_u, stretch_v, bend_u, bend_v}) {
    SpringPlane& plane = cloth.springs[direction];
    for_each_spring(cloth.mates, plane, [&](int r, int c, int r2, int c2) {
      const float flat = spring_length(cloth.rest.at(r, c), cloth.rest.at(r2, c2));
      float& length = plane.rest_length(r, c);
      if (!(length < (1 - min_gathered_part) * flat)) return;
      springs_.push_back({direction, r, c, flat, length});
      length = flat;
    });
  }
}

void Gathers::ripple(const Cloth& cloth, Planes3& start) const {
  const Planes3 flat = start;
  for (const Spring& spring : springs_) {
    if (spring.direction != stretch_u && spring.direction != stretch_v) continue;
    const int sample = spring.row * cloth.size + spring.col;
    // Folds of four samples are the shortest that these show well.
    const float side = ((spring.row + spring.col) & 2) != 0 ? ripple_part : -ripple_part;
    const float away = side * (spring.flat - spring.gathered);
    start.set(sample, flat.at(sample) + away * normal_at(cloth.together(), flat, sample));
  }
}

/// Ahead of the seam: edges that come together have the same length already.
int Gathers::stage_of(double closed) { return static_cast<int>(std::sqrt(closed) * stages); }

float Gathers::rest_length(const Spring& spring, int stage) {
  const float left = 1 - static_cast<float>(stage) / stages;
  return spring.gathered + left * (spring.flat - spring.gathered);
}

bool Gathers::gather(double closed, Cloth& cloth) {
  const int stage = stage_of(closed);
  if (springs_.empty() || stage == stage_) return false;
  stage_ = stage;
  for (const Spring& spring : springs_)
    cloth.springs[spring.direction].rest_length(spring.row, spring.col) =
        rest_length(spring, stage);
  return true;
}

double Gathers::work(double from, double to, const Cloth& cloth, const Planes3& position) const {
  double sum = 0;
  for (const Spring& spring : springs_) {
    const SpringPlane& plane = cloth.springs[spring.direction];
    const double length =
        spring_length(position.at(spring.row, spring.col),
                      position.at(spring.row + plane.down, spring.col + plane.right));
    const double before = length - rest_length(spring, stage_of(from));
    const double after = length - rest_length(spring, stage_of(to));
    sum += 0.5 * plane.stiffness(spring.row, spring.col) * (after * after - before * before);
  }
  return sum;
}

}  // namespace weft
