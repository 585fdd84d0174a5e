#pragma once

#include <vector>

#include "weft/drawing.h"
#include "weft/run_folder.h"

namespace weft::app {

/// The cloths of a run in colours of their strain: blue where shorter than at rest, red where
/// longer.
class StrainColours {
 public:
  /// @throws UsageError where the folder does not tell a cloth's rest shape
  explicit StrainColours(const RunFolder& run);
  /// What 99 of 100 samples have at most, of the cloth that has most. @param cloths  their
  /// positions
  [[nodiscard]] double most_of(const std::vector<Planes3>& cloths) const;
  /// @param strain  shown in full colour, > 0
  void set_full(double strain) { full_ = strain; }
  /// Linear RGB. [n x n]
  [[nodiscard]] Planes3 of(std::size_t cloth, const Planes3& positions) const;
  [[nodiscard]] Legend legend() const;

 private:
  std::vector<RecordedStrain> strains_;
  double full_ = 0.05;
};

/// The next of 1, 2, 5, 10 ... in its decade, at least a hundredth of a percent.
double rounded_scale(double strain);

}  // namespace weft::app
