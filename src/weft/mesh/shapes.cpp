#include "weft/mesh/shapes.h"

#include <array>
#include <iterator>
#include <string>

#include "weft/core/error.h"
#include "weft/core/nearest_name.h"
#include "weft/mesh/shapes/mannequin.h"
#include "weft/mesh/shapes/parametric.h"
#include "weft/mesh/shapes/sphere.h"
#include "weft/mesh/shapes/tshirt.h"

namespace weft {
namespace {

struct Shape {
  ShapeInfo info;
  bool is_image;
  TriangleMesh (*make)();
};

TriangleMesh sphere() { return icosphere(0.5, 4); }

constexpr std::array shapes{
    Shape{
        {"sheet", "a flat square of 1 m in the xz plane, u along x, v along z"}, true, sheet_mesh},
    Shape{{"disk", "a flat disk of radius 0.5 m in the xz plane"}, true, disk_mesh},
    Shape{{"sphere", "a sphere of radius 0.5 m"}, false, sphere},
    Shape{{"torus", "a ring around the y axis, radii 0.35 m and 0.15 m"}, true, torus_mesh},
    Shape{{"mannequin", "a standing figure, 1.75 m tall, feet on y = 0, facing +z"},
          false,
          mannequin_mesh},
    Shape{{"tshirt", "a t-shirt on the mannequin: four openings"}, false, tshirt_mesh},
};

const Shape* find_shape(std::string_view name) {
  for (const Shape& shape : shapes)
    if (shape.info.name == name) return &shape;
  return nullptr;
}

}  // namespace

std::vector<ShapeInfo> built_in_shapes() {
  std::vector<ShapeInfo> infos;
  infos.reserve(std::size(shapes));
  for (const Shape& shape : shapes) infos.push_back(shape.info);
  return infos;
}

TriangleMesh make_shape(std::string_view name) {
  if (const Shape* shape = find_shape(name)) return shape->make();
  std::vector<std::string_view> names;
  names.reserve(std::size(shapes));
  for (const Shape& shape : shapes) names.push_back(shape.info.name);
  throw UsageError("builtin:" + std::string(name), "no such shape",
                   "did you mean builtin:" + nearest_name(name, names) + "?");
}

bool is_image_by_nature(std::string_view name) {
  const Shape* shape = find_shape(name);
  return shape != nullptr && shape->is_image;
}

}  // namespace weft
