// Drapes a cloth over a body that turns, both given in memory: no scene file, no folder.
#include <cmath>
#include <cstdio>
#include <exception>

#include "weft/convert.h"
#include "weft/simulation.h"

namespace {

constexpr int frames = 30;

double lowest(const weft::Planes3& positions) {
  double y = HUGE_VAL;
  for (int sample = 0; sample < positions.size() * positions.size(); ++sample)
    y = std::fmin(y, positions.at(sample).y);
  return y;
}

/// A tetrahedron 0.6 m high, as a program may have made it.
weft::TriangleMesh tent() {
  weft::TriangleMesh mesh;
  mesh.positions = {{-0.5, 0, -0.3}, {0.5, 0, -0.3}, {0, 0, 0.6}, {0, 0.6, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  return mesh;
}

weft::Scene make_scene() {
  weft::SceneBody body;
  body.name = "tent";
  body.surface = {tent(), "tent"};
  body.size = 65;
  body.motion = {{0, {}, {}}, {0.5, {0, 30, 0}, {}}};  // 30 degrees in half a second

  weft::SceneCloth sheet;
  sheet.size = 33;
  sheet.placement.translate = {0, 0.65, 0};
  weft::Scene scene;
  scene.bodies = {body};
  scene.cloths = {sheet};
  return scene;
}

}  // namespace

int main() try {
  weft::Simulation simulation(make_scene(), "drape", 2);  // two threads
  weft::FrameReport last;
  for (int frame = 0; frame < frames; ++frame) last = simulation.advance();
  std::printf("frame %d: lowest point at %.4f m, %d contacts, strain %.2f %%, %.3g J done\n",
              simulation.frame(), lowest(simulation.cloths()[0].state.position), last.contacts,
              100 * last.strain.p99, last.work);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
