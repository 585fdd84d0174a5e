#include "weft/drape_scene.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "weft/convert.h"
#include "weft/image_file.h"
#include "weft/mesh/winding.h"
#include "weft/shapes.h"
#include "weft/sim/loading/insides.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

constexpr double body_side = 1;          // [m]
constexpr double cloth_over_body = 1.6;  // side of a flat cloth over the body's
constexpr double gap_above = 0.02;       // [m]
/// A cloth is worn where more than worn_share of its box overlaps the body's, and less than
/// sunk_share of its points is inside of the body.
constexpr double worn_share = 0.5, sunk_share = 0.25;

std::string_view shape_of(const std::string& surface) {
  return is_builtin(surface) ? std::string_view(surface).substr(builtin_prefix.size())
                             : std::string_view();
}

bool is_flat_shape(const std::string& surface) {
  const std::string_view shape = shape_of(surface);
  return shape == "sheet" || shape == "disk";
}

/// The triangles of an image, whose vertices are its samples.
TriangleMesh mesh_of(const GeometryImage& image) {
  const Planes3 samples = world_positions(image);
  TriangleMesh mesh;
  for (int s = 0; s < samples.size() * samples.size(); ++s)
    mesh.positions.push_back(vec_cast<double>(samples.at(s)));
  mesh.triangles = joined_triangles(image);
  return mesh;
}

TriangleMesh mesh_of(const std::string& surface, const MeshFrame& files) {
  if (is_image_name(surface)) return mesh_of(read_image(surface));
  TriangleMesh mesh = load_mesh(surface);
  return is_builtin(surface) ? mesh : in_metres_y_up(std::move(mesh), files);
}

/// The part of the cloth's triangles whose first corner is inside of a closed body; 0 where the
/// body is not closed.
double inside_part(const TriangleMesh& cloth, const TriangleMesh& body) {
  if (cloth.triangles.empty() || !is_closed(body.triangles)) return 0;
  std::vector<Corners> corners;
  for (const Triangle& t : body.triangles)
    corners.push_back({body.positions[t[0]], body.positions[t[1]], body.positions[t[2]]});
  const WindingNumbers winding(std::move(corners));
  std::size_t inside = 0;
  for (const Triangle& t : cloth.triangles)
    inside += winding.at(cloth.positions[t[0]]) != 0 ? 1 : 0;
  return static_cast<double>(inside) / static_cast<double>(cloth.triangles.size());
}

/// The part of interval a that lies within b; 1 for an empty interval within b.
double shared_part(double a_lower, double a_upper, double b_lower, double b_upper) {
  const double shared = std::min(a_upper, b_upper) - std::max(a_lower, b_lower);
  if (shared < 0) return 0;
  return a_upper > a_lower ? shared / (a_upper - a_lower) : 1;
}

bool boxes_overlap(const Box3d& a, const Box3d& b) {
  return shared_part(a.lower.x, a.upper.x, b.lower.x, b.upper.x) *
             shared_part(a.lower.y, a.upper.y, b.lower.y, b.upper.y) *
             shared_part(a.lower.z, a.upper.z, b.lower.z, b.upper.z) >
         worn_share;
}

bool is_worn(const std::string& name, const TriangleMesh& cloth, const TriangleMesh& body) {
  const std::string_view shape = shape_of(name);
  if (!shape.empty() && is_image_by_nature(shape)) return false;
  return boxes_overlap(box_of(cloth), box_of(body)) && inside_part(cloth, body) < sunk_share;
}

Vec3d all_sides(double scale) { return {scale, scale, scale}; }

/// Placement of a cloth above the top of the body's box, centred.
Placement laid_above(const Box3d& cloth, double cloth_scale, const Box3d& placed_body) {
  const Vec3d over = placed_body.centre(), own = cloth_scale * cloth.centre();
  return {all_sides(cloth_scale),
          {},
          {over.x - own.x, placed_body.upper.y + gap_above - cloth_scale * cloth.lower.y,
           over.z - own.z}};
}

/// Where a body stands that is not worn: on the ground, and, where it is so far from the origin
/// that single precision would leave little of its shape, there.
Placement stood_up(const Box3d& body, double scale, double side) {
  constexpr double far_away = 100;  // sides
  const Vec3d middle = scale * body.centre();
  const bool is_far = std::max(std::abs(middle.x), std::abs(middle.z)) > far_away * side;
  const Vec3d moved{is_far ? -middle.x : 0, -scale * body.lower.y, is_far ? -middle.z : 0};
  return {all_sides(scale), {}, moved};
}

double largest_side(const Box3d& box) {
  const Vec3d extent = box.extent();
  return std::max({extent.x, extent.y, extent.z, 1e-12});
}

}  // namespace

Scene make_drape_scene(const std::string& cloth, const std::string& body,
                       const DrapeOptions& options) {
  const TriangleMesh cloth_mesh = mesh_of(cloth, options.files),
                     body_mesh = mesh_of(body, options.files);
  const Box3d cloth_box = box_of(cloth_mesh), body_box = box_of(body_mesh);
  const bool worn = is_worn(cloth, cloth_mesh, body_mesh);
  const double scale = options.as_is || worn ? 1 : body_side / largest_side(body_box);
  const Placement standing = worn ? Placement{all_sides(scale), {}, {}}
                                  : stood_up(body_box, scale, scale * largest_side(body_box));
  const Box3d placed_body{scale * body_box.lower + standing.translate,
                          scale * body_box.upper + standing.translate};

  Scene scene;
  scene.frames = options.frames;
  scene.files = options.files;
  scene.ground = placed_body.lower.y;
  SceneCloth dropped;
  dropped.surface = cloth;
  dropped.size = options.cloth_size;
  dropped.material = options.material;
  dropped.friction = options.friction;
  if (!worn) {
    const Vec3d wide = placed_body.extent();
    const double grown = is_flat_shape(cloth)
                             ? cloth_over_body * std::max(wide.x, wide.z) / largest_side(cloth_box)
                             : 1;
    dropped.placement = laid_above(cloth_box, grown, placed_body);
  }
  scene.cloths.push_back(dropped);

  SceneBody stands;
  stands.surface = body;
  stands.size = options.body_size;
  stands.placement = standing;
  scene.bodies.push_back(stands);
  return scene;
}

}  // namespace weft
