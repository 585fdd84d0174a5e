#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/colouring.h"
#include "weft/geometry_image.h"
#include "weft/simulation.h"

namespace weft::viewer {

/// The constant data of a surface.
struct SubjectSurface {
  std::string name;
  BorderMates mates;
  std::optional<NormalMap> normals;  ///< where it does not move, or of `placed`
  Planes3 start;                     ///< initial positions [m]
  bool moves = false;
  Planes3 colours{};           ///< of the image, linear RGB; size 0: none
  Planes3 placed{};            ///< of a body that moves, before it does [m]
  std::vector<char> rising{};  ///< see DrawnSurface
};

/// The constant data of what is shown.
struct Subject {
  std::uint64_t number = 0;  ///< differs from that of every other
  std::string name;          ///< as the user calls it
  std::vector<SubjectSurface> cloths, bodies;
  std::optional<double> ground;
  std::optional<Scene> scene;  ///< where there is something to simulate
  bool plays = false;          ///< whether time passes
  bool frames_anew = true;     ///< whether the camera frames it anew
};

/// Everything that the window draws at one time.
struct Snapshot {
  std::uint64_t number = 0;  ///< differs from that of every other
  std::shared_ptr<const Subject> subject;
  std::vector<Planes3> cloths;   ///< of the subject's, now [m]
  std::vector<Planes3> colours;  ///< linear RGB of each cloth's samples; size 0: its own colour
  std::vector<Planes3> bodies;   ///< of those that move, now [m]; the others are empty
  std::vector<NormalMap> body_normals;  ///< the same of their normals, where they have some
  int frame = 0;
  FrameReport report;  ///< of the last frame that was made
  Vec3d centre_of_mass;
  Colouring colouring;
  bool running = false, held = false;
  double speed = 0;  ///< scene time over real time; 0 while it stands still
};

/// Turns the normals of bodies that move as these are now.
void carry_normals(const Subject& subject, Snapshot& snapshot);

/// Status of the simulating thread, as text.
struct Status {
  std::string stage;    ///< of loading; empty when nothing is loaded
  double fraction = 0;  ///< of the stage
  std::string message;  ///< the last message to the user
  std::string error;    ///< why there is nothing to see or nothing moves; empty when all is well
};

}  // namespace weft::viewer
