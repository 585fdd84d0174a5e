#include <algorithm>

#include "apps/figures/figures.h"
#include "weft/camera.h"
#include "weft/core/math.h"
#include "weft/drawing.h"
#include "weft/picture.h"
#include "weft/repair.h"
#include "weft/shapes.h"

namespace weft::figures {
namespace {

constexpr Vec3f front_colour{0.55F, 0.72F, 0.90F}, back_colour{0.93F, 0.46F, 0.20F};

/// Two shallow cones that touch at their tips, some triangles turned over.
TriangleMesh touching_cones() {
  constexpr int sides = 14;
  TriangleMesh mesh;
  mesh.positions.push_back({0, 0, 0});
  for (const double up : {1.0, -1.0}) {
    const int first = static_cast<int>(mesh.positions.size());
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * pi * i / sides;
      mesh.positions.push_back({0.8 * cosine(angle), 0.55 * up, 0.8 * sine(angle)});
    }
    for (int i = 0; i < sides; ++i) {
      const int a = first + i, b = first + (i + 1) % sides;
      const bool turned = (i * 5 + first) % 7 < 2;
      mesh.triangles.push_back((up > 0) != turned ? Triangle{0, b, a} : Triangle{0, a, b});
    }
  }
  return mesh;
}

/// Draws each triangle on its own vertices, coloured by whether its front faces outwards.
Picture draw_sides(const TriangleMesh& mesh, const ViewFrom& view) {
  TriangleMesh apart;
  SurfaceDrawing drawing;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    const Vec3d middle = (1.0 / 3) * (p + q + r), normal = cross(q - p, r - p);
    const bool outward = middle.y * normal.y > 0;
    const int first = static_cast<int>(apart.positions.size());
    apart.positions.insert(apart.positions.end(), {p, q, r});
    apart.triangles.push_back({first, first + 1, first + 2});
    for (int k = 0; k < 3; ++k) drawing.colours.push_back(outward ? front_colour : back_colour);
  }
  drawing.mesh = &apart;
  drawing.show_edges = true;
  return draw_on_white(drawing, view);
}

/// Moves both cones apart a little, which share no vertex any more.
TriangleMesh moved_apart(const TriangleMesh& mesh) {
  TriangleMesh moved = mesh;
  for (const Triangle& t : mesh.triangles) {
    double height = 0;
    for (const int v : t) height += mesh.positions[v].y;
    for (const int v : t) moved.positions[v].y = mesh.positions[v].y + (height > 0 ? 0.15 : -0.15);
  }
  return moved;
}

void draw_repair(const std::filesystem::path& path) {
  const ViewFrom view{420, 340, 0.4, 0.30};
  const TriangleMesh broken = touching_cones();
  // The cones are two components once their common vertex is split: each is kept in turn.
  TriangleMesh whole;
  for (int k = 0; k < 2; ++k) {
    const TriangleMesh part =
        repair_mesh(broken, {"cones", {ComponentChoice::Kind::index, k}}).mesh;
    const int shift = static_cast<int>(whole.positions.size());
    whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
    for (const auto& [a, b, c] : part.triangles)
      whole.triangles.push_back({a + shift, b + shift, c + shift});
  }
  write_png(path, in_a_row({{draw_sides(broken, view), "as read"},
                            {draw_sides(moved_apart(whole), view), "repaired"}}));
}

void draw_cube(const std::filesystem::path& path) {
  const TriangleMesh mesh = make_shape("mannequin");
  const Box3d box = box_of(mesh);
  const Vec3d extent = box.extent();
  const double scale = std::max({extent.x, extent.y, extent.z});
  SurfaceDrawing drawing;
  drawing.curve_radius = 0.0025;
  for (const Vec3d p : mesh.positions)
    drawing.colours.push_back(vec_cast<float>((1 / scale) * (p - box.lower)));
  const auto corner = [&](int i) {
    return box.lower + scale * Vec3d{i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0};
  };
  const auto colour = [](int i) {
    return Vec3f{i & 1 ? 1.0F : 0.0F, i & 2 ? 1.0F : 0.0F, i & 4 ? 1.0F : 0.0F};
  };
  // The cube's edges in the colours of their places; the mesh is framed with them.
  constexpr int steps = 8;
  for (int i = 0; i < 8; ++i)
    for (const int axis : {1, 2, 4})
      if ((i & axis) == 0)
        for (int k = 0; k < steps; ++k) {
          const auto at = [&](double t) { return corner(i) + t * (corner(i | axis) - corner(i)); };
          const float t = (static_cast<float>(k) + 0.5F) / steps;
          drawing.curves.push_back({{at(1.0 * k / steps), at((k + 1.0) / steps)},
                                    0.85F * (colour(i) + t * (colour(i | axis) - colour(i)))});
        }
  TriangleMesh framed = mesh;
  for (int i = 0; i < 8; ++i) {
    framed.positions.push_back(corner(i));
    drawing.colours.push_back(colour(i));
  }
  drawing.mesh = &framed;
  write_png(path, draw_on_white(drawing, {460, 440, 0.5, 0.3}));
}

}  // namespace

void draw_input(const std::filesystem::path& folder) {
  draw_repair(folder / "repair.png");
  draw_cube(folder / "cube.png");
}

}  // namespace weft::figures
