#pragma once

#include <string>
#include <vector>

#include "weft/picture.h"

namespace weft::bench {

struct PlotPoint {
  double x = 0, y = 0;  ///< > 0
};
/// Points of one kind, joined in their order.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
};
struct Plot {
  std::string x_label, y_label;
  std::vector<PlotSeries> series;
};

/// Both axes logarithmic, with lines at 1, 2 and 5 times every power of ten; a legend at the right.
Picture draw_plot(const Plot& plot);

}  // namespace weft::bench
