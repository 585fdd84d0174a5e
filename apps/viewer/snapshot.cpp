#include "apps/viewer/snapshot.h"

#include "weft/drawing.h"

namespace weft::viewer {

void carry_normals(const Subject& subject, Snapshot& snapshot) {
  snapshot.body_normals.resize(subject.bodies.size());
  for (std::size_t i = 0; i < subject.bodies.size(); ++i) {
    const SubjectSurface& body = subject.bodies[i];
    if (body.moves && body.normals && body.placed.size() > 0)
      snapshot.body_normals[i] =
          carried_normals(body.placed, *body.normals, snapshot.bodies[i], &body.mates);
  }
}

}  // namespace weft::viewer
