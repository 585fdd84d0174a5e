#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/collide/ccd.h"
#include "weft/image/rebuild.h"
#include "weft/sim/simulation.h"

namespace weft {
namespace {

/// A triangulated grid, for looking at its motion in a step; mates are one point.
struct Surface {
  explicit Surface(const GeometryImage& image) {
    std::set<std::array<int, 2>> all;
    std::set<int> used;
    for (const Triangle& samples : grid_triangles(image)) {
      Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) t[k] = image.mates.representative(samples[k]);
      triangles.push_back(t);
      for (std::size_t k = 0; k < 3; ++k) {
        all.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
        used.insert(t[k]);
      }
    }
    edges.assign(all.begin(), all.end());
    points.assign(used.begin(), used.end());
  }

  std::vector<Triangle> triangles;
  std::vector<std::array<int, 2>> edges;
  std::vector<int> points;
};

struct Motion {
  const Surface& surface;
  const Planes3 &start, &end;
};

struct SweptBox {
  Box3d box;
  int index = 0;
};

template <class Features>
std::vector<SweptBox> boxes_of(const Motion& motion, const Features& features) {
  std::vector<SweptBox> boxes;
  for (int i = 0; i < static_cast<int>(features.size()); ++i) {
    SweptBox one{{}, i};
    const auto add = [&](int sample) {
      one.box.add(vec_cast<double>(motion.start.at(sample)));
      one.box.add(vec_cast<double>(motion.end.at(sample)));
    };
    if constexpr (std::is_integral_v<std::decay_t<decltype(features[i])>>) {
      add(features[i]);
    } else {
      for (const int sample : features[i]) add(sample);
    }
    boxes.push_back(one);
  }
  std::sort(boxes.begin(), boxes.end(), [](const SweptBox& a, const SweptBox& b) {
    return a.box.lower.x != b.box.lower.x ? a.box.lower.x < b.box.lower.x : a.index < b.index;
  });
  return boxes;
}

/// Calls visit(a, b) for all whose boxes meet, by a sweep along x.
template <class Visit>
void for_meeting(const std::vector<SweptBox>& a, const std::vector<SweptBox>& b,
                 const Visit& visit) {
  double widest = 0;
  for (const SweptBox& one : b) widest = std::max(widest, one.box.extent().x);
  for (const SweptBox& one : a) {
    auto it = std::lower_bound(b.begin(), b.end(), one.box.lower.x - widest,
                               [](const SweptBox& s, double x) { return s.box.lower.x < x; });
    for (; it != b.end() && it->box.lower.x <= one.box.upper.x; ++it) {
      const Vec3d apart = max(one.box.lower - it->box.upper, it->box.lower - one.box.upper);
      if (std::max({apart.x, apart.y, apart.z}) <= 0) visit(one.index, it->index);
    }
  }
}

Vec3d at(const Planes3& planes, int sample) { return vec_cast<double>(planes.at(sample)); }

VertexFace vertex_face(const Planes3& of_vertex, int vertex, const Planes3& of_face,
                       const Triangle& face) {
  return {at(of_vertex, vertex),
          {at(of_face, face[0]), at(of_face, face[1]), at(of_face, face[2])}};
}

EdgeEdge edge_edge(const Planes3& first, const std::array<int, 2>& p, const Planes3& second,
                   const std::array<int, 2>& q) {
  return {{at(first, p[0]), at(first, p[1])}, {at(second, q[0]), at(second, q[1])}};
}

/// How many vertices and faces, and pairs of edges, touch on the straight ways of a step; those of
/// one surface that share a point do always and are left out.
int touching(const Motion& a, const Motion& b, bool same) {
  int count = 0;
  const auto vertices_with_faces = [&](const Motion& of_vertex, const Motion& of_face) {
    for_meeting(boxes_of(of_vertex, of_vertex.surface.points),
                boxes_of(of_face, of_face.surface.triangles), [&](int i, int j) {
                  const int v = of_vertex.surface.points[i];
                  const Triangle& face = of_face.surface.triangles[j];
                  if (same && std::count(face.begin(), face.end(), v) > 0) return;
                  count += time_of_impact(vertex_face(of_vertex.start, v, of_face.start, face),
                                          vertex_face(of_vertex.end, v, of_face.end, face))
                               ? 1
                               : 0;
                });
  };
  vertices_with_faces(a, b);
  if (!same) vertices_with_faces(b, a);
  for_meeting(boxes_of(a, a.surface.edges), boxes_of(b, b.surface.edges), [&](int i, int j) {
    if (same && i <= j) return;
    const auto &p = a.surface.edges[i], &q = b.surface.edges[j];
    if (same && (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1])) return;
    count +=
        time_of_impact(edge_edge(a.start, p, b.start, q), edge_edge(a.end, p, b.end, q)) ? 1 : 0;
  });
  return count;
}

Scene one_step_a_frame() {
  Scene scene;
  scene.frame_rate = 240;
  scene.substeps = 1;
  SceneCloth cloth;
  cloth.name = "sheet";
  cloth.surface = "builtin:sheet";
  cloth.size = 25;
  cloth.material = weft::testing::soft_fabric;
  scene.cloths = {cloth};
  return scene;
}

struct Seen {
  int contacts = 0, self_contacts = 0;
};

/// Runs and looks at every step's motion.
Seen expect_nothing_passes(const Scene& scene, int steps) {
  Simulation simulation(scene, "s.json", 2);
  const Surface cloth(simulation.cloths()[0].image);
  std::vector<Surface> bodies;
  for (const PlacedBody& body : simulation.bodies()) bodies.emplace_back(body.image);
  Seen seen;
  for (int step = 1; step <= steps; ++step) {
    const Planes3 before = simulation.cloths()[0].state.position;
    const FrameReport report = simulation.advance();
    seen.contacts = std::max(seen.contacts, report.contacts);
    seen.self_contacts = std::max(seen.self_contacts, report.self_contacts);
    const Motion motion{cloth, before, simulation.cloths()[0].state.position};
    EXPECT_EQ(touching(motion, motion, true), 0) << "itself, step " << step;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Planes3& still = simulation.bodies()[i].positions;
      EXPECT_EQ(touching(motion, {bodies[i], still, still}, false), 0) << "body, step " << step;
    }
  }
  return seen;
}

// Counting triangles that cross at the ends of frames would not see what passes whole in between:
// this follows the ways of all vertices and edges.
TEST(Passing, FastSheetPassesThroughNoThinRodInAnyStep) {
  Scene scene = one_step_a_frame();
  scene.ground = std::nullopt;
  scene.cloths[0].placement.translate = {0, 0.1, 0.013};
  scene.cloths[0].velocity = {0, -6, 0.5};
  SceneBody rod;
  rod.name = "rod";
  rod.surface = "builtin:rod";
  rod.size = 33;
  scene.bodies = {rod};
  EXPECT_GT(expect_nothing_passes(scene, 40).contacts, 10);
}

TEST(Passing, CrumplingSheetPassesThroughItselfInNoStep) {
  Scene scene = one_step_a_frame();
  scene.ground = 0;
  scene.cloths[0].placement.rotate = {80, 0, 7};
  scene.cloths[0].placement.scale = {0.4, 0.4, 0.4};
  scene.cloths[0].placement.translate = {0, 0.22, 0};
  scene.cloths[0].velocity = {0, -4, 0};
  EXPECT_GT(expect_nothing_passes(scene, 150).self_contacts, 5);
}

TEST(Passing, WhatDoesPassIsSeen) {
  Scene scene = one_step_a_frame();
  scene.collider = PolarMapOptions{};
  scene.ground = std::nullopt;
  scene.cloths[0].placement.translate = {0, 0.05, 0};
  SceneBody plate;
  plate.name = "plate";
  plate.surface = "builtin:sheet";
  plate.size = 9;
  plate.placement.translate = {0.01, 0, 0.02};
  scene.bodies = {plate};
  Simulation simulation(scene, "s.json", 1);
  const Surface cloth(simulation.cloths()[0].image), body(simulation.bodies()[0].image);
  const Planes3 &still = simulation.bodies()[0].positions,
                &before = simulation.cloths()[0].state.position;
  Planes3 after = before;
  for (int s = 0; s < after.size() * after.size(); ++s)
    after.set(s, after.at(s) - Vec3f{0, 0.1F, 0});
  EXPECT_GT(touching({cloth, before, after}, {body, still, still}, false), 500);
}

}  // namespace
}  // namespace weft
