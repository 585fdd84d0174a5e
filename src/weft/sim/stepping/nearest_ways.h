#pragma once

#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/contact.h"

namespace weft {

/// For every particle of a cloth how far the pin or obstacle next to it goes in a step: next along
/// the cloth, by samples, and across contacts of layers.
class NearestWays {
 public:
  /// @param cloth  kept by reference
  explicit NearestWays(const Cloth& cloth);
  void clear() noexcept;
  /// What a way comes from.
  enum class Holder : char { none, obstacle, pin };
  /// Puts the way of what holds a sample [m], unless there is one. @param sample  any mate
  void put(int sample, Vec3d way, Holder holder = Holder::obstacle) noexcept;
  /// Hands ways on to the neighbours of the samples that got theirs last.
  /// @return whether any had none
  bool spread() noexcept;
  /// @param sample  any mate @return null where nothing holds the cloth, or ways did not get to
  [[nodiscard]] const Vec3d* at(int sample) const;
  [[nodiscard]] Holder holder_of(int sample) const;

 private:
  void spread_from(int sample, int representative) noexcept;

  const Cloth& cloth_;
  std::vector<Vec3d> way_;      // [n * n] of representatives that are reached
  std::vector<Holder> holder_;  // [n * n] of representatives
  std::vector<int> class_of_;   // [n * n] the class of mates of each sample, -1: it has none
  std::vector<int> ring_;       // representatives that got their way last
  std::vector<int> last_ring_;  // scratch
};

/// Hands ways over from the side of a contact between layers that has one to the other.
/// @param first, second  of the samples with positive and with negative weights; may be the same
void hand_over(const Contact& contact, NearestWays& first, NearestWays& second) noexcept;

}  // namespace weft
