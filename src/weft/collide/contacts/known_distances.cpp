#include "weft/collide/contacts/known_distances.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Bounds are kept up to this many gaps.
constexpr double known_gaps = 6;
/// Approaches of bodies below this part of a gap need no sharper bound.
constexpr double known_well = 0.5;
/// Generous bound of the relative rounding error of distances in single precision.
constexpr double distance_rounding = 1e-6;

/// Values for each column of a row.
constexpr int columns_of_motion = 8;

}  // namespace

KnownDistances::KnownDistances(int size, double gap)
    : size_(size),
      blocks_a_side_((size - 1) / BlockMotion::block_size + 1),
      gap_(gap),
      blocks_(static_cast<std::size_t>(blocks_a_side_) * blocks_a_side_),
      place_(size),
      seen_(size),
      travelled_(size, size),
      distance_(size, size),
      others_(size, size),
      triangles_(static_cast<std::size_t>(size) * size, -1) {}

std::size_t KnownDistances::block_of(int sample) const {
  return static_cast<std::size_t>(sample / size_ / BlockMotion::block_size) * blocks_a_side_ +
         sample % size_ / BlockMotion::block_size;
}

double KnownDistances::search_reach(double reach) const {
  return std::max(reach, std::min(2 * reach, known_gaps * gap_));
}

Box3f KnownDistances::box_of_block(const Planes3& at, int block) const {
  constexpr float far = HUGE_VALF;
  constexpr int wide = BlockMotion::block_size;
  Box3f box{{far, far, far}, {-far, -far, -far}};
  const int row = block / blocks_a_side_ * wide, col = block % blocks_a_side_ * wide;
  for (int r = row; r < std::min(size_, row + wide); ++r)
    for (int c = col; c < std::min(size_, col + wide); ++c) {
      box.lower = min(box.lower, at.at(r, c));
      box.upper = max(box.upper, at.at(r, c));
    }
  return box;
}

/// Body parts that never come within `reach` of a block in a step stay more than twice the largest
/// known distance away from its samples, as long as none of these moves by more than that distance;
/// so they invalidate no bound.
void KnownDistances::begin(const MovingCloth& cloth, const ContactBody& body, ThreadTeam& team) {
  if (motion_ == body.motion) return;
  motion_ = body.motion;
  if (body.blocks == nullptr) {
    for (Block& block : blocks_) block.now = {};
    return;
  }
  const auto reach = static_cast<float>(3 * known_gaps * gap_);
  lists_.resize(static_cast<std::size_t>(team.size()));
  team.run([&](Worker& worker) {
    const Range mine = worker.share(static_cast<int>(blocks_.size()));
    std::vector<int>& list = lists_[static_cast<std::size_t>(worker.rank())];
    for (int b = mine.first; b < mine.last; ++b)
      blocks_[static_cast<std::size_t>(b)].now =
          body.blocks->near(box_of_block(cloth.start, b), reach, known_well * gap_, list);
  });
}

void KnownDistances::arrive(int motion) {
  if (motion_ != motion) return distance_.fill(0);  // the motion was never looked at
  for (Block& block : blocks_) {
    block.carried += block.now.displacement;
    block.travelled += block.now.approach;
    block.now = {};
  }
}

KnownDistances::Scratch KnownDistances::make_scratch() const {
  return Scratch(static_cast<std::size_t>(columns_of_motion) * size_);
}

void KnownDistances::find_reaches(const Look& look, int row, Scratch& scratch, float* reach) {
  const auto n = static_cast<std::size_t>(size_);
  std::array<float*, columns_of_motion> of{};
  for (std::size_t k = 0; k < of.size(); ++k) of[k] = scratch.data() + k * n;
  const Block* blocks = &blocks_[block_of(row * size_)];
  for (std::size_t c = 0; c < n; ++c) {
    const Block& block = blocks[c / BlockMotion::block_size];
    const Vec3f carried = vec_cast<float>(block.carried),
                along = vec_cast<float>(block.now.displacement);
    const std::array values{
        carried.x, carried.y, carried.z, static_cast<float>(block.travelled),
        along.x,   along.y,   along.z,   static_cast<float>(block.now.approach)};
    for (std::size_t k = 0; k < of.size(); ++k) of[k][c] = values[k];
  }
  const Planes3 &start = look.start, &end = look.end;
  look.kernels.reach_row(size_,
                         {{place_.x.row(row), place_.y.row(row), place_.z.row(row)},
                          travelled_.row(row),
                          {seen_.x.row(row), seen_.y.row(row), seen_.z.row(row)},
                          distance_.row(row)},
                         {{start.x.row(row), start.y.row(row), start.z.row(row)},
                          {end.x.row(row), end.y.row(row), end.z.row(row)},
                          {of[0], of[1], of[2]},
                          of[3],
                          {of[4], of[5], of[6]},
                          of[7],
                          static_cast<float>(look.margin),
                          static_cast<float>(known_gaps * gap_),
                          static_cast<float>(look.body.max_approach)},
                         reach);
}

void KnownDistances::set(int sample, Vec3f start, const Found& found) {
  const Block& block = blocks_[block_of(sample)];
  const int row = sample / size_, col = sample % size_;
  place_.set(row, col, start - vec_cast<float>(block.carried));
  travelled_(row, col) = static_cast<float>(block.travelled);
  distance_(row, col) =
      static_cast<float>((1 - distance_rounding) * std::min(found.distance, known_gaps * gap_));
  others_(row, col) =
      static_cast<float>((1 - distance_rounding) * std::min(found.others, known_gaps * gap_));
  if (found.triangle >= 0) triangles_[sample] = found.triangle;
}

double KnownDistances::closest_up_to(int sample, Vec3f start) const {
  const int row = sample / size_, col = sample % size_;
  const float others = others_(row, col), distance = distance_(row, col);
  if (triangles_[sample] < 0 || !(distance > 0) || !(others > distance)) return 0;
  const Block& block = blocks_[block_of(sample)];
  const Vec3d moved =
      vec_cast<double>(start) - block.carried - vec_cast<double>(place_.at(row, col));
  const double since = length(moved) + std::max(0.0, block.travelled - travelled_(row, col));
  const double off = distance_rounding *
                     (length(vec_cast<double>(start)) + length(block.carried) + block.travelled);
  const double left = others - since - off;
  return left > distance - since ? left : 0;
}

}  // namespace weft
