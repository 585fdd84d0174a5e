#pragma once

#include <filesystem>

#include "tests/support/patterns.h"
#include "weft/files.h"
#include "weft/scene.h"

namespace weft::test {

/// A tube of two panels, `width` by `height` [cm], 24 cm apart about the y axis from 1 m up; its
/// pattern is written to `file`. Samples are `spacing` [m] apart; its upper edges have the label.
inline SceneCloth tube_cloth(const std::filesystem::path& file, double width, double height,
                             double spacing, const std::string& label = "") {
  write_file(file, [&](std::ostream& out) {
    out << tube_pattern(width, height, /*apart=*/24, /*low=*/100, label);
  });
  SceneCloth cloth;
  cloth.name = file.stem().string();
  cloth.surface = file.string();
  cloth.spacing = spacing;
  return cloth;
}

/// A ball, 15 cm across, that such tubes are sewn round, `up` [m] on the y axis.
inline SceneBody ball_in_tube(double up, int size = 33) {
  SceneBody body;
  body.surface = "builtin:sphere";
  body.size = size;
  body.placement.scale = {0.15, 0.15, 0.15};
  body.placement.translate = {0, up, 0};
  return body;
}

}  // namespace weft::test
