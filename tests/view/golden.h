#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "weft/picture.h"

namespace weft {

/// How far a picture may be from its golden one: drivers round and choose samples differently.
struct GoldenTolerance {
  double mean = 1.0;        ///< mean difference of a channel, of 255
  int largest = 60;         ///< a channel that differs by more counts as an outlier
  double outliers = 0.002;  ///< share of channels that may be outliers
};

/// Compares a picture with tests/golden/NAME.png. On failure the picture and a picture of the
/// difference (eight times enlarged in value) are left in the folder where the test runs, under
/// ctest in the build. With WEFT_UPDATE_GOLDEN=1 in the environment the picture becomes the golden
/// one instead: look at it before it is committed.
inline void expect_golden(const std::string& name, const Picture& picture,
                          const GoldenTolerance& tolerance = {}) {
  namespace fs = std::filesystem;
  const fs::path golden_path = fs::path(WEFT_SOURCE_DIR) / "tests/golden" / (name + ".png");
  if (std::getenv("WEFT_UPDATE_GOLDEN") != nullptr) {
    write_png(golden_path, picture);
    return;
  }
  const Picture golden = read_png(golden_path);
  ASSERT_EQ(picture.width, golden.width);
  ASSERT_EQ(picture.height, golden.height);
  Picture difference = picture;
  double sum = 0;
  std::size_t outliers = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const int apart = std::abs(int{picture.rgb[i]} - int{golden.rgb[i]});
    sum += apart;
    outliers += apart > tolerance.largest ? 1 : 0;
    difference.rgb[i] = static_cast<std::uint8_t>(std::min(255, 8 * apart));
  }
  const double mean = sum / static_cast<double>(picture.rgb.size());
  const double share = static_cast<double>(outliers) / static_cast<double>(picture.rgb.size());
  if (mean <= tolerance.mean && share <= tolerance.outliers) return;
  const fs::path here = fs::current_path();
  write_png(here / (name + ".png"), picture);
  write_png(here / (name + "-difference.png"), difference);
  ADD_FAILURE() << name << " differs from its golden picture: mean " << mean << " of 255, outliers "
                << share << "; see " << (here / (name + "-difference.png")).string();
}

}  // namespace weft
