#include "weft/cloth/integrate/global_filter.h"

#include <algorithm>

#include "weft/cloth/integrate/filter_matrix.h"
#include "weft/cloth/integrate/mass_springs.h"
#include "weft/cloth/neighbours.h"
#include "weft/core/ordered_sum.h"

namespace weft {
namespace {

/// The masses of particles moved to the coarse samples by bilinear weights; their sum is kept.
/// @return [n_g^2], not yet summed over mates
std::vector<double> restricted_masses(const Cloth& cloth, int coarse, int stride) {
  std::vector<double> masses(static_cast<std::size_t>(coarse) * coarse);
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      const double mass = double{cloth.mass(r, c)} * cloth.counted(r, c);
      const int r0 = std::min(r / stride, coarse - 2), c0 = std::min(c / stride, coarse - 2);
      const double v = static_cast<double>(r - r0 * stride) / stride;
      const double u = static_cast<double>(c - c0 * stride) / stride;
      const std::size_t at = static_cast<std::size_t>(r0) * coarse + c0;
      masses[at] += (1 - v) * (1 - u) * mass;
      masses[at + 1] += (1 - v) * u * mass;
      masses[at + coarse] += v * (1 - u) * mass;
      masses[at + coarse + 1] += v * u * mass;
    }
  return masses;
}

}  // namespace

GlobalFilter::GlobalFilter(const Cloth& cloth, const Options& options)
    : size_(cloth.size),
      coarse_(options.size),
      stride_((cloth.size - 1) / (options.size - 1)),
      difference_(options.difference),
      particle_of_(static_cast<std::size_t>(options.size) * options.size),
      result_(options.size) {
  const std::vector<double> spread = restricted_masses(cloth, coarse_, stride_);
  std::vector<int> particle_at(static_cast<std::size_t>(size_) * size_, -1);
  for (std::size_t i = 0; i < particle_of_.size(); ++i) {
    const int r = static_cast<int>(i) / coarse_, c = static_cast<int>(i) % coarse_;
    const int sample = cloth.mates.representative(r * stride_ * size_ + c * stride_);
    if (particle_at[sample] < 0) {
      particle_at[sample] = static_cast<int>(sample_of_.size());
      sample_of_.push_back(sample);
      masses_.push_back(0);
    }
    particle_of_[i] = particle_at[sample];
    masses_[particle_of_[i]] += spread[i];
  }
  FilterGrid grid{coarse_, particle_of_, masses_, {}, options.time_step};
  const auto mass_at = [&](int r, int c) { return masses_[particle_of_[r * coarse_ + c]]; };
  double mean = 0;
  for (const double mass : masses_) mean += mass / static_cast<double>(masses_.size());
  for (int d = 0; d < spring_directions; ++d) {
    grid.stiffness[d] = Grid<double>(coarse_, coarse_);
    mass_springs(spring_offsets[d], options.stiffness / mean, mass_at, grid.stiffness[d]);
  }
  matrix_ = filter_matrix(grid);
}

void GlobalFilter::filter(const Planes3& in, Worker& worker) {
  const int count = static_cast<int>(sample_of_.size());
  const auto row_sum = [&](const float* weights, const Grid<float>& plane) {
    return lane_sum(count, [&](int j) {
      const int s = sample_of_[j];
      return double{weights[j]} * plane.row(s / size_)[s % size_];
    });
  };
  // Several samples may be one particle: each sample is computed by itself, to the same bits.
  const Range mine = worker.share(coarse_ * coarse_);
  for (int i = mine.first; i < mine.last; ++i) {
    const int particle = particle_of_[i];
    const float* weights = matrix_.data() + static_cast<std::size_t>(particle) * count;
    const Vec3d filtered{row_sum(weights, in.x), row_sum(weights, in.y), row_sum(weights, in.z)};
    const Vec3d before = vec_cast<double>(in.at(sample_of_[particle]));
    result_.set(i, vec_cast<float>(difference_ ? filtered - before : filtered));
  }
}

void GlobalFilter::add_row(Planes3& out, int row) const {
  const int r0 = std::min(row / stride_, coarse_ - 2);
  const float step = 1 / static_cast<float>(stride_);
  const float v = step * static_cast<float>(row - r0 * stride_);
  const Row3 to = row_of(out, row);
  const ConstRow3 low = row_of(result_, r0), high = row_of(result_, r0 + 1);
  const auto value = [&](const float* a, const float* b, int c0, float u) {
    const float left = (1 - v) * a[c0] + v * b[c0];
    const float right = (1 - v) * a[c0 + 1] + v * b[c0 + 1];
    return (1 - u) * left + u * right;
  };
  for (int c = 0; c < size_; ++c) {
    const int c0 = std::min(c / stride_, coarse_ - 2);
    const float u = step * static_cast<float>(c - c0 * stride_);
    to.x[c] += value(low.x, high.x, c0, u);
    to.y[c] += value(low.y, high.y, c0, u);
    to.z[c] += value(low.z, high.z, c0, u);
  }
}

}  // namespace weft
