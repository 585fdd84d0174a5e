#pragma once

#include <vector>

#include "weft/image/geometry_image.h"
#include "weft/param/square_map.h"
#include "weft/view/picture.h"
#include "weft/view/surface_drawing.h"

namespace weft {

/// A run of the square's border, from border position `first` over `count` sample intervals.
struct BorderBand {
  int first = 0, count = 0;
  Vec3f colour;  ///< display space
};

/// Both runs of each pair of mates in the pair's colour, pairs in order of their least border
/// position.
std::vector<BorderBand> border_bands(const BorderMates& mates);
/// The same of a mapped disk; true borders dark.
std::vector<BorderBand> border_bands(const MappedDisk& mapped);

/// A square picture with a frame around it that shows the bands, nodes (where bands begin and end)
/// as ticks. @param size  n of the bands' border positions
Picture framed_by_mates(const Picture& square, const std::vector<BorderBand>& bands, int size);

/// The curves of a cut on the surface, each pair of mates once, and its nodes: colours as the bands
/// of the same disk.
void add_cut(SurfaceDrawing& drawing, const CutDisk& cut);
/// The border of an image in space, coloured as its bands.
void add_cut(SurfaceDrawing& drawing, const GeometryImage& image);

}  // namespace weft
