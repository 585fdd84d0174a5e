#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "weft/geometry_image.h"

namespace weft::python {

/// A geometry image as the interpreter holds it: never changed, and shared with what works on it.
using SharedImage = std::shared_ptr<const GeometryImage>;

struct Image {
  SharedImage image;
};

/// Meshes, conversion and images.
void add_images(pybind11::module_& module);
/// Sewing patterns and garments.
void add_garments(pybind11::module_& module);
/// Simulations.
void add_simulations(pybind11::module_& module);

}  // namespace weft::python
