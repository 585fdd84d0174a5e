// What the paper's polar map makes of points inside a body, beside the closest point by the
// pyramid, with exact rays and exact search as truth.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/command_line.h"
#include "bench/exact_inside.h"
#include "weft/collide/baselines/polar_map.h"
#include "weft/collide/contacts/body_query.h"
#include "weft/convert.h"
#include "weft/core/random.h"
#include "weft/geometry_image.h"
#include "weft/mesh.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/topology.h"
#include "weft/shapes.h"

namespace weft::bench {
namespace {

constexpr int image_size = 257;
constexpr int points_anywhere = 40000, points_near = 20000;
/// In sides of the body's box, which is 1 m: what counts as shallow, and gaps that are kept.
constexpr double shallow = 0.02, small_gap = 1e-4, fabric_gap = 2e-3;

/// Puts a lid on every border, so that the body has an inside.
TriangleMesh closed(TriangleMesh mesh) {
  const HalfEdges edges = half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles);
  for (const std::vector<int>& loop : border_loops(mesh.triangles, edges)) {
    Vec3d sum;
    for (const int v : loop) sum += mesh.positions[static_cast<std::size_t>(v)];
    const auto centre = static_cast<int>(mesh.positions.size());
    mesh.positions.push_back((1.0 / static_cast<double>(loop.size())) * sum);
    for (std::size_t i = 0; i < loop.size(); ++i)
      mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
  }
  return mesh;
}

GeometryImage image_of(const std::string& name) {
  constexpr std::string_view built_in = "builtin:";
  ConvertOptions options;
  options.size = image_size;
  options.measure = false;
  if (name.starts_with(built_in)) return load_surface(name, options).image;
  const RepairedMesh whole = repair_mesh(read_mesh(name), {});
  return convert_mesh(closed(whole.mesh), name, options).image;
}

/// The body in its unit cube, and the truth about it.
struct Truth {
  explicit Truth(const GeometryImage& image) : mesh(in_cube(image)), inside(mesh), closest(mesh) {}
  static TriangleMesh in_cube(const GeometryImage& image) {
    RebuiltMesh rebuilt = rebuild_mesh(image);
    for (std::size_t v = 0; v < rebuilt.sample_of.size(); ++v)
      rebuilt.mesh.positions[v] = vec_cast<double>(image.cube.at(rebuilt.sample_of[v]));
    return rebuilt.mesh;
  }
  [[nodiscard]] bool is_inside(Vec3d p) const {
    return inside.side_of(p) == ExactInside::Side::inside;
  }
  [[nodiscard]] double depth(Vec3d p) const {
    return std::sqrt(closest.closest(p).squared_distance);
  }

  TriangleMesh mesh;
  ExactInside inside;
  ClosestPointQuery closest;
};

/// Points inside: some anywhere, and some that lie shallow beneath the surface.
struct Points {
  explicit Points(const Truth& truth) {
    Random random(1);
    Box3d box;
    for (const Vec3d& p : truth.mesh.positions) box.add(p);
    const Vec3d e = box.extent();
    for (int i = 0; i < points_anywhere; ++i) {
      const Vec3d p =
          box.lower + Vec3d{e.x * random.uniform(), e.y * random.uniform(), e.z * random.uniform()};
      if (truth.is_inside(p)) anywhere.push_back(p);
    }
    for (const Vec3d& on : sample_surface(truth.mesh, points_near, 2)) {
      const Triangle& t =
          truth.mesh.triangles[static_cast<std::size_t>(truth.closest.closest(on).triangle)];
      const auto at = [&](int k) { return truth.mesh.positions[static_cast<std::size_t>(t[k])]; };
      const Vec3d normal = normalized(cross(at(1) - at(0), at(2) - at(0)));
      const Vec3d p = on - random.uniform(0, shallow) * normal;
      if (truth.is_inside(p)) near.push_back(p);
    }
  }
  std::vector<Vec3d> anywhere, near;
};

/// How a method judges and pushes.
struct Method {
  std::string name;
  std::function<bool(Vec3d)> is_inside;
  /// Where a point inside goes, for a gap that is to be kept.
  std::function<Vec3d(Vec3d, double)> push;
};

double percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

void print_row(const std::string& body, const Method& method, const Truth& truth,
               const Points& points) {
  const auto missed = std::count_if(points.anywhere.begin(), points.anywhere.end(),
                                    [&](Vec3d p) { return !method.is_inside(p); });
  std::size_t too_far = 0;
  double largest = 0;
  for (const Vec3d& p : points.near) {
    const double ratio = length(method.push(p, small_gap) - p) / (truth.depth(p) + small_gap);
    too_far += ratio > 2 ? 1 : 0;
    largest = std::max(largest, ratio);
  }
  const auto still_inside = [&](double gap) {
    const auto count = std::count_if(points.near.begin(), points.near.end(),
                                     [&](Vec3d p) { return truth.is_inside(method.push(p, gap)); });
    return percent(static_cast<std::size_t>(count), points.near.size());
  };
  fmt::print("| {} | {} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", body, method.name,
             percent(static_cast<std::size_t>(missed), points.anywhere.size()),
             still_inside(small_gap), still_inside(fabric_gap),
             percent(too_far, points.near.size()), largest);
  std::fflush(stdout);
}

Method by_polar_map(const PolarMap& map, const std::string& name) {
  return {name, [&map](Vec3d p) { return map.inside(p); },
          [&map](Vec3d p, double gap) {
            const auto found = map.contact(p, p, gap);
            return found ? p + (gap - found->gap) * found->normal : p;
          }};
}

Method by_pyramid(const BodyQuery& query) {
  constexpr double anywhere = 4;
  return {"pyramid", [&query](Vec3d p) { return query.behind(p, *query.closest(p, anywhere)); },
          [&query](Vec3d p, double gap) {
            const BodyPoint found = *query.closest(p, anywhere);
            if (!query.behind(p, found)) return p;
            return found.position + gap * normalized(found.position - p);
          }};
}

void measure(const std::string& path) {
  const GeometryImage image = image_of(path);
  const Truth truth(image);
  const Points points(truth);
  const Body body{image.cube, image.mates, 0, choose_diagonals(image)};
  const PolarMap printed(body, {.walk = false}), walking(body, {.walk = true});
  const SurfaceGrid grid(image.size(), image.mates, body.diagonals);
  BodyQuery query(grid);
  ThreadTeam team(1);
  query.place(body.positions, team);
  const std::string name = std::filesystem::path(path).stem().string();
  for (const Method& method : {by_polar_map(printed, "polar_map, as printed"),
                               by_polar_map(walking, "polar_map, walking"), by_pyramid(query)})
    print_row(name, method, truth, points);
}

void print_table(const std::vector<std::string>& names) {
  fmt::print(
      "| body | method | inside, missed % | still inside after the push %, gap 0.1 mm | the same, "
      "gap 2 mm | "
      "pushed more than twice as far as needed % | largest push / needed "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const std::string& name : names) measure(name);
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  std::vector<std::string> names;
  weft::bench::CommandLine words{
      "What single pushes out of bodies come to, by the paper's method and the default."};
  words.add("SURFACE", &names, "Meshes or builtin:NAME");
  return words.run(argc, argv, [&] { weft::bench::print_table(names); });
}
