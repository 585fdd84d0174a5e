#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "weft/geometry_image.h"
#include "weft/mesh.h"

namespace weft::python {

// Arrays that come in are of the right type and order already: weft/_arrays.py sees to that, with
// errors in a user's words. Shapes are checked again here, so that nothing is read beyond an end.
using Doubles = pybind11::array_t<double, pybind11::array::c_style>;
using Floats = pybind11::array_t<float, pybind11::array::c_style>;
using Ints = pybind11::array_t<std::int32_t, pybind11::array::c_style>;

/// An array that owns the vector. @param shape  of all of its numbers
template <class Number, class Item>
pybind11::array_t<Number> array_of(std::vector<Item> items, std::vector<pybind11::ssize_t> shape) {
  static_assert(sizeof(Item) % sizeof(Number) == 0);
  auto kept = std::make_unique<std::vector<Item>>(std::move(items));
  const auto* data = reinterpret_cast<const Number*>(kept->data());
  const pybind11::capsule owner(kept.release(), [](void* p) {
    const std::unique_ptr<std::vector<Item>> freed(static_cast<std::vector<Item>*>(p));
  });
  return pybind11::array_t<Number>(std::move(shape), data, owner);
}

/// The mesh of arrays (n, 3) and (m, 3). @throws ValueError for other shapes
TriangleMesh mesh_of(const Doubles& vertices, const Ints& faces);
/// Gives a mesh the texture coordinates (m, 3, 2) of its faces' corners. @throws ValueError as that
void set_texture(TriangleMesh& mesh, const Floats& corners);
/// (V, F): arrays (n, 3) of float64 and (m, 3) of int32.
pybind11::tuple arrays_of(TriangleMesh mesh);
/// All samples of planes. [n * n]
std::vector<Vec3f> samples_of(const Planes3& planes);

}  // namespace weft::python
