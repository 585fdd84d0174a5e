#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "weft/contact.h"
#include "weft/drawing.h"
#include "weft/geometry_image.h"

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

// Colours of samples, linear RGB [n x n]; `colours` is made to fit. Samples without data are pale.

/// Colours strain: blue where cloth is shorter than at rest, red where longer, full at the strain
/// limit.
/// @param strains  see Simulation::strain_at_samples @param limit  of the material; 0: none
void colour_strain(const Grid<float>& strains, double limit, Planes3& colours);
/// Colours corrections over the rest spacing on a logarithmic scale, from 1e-6 (pale) to 1 (dark).
void colour_residual(const Grid<float>& corrections, Planes3& colours);
/// Colours samples that touch bodies or the ground, and those that touch cloth.
void colour_contacts(std::span<const Contact> contacts, int size, Planes3& colours);
/// Colours a band along the border: one colour for both sides of a seam; open borders dark.
void colour_mates(const BorderMates& mates, Planes3& colours);
/// Colours the cells that are one texel of a level of the mip pyramid.
void colour_mip(int level, int size, Planes3& colours);
/// Colours the spacing of samples in space over its mean, as stretch_colour.
void colour_stretch(const Planes3& positions, Planes3& colours);
/// Colours positions as a geometry image does: x, y, z within their box.
void colour_positions(const Planes3& positions, Planes3& colours);

/// Legend of a colouring; without marks where there is no scale. @param limit  of strain
Legend legend_of(const Colouring& colouring, double limit);

}  // namespace weft::viewer
