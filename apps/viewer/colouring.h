#pragma once

#include <span>
#include <string>

#include "apps/viewer/colour_by.h"
#include "weft/contact.h"
#include "weft/drawing.h"
#include "weft/geometry_image.h"

namespace weft::viewer {

// Colours of samples, linear RGB [n x n]; `colours` is made to fit. Data is pale where there is
// nothing to tell.

/// Blue where cloth is shorter than at rest, red where longer, full at the strain limit.
/// @param strains  see Simulation::strain_at_samples @param limit  of the material; 0: none
void colour_strain(const Grid<float>& strains, double limit, Planes3& colours);
/// Corrections over the rest spacing from a millionth (pale) to 1 (dark), by their power of ten.
void colour_residual(const Grid<float>& corrections, Planes3& colours);
/// What touches bodies or the ground, and what touches cloth.
void colour_contacts(std::span<const Contact> contacts, int size, Planes3& colours);
/// A band along the border, pairs of mates in one colour each; true borders dark.
void colour_mates(const BorderMates& mates, Planes3& colours);
/// Cells of one texel of a level of the mip pyramid.
void colour_mip(int level, int size, Planes3& colours);
/// How much longer than on average the image's steps are in space, as stretch_colour.
void colour_stretch(const Planes3& positions, Planes3& colours);
/// The geometry image's own colours: x, y, z within their box.
void colour_positions(const Planes3& positions, Planes3& colours);

/// What the colours mean; without marks where there is no scale. @param limit  of strain
Legend legend_of(const Colouring& colouring, double limit);

}  // namespace weft::viewer
