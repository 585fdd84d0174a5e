#include "weft/collide/contacts/block_motion.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Twice a triangle's area along its normal.
Vec3d across(const Planes3& at, const Triangle& t) {
  const Vec3d a = vec_cast<double>(at.at(t[0]));
  return cross(vec_cast<double>(at.at(t[1])) - a, vec_cast<double>(at.at(t[2])) - a);
}

}  // namespace

void SurfaceMotion::measure(const Planes3& start, const Planes3& end,
                            std::span<const Triangle> triangles, ThreadTeam& team) {
  const int samples = start.size() * start.size();
  triangles_.resize(triangles.size());
  points_.resize(static_cast<std::size_t>(samples));
  team.run([&](Worker& worker) {
    const Range mine = worker.share(static_cast<int>(triangles.size()));
    for (int t = mine.first; t < mine.last; ++t) {
      const Vec3d from = across(start, triangles[t]);
      triangles_[t] = {from, across(end, triangles[t]), length(from)};
    }
  });
  sums_.assign(static_cast<std::size_t>(samples), {});
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const int corner : triangles[t]) {
      sums_[corner].from += triangles_[t].from;
      sums_[corner].to += triangles_[t].to;
      sums_[corner].size += triangles_[t].size;
    }
  team.run([&](Worker& worker) {
    const Range mine = worker.share(samples);
    for (int s = mine.first; s < mine.last; ++s) {
      const Vec3d from = normalized(sums_[s].from), to = normalized(sums_[s].to);
      Point& point = points_[s];
      point.displacement = vec_cast<double>(end.at(s)) - vec_cast<double>(start.at(s));
      point.normal = 0.5 * (from + to);
      point.approach = std::abs(dot(point.normal, point.displacement));
      point.turn = length(to - from);
      // The more the triangles tilt, the shorter the sum of their area vectors.
      const double lost = sums_[s].size > 0 ? 1 - length(sums_[s].from) / sums_[s].size : 0;
      point.slant = 2 * std::sqrt(2 * std::max(0.0, lost));
    }
  });
}

double SurfaceMotion::approach(int sample, Vec3d displacement) const {
  const Point& point = points_[sample];
  const Vec3d left = point.displacement - displacement;
  return std::abs(dot(point.normal, left)) + point.slant * length(left);
}

void BlockMotion::measure(const SurfaceGrid& grid, const Planes3& start, const Planes3& end,
                          const SurfaceMotion* slides, ThreadTeam& team) {
  grid_ = &grid;
  start_ = &start;
  end_ = &end;
  slides_ = slides;
  blocks_.clear();
  // Blocks include the first samples of the next ones, so that nothing lies between them.
  const int last = grid.size() - 1;
  for (int r = 0; r < last; r += block_size)
    for (int c = 0; c < last; c += block_size) {
      Block block;
      block.first_row = r;
      block.last_row = std::min(last, r + block_size);
      block.first_col = c;
      block.last_col = std::min(last, c + block_size);
      blocks_.push_back(block);
    }
  team.run([&](Worker& worker) {
    const Range mine = worker.share(static_cast<int>(blocks_.size()));
    for (int b = mine.first; b < mine.last; ++b) measure(blocks_[b]);
  });
}

template <class Visit>
void BlockMotion::for_points(const Block& block, const Visit& visit) const {
  for (int r = block.first_row; r <= block.last_row; ++r)
    for (int c = block.first_col; c <= block.last_col; ++c)
      visit(grid_->point(r * grid_->size() + c));
}

double BlockMotion::approach_of_point(int point, Vec3d displacement) const {
  return slides_ != nullptr ? slides_->approach(point, displacement)
                            : length(displacement_of(point) - displacement);
}

void BlockMotion::measure(Block& block) const {
  constexpr float far = HUGE_VALF;
  block.swept = {{far, far, far}, {-far, -far, -far}};
  for_points(block, [&](int point) {
    for (const Planes3* at : {start_, end_}) {
      block.swept.lower = min(block.swept.lower, at->at(point));
      block.swept.upper = max(block.swept.upper, at->at(point));
    }
    block.displacement += displacement_of(point);
    if (slides_ != nullptr) block.normal += slides_->normal(point);
    ++block.samples;
  });
  block.displacement = (1 / block.samples) * block.displacement;
  block.normal = (1 / block.samples) * block.normal;
  for_points(block, [&](int point) {
    block.apart = std::max(block.apart, approach_of_point(point, block.displacement));
    if (slides_ == nullptr) return;
    block.normal_apart =
        std::max(block.normal_apart, length(slides_->normal(point) - block.normal));
    block.slant = std::max(block.slant, slides_->slant(point));
  });
}

double BlockMotion::bound_of(const Block& block, Vec3d displacement) const {
  const Vec3d other = block.displacement - displacement;
  if (slides_ == nullptr) return block.apart + length(other);
  const double along =
      std::abs(dot(block.normal, other)) + (block.normal_apart + block.slant) * length(other);
  return block.apart + along;
}

double BlockMotion::approach_of(const Block& block, Vec3d displacement) const {
  double maximum = 0;
  for_points(block, [&](int point) {
    maximum = std::max(maximum, approach_of_point(point, displacement));
  });
  return maximum;
}

BlockMotion::Near BlockMotion::near(const Box3f& box, float reach, double enough) const {
  Near found;
  double samples = 0;
  for (const Block& block : blocks_) {
    if (!overlap(block.swept, box, reach)) continue;
    found.displacement += block.samples * block.displacement;
    samples += block.samples;
  }
  if (samples == 0) return found;
  found.displacement = (1 / samples) * found.displacement;
  for (const Block& block : blocks_) {
    if (!overlap(block.swept, box, reach)) continue;
    const double bound = bound_of(block, found.displacement);
    const double wanted = std::max(found.approach, enough);
    found.approach =
        std::max(found.approach, bound <= wanted ? bound : approach_of(block, found.displacement));
  }
  return found;
}

}  // namespace weft
