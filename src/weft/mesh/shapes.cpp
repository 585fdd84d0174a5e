#include "weft/shapes.h"

#include <array>
#include <iterator>
#include <string>

#include "weft/core/names.h"
#include "weft/error.h"
#include "weft/mesh/shapes/garments.h"
#include "weft/mesh/shapes/mannequin.h"
#include "weft/mesh/shapes/parametric.h"
#include "weft/mesh/shapes/rings.h"
#include "weft/mesh/shapes/solids.h"

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
    Shape{{"torus", "a ring around the y axis, radii 0.35 m and 0.15 m"}, true, torus_mesh},
    Shape{{"cylinder", "an open tube around the y axis, radius 0.2 m, 1 m tall: two borders"},
          true,
          cylinder_mesh},
    Shape{{"sphere", "a sphere of radius 0.5 m"}, false, sphere},
    Shape{{"cone", "a closed cone, tip up, radius 0.25 m, 0.6 m tall"}, false, cone_mesh},
    Shape{{"box", "a closed box with sharp edges, 0.6 x 0.4 x 0.5 m"}, false, box_mesh},
    Shape{{"rod", "a closed rod along x, radius 0.02 m, 1 m long"}, false, rod_mesh},
    Shape{{"double_torus", "two rings side by side that melt together: genus 2, 0.94 m wide"},
          false,
          double_torus_mesh},
    Shape{{"knot", "a trefoil knot of a round tube: genus 1, 0.77 m wide"}, false, knot_mesh},
    Shape{{"genus20", "a rounded plate with 5 x 4 holes: genus 20, 0.86 m wide"},
          false,
          genus20_mesh},
    Shape{{"mannequin", "a standing figure, 1.75 m tall, feet on y = 0, facing +z"},
          false,
          mannequin_mesh},
    Shape{{"tshirt", "a t-shirt on the mannequin: four openings"}, false, tshirt_mesh},
    Shape{{"skirt", "a flared skirt on the mannequin, waist to knee: two openings"},
          false,
          skirt_mesh},
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
