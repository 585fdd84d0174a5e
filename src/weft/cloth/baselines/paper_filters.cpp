#include "weft/cloth/baselines/paper_filters.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/neighbours.h"

namespace weft {

namespace {

/// Columns of one side that are filtered at a time.
constexpr int side_lanes = 4;

FilterGrid uniform_patch(int size, double ratio) {
  FilterGrid patch;
  patch.size = size;
  patch.particle_of.resize(static_cast<std::size_t>(size) * size);
  std::iota(patch.particle_of.begin(), patch.particle_of.end(), 0);
  patch.mass.assign(patch.particle_of.size(), 1.0);
  for (Grid<double>& plane : patch.stiffness) plane = Grid<double>(size, size, ratio);
  patch.time_step = 1;
  return patch;
}

}  // namespace

LocalFilter::LocalFilter(int image_size, int patch_size, double ratio, ThreadTeam& team)
    : size_(image_size),
      patch_(patch_size),
      half_(patch_size / 2),
      lanes_((half_ + side_lanes - 1) / side_lanes * side_lanes),
      kernels_(filtering_kernels_for(team.instructions())),
      centred_(static_cast<std::size_t>(patch_) * patch_ * (half_ + 1)),
      beside_(static_cast<std::size_t>(patch_) * patch_ * patch_ * lanes_),
      lines_(2 * (half_ + 1) * team.size(), image_size) {
  const Grid<float> w = filter_matrix(uniform_patch(patch_, ratio), team);
  float *centred = centred_.data(), *beside = beside_.data();
  for (int place = 0; place < patch_; ++place)
    for (int row = 0; row < patch_; ++row) {
      // Averages mirror images, which differ by rounding.
      const auto weight = [&](int col, int to) {
        const int i = place * patch_ + col;
        const float one = w(i, row * patch_ + to);
        return place == half_ ? 0.5F * (one + w(i, (patch_ - 1 - row) * patch_ + to)) : one;
      };
      for (int distance = 0; distance <= half_; ++distance)
        *centred++ = 0.5F * (weight(half_, half_ - distance) + weight(half_, half_ + distance));
      for (int to = 0; to < patch_; ++to)
        for (int col = 0; col < lanes_; ++col) *beside++ = col < half_ ? weight(col, to) : 0.0F;
    }
}

PatchWeights LocalFilter::weights(int patch_row) const {
  const std::size_t rows = static_cast<std::size_t>(patch_row) * patch_;
  return {half_, patch_row == half_ ? half_ + 1 : patch_, lanes_, &centred_[rows * (half_ + 1)],
          &beside_[rows * patch_ * lanes_]};
}

void LocalFilter::apply_plane_row(const Grid<float>& in, Grid<float>& out, int row,
                                  const Worker& worker) {
  const int top = std::clamp(row - half_, 0, size_ - patch_);
  const PatchWeights patch = weights(row - top);
  const int scratch = 2 * (half_ + 1) * worker.rank();
  std::array<const float*, largest_patch> rows{};
  for (int k = 0; k < patch.rows; ++k) {
    rows[k] = in.row(top + k);
    // Rows at the same distance above and below have the same weight and are added first.
    if (row - top != half_ || k == half_) continue;
    float* both = lines_.row(scratch + k);
    kernels_.add_rows(size_, rows[k], in.row(top + patch_ - 1 - k), both);
    rows[k] = both;
  }
  kernels_.patch_row(size_, rows.data(), patch, lines_.row(scratch + half_ + 1), out.row(row));
}

void LocalFilter::apply_row(const Planes3& in, Planes3& out, int row, const Worker& worker) {
  apply_plane_row(in.x, out.x, row, worker);
  apply_plane_row(in.y, out.y, row, worker);
  apply_plane_row(in.z, out.z, row, worker);
}

namespace {

/// The masses of particles, distributed to the coarse samples by bilinear weights; the sum is kept.
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
    for (int c = 0; c < size_; ++c) to[c] += (1 - v) * low[c] + v * high[c];
  };
  add(along_.x, out.x.row(row));
  add(along_.y, out.y.row(row));
  add(along_.z, out.z.row(row));
}

}  // namespace weft
