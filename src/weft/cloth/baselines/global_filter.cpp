#include "weft/cloth/baselines/global_filter.h"

#include <algorithm>
#include <utility>

#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/baselines/mass_springs.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// The masses of particles moved to the coarse samples by bilinear weights; their sum is kept.
/// @return [n_g^2], not yet summed over mates
std::vector<double> restricted_masses(const Cloth& cloth, int coarse, int stride) {
  std::vector<double> masses(static_cast<std::size_t>(coarse) * coarse);
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      const double mass = double{cloth.mass(r, c)} * cloth.owner(r, c);
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

GlobalFilter::GlobalFilter(const Cloth& cloth, const Options& options, ThreadTeam& team)
    : size_(cloth.size),
      coarse_(options.size),
      stride_((cloth.size - 1) / (options.size - 1)),
      difference_(options.difference),
      kernels_(filtering_kernels_for(team.instructions())),
      particle_of_(static_cast<std::size_t>(options.size) * options.size),
      along_{Grid<float>(coarse_, size_), Grid<float>(coarse_, size_),
             Grid<float>(coarse_, size_)} {
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
  matrix_ = filter_matrix(grid, team);
  sampled_ = filtered_ = Vectors3(static_cast<int>(sample_of_.size()));
}

void GlobalFilter::filter(const Planes3& in, Worker& worker) {
  const Range particles = worker.share(static_cast<int>(sample_of_.size()));
  for (int p = particles.first; p < particles.last; ++p) sampled_.set(p, in.at(sample_of_[p]));
  worker.barrier();
  kernels_.dense_rows(particles.first, particles.last, {matrix_.row(0), matrix_.stride()},
                      std::as_const(sampled_).rows(), filtered_.rows());
  worker.barrier();
  const Range rows = worker.share(coarse_);
  for (int r = rows.first; r < rows.last; ++r) {
    for (int c = 0; c < coarse_; ++c) {
      const int particle = particle_of_[r * coarse_ + c];
      const Vec3f filtered = filtered_.at(particle);
      const Vec3f change = difference_ ? filtered - sampled_.at(particle) : filtered;
      along_.x(r, c * stride_) = change.x;
      along_.y(r, c * stride_) = change.y;
      along_.z(r, c * stride_) = change.z;
    }
    interpolate_row(along_.x.row(r));
    interpolate_row(along_.y.row(r));
    interpolate_row(along_.z.row(r));
  }
}

void GlobalFilter::interpolate_row(float* row) const {
  for (int first = 0; first + stride_ < size_; first += stride_) {
    const float a = row[first], b = row[first + stride_];
    for (int c = 1; c < stride_; ++c) {
      const float u = static_cast<float>(c) / static_cast<float>(stride_);
      row[first + c] = (1 - u) * a + u * b;
    }
  }
}

void GlobalFilter::add_row(Planes3& out, int row) const {
  const int r0 = std::min(row / stride_, coarse_ - 2);
  const float v = static_cast<float>(row - r0 * stride_) / static_cast<float>(stride_);
  const auto add = [&](const Grid<float>& from, float* to) {
    const float *low = from.row(r0), *high = from.row(r0 + 1);
#pragma omp simd
    for (int c = 0; c < size_; ++c) to[c] += (1 - v) * low[c] + v * high[c];
  };
  add(along_.x, out.x.row(row));
  add(along_.y, out.y.row(row));
  add(along_.z, out.z.row(row));
}

}  // namespace weft
