#include "weft/collide/contacts/block_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

/// Rounding of sums and projections in single precision, generously.
constexpr float bound_rounding = 1e-5F;

/// A quick upper bound of the approach of a block to a point that moves by `displacement`. [m]
double bound_of(const BlockMotion::Block& block, Vec3f displacement) {
  const Vec3f other = block.displacement - displacement;
  const float along = std::abs(dot(block.normal, other)) +
                      (block.normal_apart + block.slant + bound_rounding) * length(other);
  return double{block.apart} + along;
}

}  // namespace

/// Values of columns, side by side in one array.
struct BlockMotion::Columns {
  static constexpr int count = 24;
  MotionColumns gathered{};
  std::array<float*, 3> along{}, mean{};
  float *approach = nullptr, *apart = nullptr;

  Columns(std::vector<float>& space, int size) {
    space.resize(static_cast<std::size_t>(count) * size);
    float* next = space.data();
    const auto take = [&] { return std::exchange(next, next + size); };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      gathered.lower[axis] = take();
      gathered.upper[axis] = take();
      gathered.displacement[axis] = take();
      gathered.normal[axis] = take();
      along[axis] = take();
      mean[axis] = take();
    }
    for (float** one :
         {&gathered.slant, &gathered.turn, &gathered.approach, &gathered.moved, &approach, &apart})
      *one = take();
  }
};

void BlockMotion::set_up(int size) {
  const int last = size - 1;
  blocks_a_side_ = (last + block_size - 1) / block_size;
  blocks_.clear();
  for (int r = 0; r < last; r += block_size)
    for (int c = 0; c < last; c += block_size) {
      Block block;
      block.first_row = r;
      block.last_row = std::min(last, r + block_size);
      block.first_col = c;
      block.last_col = std::min(last, c + block_size);
      blocks_.push_back(block);
    }
  const std::size_t sixteens = (blocks_.size() + 15) / 16 * 16;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower_[axis].assign(sixteens, HUGE_VALF);
    upper_[axis].assign(sixteens, -HUGE_VALF);
  }
  no_normals_.assign(static_cast<std::size_t>(size), 0.0F);
  all_slant_.assign(static_cast<std::size_t>(size), 1.0F);
  row_moved_.resize(static_cast<std::size_t>(blocks_a_side_));
}

void BlockMotion::measure(const SurfaceGrid& grid, const Planes3& start, const Planes3& end,
                          const SurfaceMotion* slides, ThreadTeam& team) {
  if (grid_ == nullptr || grid_->size() != grid.size()) set_up(grid.size());
  grid_ = &grid;
  kernels_ = &motion_kernels_for(team.instructions());
  start_ = &start;
  end_ = &end;
  slides_ = slides;
  scratch_.resize(static_cast<std::size_t>(team.size()));
  team.run([&](Worker& worker) {
    Columns columns(scratch_[static_cast<std::size_t>(worker.rank())], start.size());
    const Range mine = worker.share(blocks_a_side_);
    for (int r = mine.first; r < mine.last; ++r) measure_row(*kernels_, r, columns);
  });
  max_moved_ = *std::max_element(row_moved_.begin(), row_moved_.end());
  max_approach_ = 0;
  for (const Block& block : blocks_)
    max_approach_ = std::max(max_approach_, double{block.approach});
}

/// Without normals a sample counts by its whole displacement: its slant is 1.
MotionBlock BlockMotion::samples_of(const Block& block) const {
  const int row = block.first_row, col = block.first_col;
  const auto at = [&](const Grid<float>& plane) { return plane.row(row) + col; };
  MotionBlock samples{block.last_row - row + 1,
                      block.last_col - col + 1,
                      static_cast<long>(start_->x.stride()),
                      {at(start_->x), at(start_->y), at(start_->z)},
                      {at(end_->x), at(end_->y), at(end_->z)},
                      0,
                      {no_normals_.data(), no_normals_.data(), no_normals_.data()},
                      {no_normals_.data(), no_normals_.data(), no_normals_.data()},
                      all_slant_.data()};
  if (slides_ == nullptr) return samples;
  const SurfaceMotion::Normals &from = slides_->at_start(), &to = slides_->at_end();
  samples.normal_stride = static_cast<long>(from.slant.stride());
  const std::array planes{&from.unit.x, &from.unit.y, &from.unit.z,
                          &to.unit.x,   &to.unit.y,   &to.unit.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    samples.from[axis] = at(*planes[axis]);
    samples.to[axis] = at(*planes[axis + 3]);
  }
  samples.slant = at(from.slant);
  return samples;
}

void BlockMotion::measure_row(const MotionKernels& kernels, int row, Columns& columns) {
  const int first = row * blocks_a_side_, last = first + blocks_a_side_;
  Block whole = blocks_[static_cast<std::size_t>(first)];
  whole.last_col = start_->size() - 1;
  kernels.gather_columns(samples_of(whole), columns.gathered);
  const float* moved = columns.gathered.moved;
  row_moved_[static_cast<std::size_t>(row)] = *std::max_element(moved, moved + start_->size());
  for (int b = first; b < last; ++b) {
    Block& block = blocks_[static_cast<std::size_t>(b)];
    reduce(columns, block);
    const std::array lower{block.swept.lower.x, block.swept.lower.y, block.swept.lower.z};
    const std::array upper{block.swept.upper.x, block.swept.upper.y, block.swept.upper.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower_[axis][static_cast<std::size_t>(b)] = lower[axis];
      upper_[axis][static_cast<std::size_t>(b)] = upper[axis];
    }
  }
  part(kernels, first, last, columns);
}

/// Sums up the columns of a block.
void BlockMotion::reduce(const Columns& columns, Block& block) const {
  const MotionColumns& of = columns.gathered;
  const int first = block.first_col, last = block.last_col + 1;
  const auto least = [&](const float* x) { return *std::min_element(x + first, x + last); };
  const auto most = [&](const float* x) { return *std::max_element(x + first, x + last); };
  const float share =
      1 / static_cast<float>((last - first) * (block.last_row - block.first_row + 1));
  const auto mean = [&](const float* x) {
    float sum = 0;
    for (int c = first; c < last; ++c) sum += x[c];
    return share * sum;
  };
  block.swept = {{least(of.lower[0]), least(of.lower[1]), least(of.lower[2])},
                 {most(of.upper[0]), most(of.upper[1]), most(of.upper[2])}};
  block.displacement = {mean(of.displacement[0]), mean(of.displacement[1]),
                        mean(of.displacement[2])};
  block.normal = {mean(of.normal[0]), mean(of.normal[1]), mean(of.normal[2])};
  block.slant = most(of.slant);
  block.approach = most(slides_ != nullptr ? of.approach : of.moved);
  block.turn = most(of.turn);
}

/// Finds how far the samples of a row of blocks are apart from their blocks' means. Columns that
/// two blocks share are measured against both.
void BlockMotion::part(const MotionKernels& kernels, int first, int last, Columns& columns) {
  const auto set_means = [&](const Block& block, int begin, int end) {
    const std::array along{block.displacement.x, block.displacement.y, block.displacement.z};
    const std::array mean{block.normal.x, block.normal.y, block.normal.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::fill(columns.along[axis] + begin, columns.along[axis] + end, along[axis]);
      std::fill(columns.mean[axis] + begin, columns.mean[axis] + end, mean[axis]);
    }
  };
  Block whole = blocks_[static_cast<std::size_t>(first)];
  whole.last_col = start_->size() - 1;
  for (int b = first; b < last; ++b) {
    const Block& block = blocks_[static_cast<std::size_t>(b)];
    set_means(block, block.first_col, block.last_col + 1);
  }
  kernels.part_columns(samples_of(whole), columns.along.data(), columns.mean.data(),
                       columns.approach, columns.apart);
  for (int b = first; b < last; ++b) {
    Block& block = blocks_[static_cast<std::size_t>(b)];
    // The last column still holds what it is apart from the next block.
    Block shared = block;
    shared.first_col = block.last_col;
    set_means(block, 0, 1);
    float approach = 0, apart = 0;
    kernels.part_columns(samples_of(shared), columns.along.data(), columns.mean.data(), &approach,
                         &apart);
    for (int c = block.first_col; c < block.last_col; ++c) {
      approach = std::max(approach, columns.approach[c]);
      apart = std::max(apart, columns.apart[c]);
    }
    block.apart = (1 + bound_rounding) * approach;
    block.normal_apart = apart + bound_rounding;
  }
}

/// The largest over all samples.
double BlockMotion::approach_of(const Block& block, Vec3f displacement) const {
  constexpr int wide = block_size + 1;
  std::array<std::array<float, wide>, 3> along{}, mean{};
  along[0].fill(displacement.x);
  along[1].fill(displacement.y);
  along[2].fill(displacement.z);
  const std::array<const float*, 3> alongs{along[0].data(), along[1].data(), along[2].data()},
      means{mean[0].data(), mean[1].data(), mean[2].data()};
  std::array<float, wide> approach{}, apart{};
  kernels_->part_columns(samples_of(block), alongs.data(), means.data(), approach.data(),
                         apart.data());
  return double{(1 + bound_rounding) * *std::max_element(approach.begin(), approach.end())};
}

BlockMotion::Near BlockMotion::near(const Box3f& box, float reach, double enough,
                                    std::vector<int>& list) const {
  list.resize(lower_[0].size());
  const BoxRows boxes{{lower_[0].data(), lower_[1].data(), lower_[2].data()},
                      {upper_[0].data(), upper_[1].data(), upper_[2].data()},
                      static_cast<int>(lower_[0].size())};
  const std::array lower{box.lower.x, box.lower.y, box.lower.z},
      upper{box.upper.x, box.upper.y, box.upper.z};
  list.resize(static_cast<std::size_t>(
      kernels_->find_overlaps(boxes, lower.data(), upper.data(), reach, list.data())));
  Near found;
  double samples = 0;
  for (const int b : list) {
    const Block& block = blocks_[static_cast<std::size_t>(b)];
    const double own =
        (block.last_row - block.first_row + 1) * (block.last_col - block.first_col + 1);
    found.displacement += own * vec_cast<double>(block.displacement);
    samples += own;
  }
  if (samples == 0) return found;
  const auto mean = vec_cast<float>((1 / samples) * found.displacement);
  found.displacement = vec_cast<double>(mean);
  for (const int b : list) {
    const Block& block = blocks_[static_cast<std::size_t>(b)];
    const double bound = bound_of(block, mean);
    const double wanted = std::max(found.approach, enough);
    if (bound > found.approach)
      found.approach = std::max(found.approach, bound <= wanted ? bound : approach_of(block, mean));
  }
  return found;
}

}  // namespace weft
