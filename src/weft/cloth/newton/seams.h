#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "weft/cloth/newton/coarse_seams.h"
#include "weft/cloth/newton/level_layout.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/geometry_image.h"

namespace weft {

/// An edge along a border of a level, from (row, col) to the right or below.
struct BorderEdge {
  bool along_row = true;
  int row = 0, col = 0;
  bool operator==(const BorderEdge&) const = default;
};

/// The classes of seam copies (mates) of a level: samples that are one particle; on coarse levels
/// also hanging nodes, which hand what they have to those that they hang from, and get a mean of
/// their values. Each class is processed by one worker; callers place barriers before and after.
class Seams {
 public:
  Seams() = default;
  /// @param layout  of the charts of the mates
  Seams(const BorderMates& mates, const LevelLayout& layout);
  /// Of a coarse level.
  Seams(const CoarseSeams& coarse, const LevelLayout& layout);

  [[nodiscard]] bool empty() const { return starts_.size() <= 1; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int class_count() const { return static_cast<int>(starts_.size()) - 1; }
  /// Of all classes together.
  [[nodiscard]] int copies() const { return starts_.back(); }
  /// Samples, row * n + col, ascending.
  [[nodiscard]] std::span<const int> samples(int index) const {
    return std::span(samples_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }

  [[nodiscard]] std::span<const HangingNode> hanging() const { return hanging_; }
  /// Groups of border edges that join the same two particles, two or more each, for lines that
  /// couple by the sums of their groups. Left out is what would make such a line indefinite, so
  /// that solving for it diverges: groups whose edges follow each other on a line, as where a seam
  /// ends in a side that is sewn to itself, and one edge of a corner at which a seam turns that
  /// goes straight on in another chart, as without the coupling across the corner the others are no
  /// part of a positive matrix.
  [[nodiscard]] const std::vector<std::vector<BorderEdge>>& edges() const { return edges_; }

  /// Every copy gets the sum over its class, added in ascending order of samples.
  void sum(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const;
  /// Every copy gets the sum over its class of what it has beside a field that copies have alike,
  /// and that field once.
  void sum_beside(const Workers& workers, const PaddedVectors& alike, PaddedVectors& field) const;
  /// The sum for the first planes of a set. @param kept  gets what copies had [copies() x count]
  void sum(const Workers& workers, int count, PlaneSet& planes, float* kept) const;
  /// Gives it back to them.
  void restore(const Workers& workers, int count, const float* kept, PlaneSet& planes) const;
  /// Every copy gets the mean.
  void average(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const;
  /// Every copy gets the value of the first.
  void copy(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const;
  /// Every copy is divided by the number of copies; hanging nodes have no share.
  void share(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const;

 private:
  /// A hanging node, for a class that it hangs from.
  struct Hung {
    int sample = 0;
    std::ptrdiff_t place = 0;
    float weight = 0;
  };
  void set_classes(const std::vector<std::vector<int>>& classes, const LevelLayout& layout);
  void hang(const std::vector<HangingNode>& nodes);
  void find_edges(const LevelLayout& layout);
  /// What hangs from a class has beside a field, weighed.
  [[nodiscard]] float hung(const float* plane, int index, const float* alike = nullptr) const;
  /// Every hanging node gets the mean of the values that it hangs from.
  void interpolate(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const;
  template <class Value>
  void set_copies(const Workers& workers, std::initializer_list<PaddedPlane*> planes,
                  const Value& value) const;
  [[nodiscard]] std::span<const std::ptrdiff_t> places_of(int index) const {
    return std::span(places_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }
  [[nodiscard]] std::span<const Hung> hung_from(int index) const {
    return std::span(hung_).subspan(hung_starts_[index],
                                    hung_starts_[index + 1] - hung_starts_[index]);
  }
  [[nodiscard]] std::ptrdiff_t place_of(int sample) const {
    return sample / size_ * PaddedPlane::stride_for(size_) + sample % size_;
  }

  int size_ = 0;
  std::vector<int> starts_{0}, samples_;
  std::vector<std::ptrdiff_t> places_;  // of the samples, from the first element of a plane
  std::vector<std::vector<BorderEdge>> edges_;
  std::vector<float> inverse_count_;  // of each class
  std::vector<int> hung_starts_{0};   // of each class, in hung_
  std::vector<Hung> hung_;
  std::vector<HangingNode> hanging_;
};

}  // namespace weft
