#pragma once

#include "weft/convert.h"

namespace weft::test {

inline ConvertOptions sized(int size) {
  ConvertOptions options;
  options.size = size;
  return options;
}

inline ConvertOptions unmeasured(int size) {
  ConvertOptions options = sized(size);
  options.measure = false;
  return options;
}

inline ConvertOptions single_chart() {
  ConvertOptions options;
  options.charts = ChartChoice::one;
  return options;
}

}  // namespace weft::test
