#pragma once

#include <string>

#include "weft/garment.h"

namespace weft {

/// The panels of a garment as images of their own, as files hold them.
struct PanelImages {
  /// A part for each panel, under its name: R, G, B = x, y, z in the world [m], U, V = where the
  /// sample lies in the pattern's panel [cm]. float32.
  std::string exr;
  /// The same as numpy's arrays PANEL.position [rows x cols x 3] and PANEL.pattern [rows x cols x
  /// 2].
  std::string npz;
};
/// @param samples  of the garment's image, now [m]
PanelImages panel_images(const Garment& garment, const Planes3& samples);

}  // namespace weft
