#pragma once

#include <functional>
#include <string>
#include <vector>

#include "weft/core/vec.h"
#include "weft/view/picture.h"

namespace weft {

/// What the colours of a drawing mean.
struct Legend {
  std::string title;
  std::function<Vec3f(double)> colour;  ///< of a place of the scale in [0, 1], display space
  struct Mark {
    double place = 0;  ///< in [0, 1]
    std::string label;
  };
  std::vector<Mark> marks;
};
/// The scale of stretch_colour.
Legend stretch_legend(const std::string& title);
/// The scale of amount_colour. @param largest  what the end of the scale stands for, with its unit
Legend amount_legend(const std::string& title, const std::string& largest);

/// Puts a strip with the scale below the picture, as wide as it is.
void add_legend(Picture& picture, const Legend& legend);
/// The height of such a strip [pixels].
int legend_height(int width);

}  // namespace weft
