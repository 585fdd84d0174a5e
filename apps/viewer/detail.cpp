#include "apps/viewer/detail.h"

#include <algorithm>

namespace weft::viewer {
namespace {

/// Longest time to draw a picture while things move [s].
constexpr double slow = 0.045;
/// Time without motion after which a picture is drawn finely [s].
constexpr double calm = 0.25;
constexpr int coarsest_pixel = 3;

}  // namespace

void Detail::begin(bool moves, double now) {
  if (moves) moved_ = now;
  is_fine_ = fine_once_ || !is_slow_ || now - moved_ > calm;
  fine_once_ = false;
  ++pictures_;
}

void Detail::end(double seconds) {
  if (is_fine_) {
    is_slow_ = seconds > slow;
    return;
  }
  if (keeps_light() && seconds > slow) coarse_pixel_ = std::min(coarse_pixel_ + 1, coarsest_pixel);
  // Fine pictures have four samples in each pixel; they are tried again once they would be quick.
  const int samples = 4 * coarse_pixel_ * coarse_pixel_;
  if (samples * seconds < slow) is_slow_ = false;
}

bool Detail::wants_finer(double now) const { return !is_fine_ && now - moved_ > calm; }

}  // namespace weft::viewer
