#include "apps/viewer/scene_view.h"

#include <algorithm>
#include <iterator>

namespace weft::viewer {
namespace {

constexpr Vec3f fabrics[] = {{0.42F, 0.05F, 0.07F}, {0.05F, 0.13F, 0.32F}, {0.50F, 0.33F, 0.06F}};
constexpr Vec3f plaster{0.62F, 0.60F, 0.57F};
/// Base colour below data: bright, so that colours are those of the scale.
constexpr Vec3f bright{0.85F, 0.85F, 0.85F};

void add(Box3d& box, const Box3d& part) {
  if (part.empty()) return;
  box.add(part.lower);
  box.add(part.upper);
}

const Planes3& body_now(const Snapshot& snapshot, std::size_t i) {
  const SubjectSurface& body = snapshot.subject->bodies[i];
  return body.moves ? snapshot.bodies[i] : body.start;
}

/// In the colours of its image, where that has some.
void paint(DrawnSurface& drawn, const SubjectSurface& surface) {
  if (surface.colours.size() == 0) return;
  drawn.colours = &surface.colours;
  drawn.colour = {1, 1, 1};
}

DrawnSurface body_surface(const Snapshot& snapshot, std::size_t i) {
  const SubjectSurface& body = snapshot.subject->bodies[i];
  DrawnSurface drawn;
  drawn.positions = &body_now(snapshot, i);
  drawn.mates = &body.mates;
  drawn.rising = &body.rising;
  if (body.moves && i < snapshot.body_normals.size() && snapshot.body_normals[i].size() > 0)
    drawn.normals = &snapshot.body_normals[i];
  else if (body.normals && !body.moves)
    drawn.normals = &*body.normals;
  drawn.colour = plaster;
  paint(drawn, body);
  drawn.look = Look::body;
  // Even numbers for what stands still, odd ones for what moves.
  drawn.revision = body.moves ? 2 * snapshot.number + 1 : 2 * snapshot.subject->number;
  return drawn;
}

DrawnSurface cloth_surface(const Snapshot& snapshot, std::size_t i) {
  const SubjectSurface& cloth = snapshot.subject->cloths[i];
  DrawnSurface drawn;
  drawn.positions = &snapshot.cloths[i];
  drawn.mates = &cloth.mates;
  drawn.rising = &cloth.rising;
  drawn.normals = cloth.normals ? &*cloth.normals : nullptr;
  drawn.look = cloth.moves ? Look::fabric : Look::body;
  drawn.colour = cloth.moves ? fabrics[i % std::size(fabrics)] : plaster;
  paint(drawn, cloth);
  if (snapshot.colours[i].size() > 0) {
    drawn.colours = &snapshot.colours[i];
    drawn.colour = bright;
    drawn.threads = 0;
  }
  drawn.revision = 2 * snapshot.number + 1;
  return drawn;
}

bool hangs(const Snapshot& snapshot, std::size_t i) {
  return snapshot.subject->scene && !snapshot.subject->scene->cloths[i].pins.empty();
}

}  // namespace

DrawnScene drawn_scene(const Snapshot& snapshot, const Camera& camera) {
  DrawnScene scene;
  scene.camera = camera;
  if (!snapshot.subject) return scene;
  scene.ground = snapshot.subject->ground;
  for (std::size_t i = 0; i < snapshot.subject->cloths.size(); ++i)
    scene.surfaces.push_back(cloth_surface(snapshot, i));
  for (std::size_t i = 0; i < snapshot.subject->bodies.size(); ++i)
    scene.surfaces.push_back(body_surface(snapshot, i));
  return scene;
}

Box3d box_to_frame(const Snapshot& snapshot) {
  Box3d box;
  if (!snapshot.subject) return box;
  for (std::size_t i = 0; i < snapshot.subject->bodies.size(); ++i)
    add(box, bounds(body_now(snapshot, i)));
  const Box3d bodies = box;
  for (std::size_t i = 0; i < snapshot.cloths.size(); ++i) {
    Box3d cloth = bounds(snapshot.cloths[i]);
    if (cloth.empty()) continue;
    const Vec3d e = cloth.extent();
    const double longest = std::max({e.x, e.y, e.z});
    // Space for cloth that will hang from its pins, or fall to the ground where there is no body.
    if (hangs(snapshot, i)) cloth.lower.y -= 0.9 * (longest - e.y);
    if (snapshot.subject->ground) {
      const bool falls = bodies.empty() && !hangs(snapshot, i);
      cloth.lower.y = falls ? std::min(cloth.lower.y, *snapshot.subject->ground)
                            : std::max(cloth.lower.y, *snapshot.subject->ground);
    }
    add(box, cloth);
  }
  return box;
}

}  // namespace weft::viewer
