#pragma once

#include <span>
#include <vector>

namespace weft {

/// Two runs of border samples that are the same curve, walked in opposite directions: border
/// positions first + k and mate - k, for k in 0 .. count, modulo 4 (n - 1), are one surface point
/// each.
struct MateInterval {
  int first = 0, mate = 0, count = 0;
  friend bool operator==(const MateInterval&, const MateInterval&) = default;
};

/// Which samples of an image's border are the same point of the surface. Classes may have any size,
/// so cut nodes of any valence fit. Border positions run from 0 at (row 0, col 0) along row 0, then
/// up the last column, back along the last row and down the first column: 4 (n - 1) in all.
class BorderMates {
 public:
  BorderMates() = default;
  /// @param intervals  positions in 0 .. 4 (n - 1), the last being the first again; counts in
  ///                   1 .. 2 (n - 1); no border edge in two runs, so that every border gives a
  ///                   manifold
  /// @throws InputError when n < 2, a position or count is out of range, or runs overlap
  BorderMates(int size, std::vector<MateInterval> intervals);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const std::vector<MateInterval>& intervals() const { return intervals_; }
  /// Classes of two samples or more, each ascending; ordered by their least sample (row * n + col).
  [[nodiscard]] int class_count() const { return static_cast<int>(starts_.size()) - 1; }
  [[nodiscard]] std::span<const int> mates(int index) const {
    return std::span(samples_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }
  /// The least sample of the class of `sample`, or the sample itself.
  [[nodiscard]] int representative(int sample) const;

 private:
  void collect_classes();

  int size_ = 0;
  std::vector<MateInterval> intervals_;
  std::vector<int> starts_{0}, samples_;    // classes, compressed rows
  std::vector<int> border_representative_;  // [4 (n - 1)] by border position
};

/// Sample index of a border position, and back (-1 for an interior sample).
int border_sample(int size, int position);
int border_position(int size, int sample);

}  // namespace weft
