#pragma once

#include <array>
#include <string_view>

namespace weft::viewer {

/// The quantity that the colours of a surface show.
enum class ColourBy { plain, strain, residual, contacts, mates, mip, stretch, positions };

/// How a surface is coloured.
struct Colouring {
  ColourBy by = ColourBy::plain;
  int level = 3;  ///< of the mip pyramid, 0 the image itself
  friend bool operator==(const Colouring&, const Colouring&) = default;
};

/// In the order of the enumeration, as users read them.
inline constexpr std::array<std::string_view, 8> colour_names{
    "plain", "strain", "residual", "contacts", "mates", "mip level", "stretch", "positions"};

}  // namespace weft::viewer
