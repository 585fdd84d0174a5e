#pragma once

#include <filesystem>

namespace weft::figures {

// Pictures of the documents except draped cloth, one file each. All are made from built-in shapes;
// the same machine makes the same bits.

/// repair.png, cube.png
void draw_input(const std::filesystem::path& folder);
/// distance.png, straighten.png, augment.png
void draw_cuts(const std::filesystem::path& folder);
/// border.png, chords.png, maps.png
void draw_maps(const std::filesystem::path& folder);
/// samples.png, pyramid.png, rebuilt.png, mannequin-colours.png, mannequin-map.png
void draw_images(const std::filesystem::path& folder);

/// normal-mapped.png, way.png: figures 1 and 2 of the paper
void draw_papers(const std::filesystem::path& folder);
/// filters.png: figure 3 of the paper, by weights that were computed
void draw_filters(const std::filesystem::path& folder);

}  // namespace weft::figures
