#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/colour_by.h"
#include "weft/geometry_image.h"
#include "weft/simulation.h"

namespace weft::viewer {

/// A surface as far as it does not move.
struct SubjectSurface {
  std::string name;
  BorderMates mates;
  std::optional<NormalMap> normals;  ///< of what stands still
  Planes3 start;                     ///< where it begins [m]
  bool moves = false;
};

/// What is shown, as far as it stays the same while it is.
struct Subject {
  std::uint64_t number = 0;  ///< differs from that of every other
  std::string name;          ///< as the user calls it
  std::vector<SubjectSurface> cloths, bodies;
  std::optional<double> ground;
  std::optional<Scene> scene;  ///< where there is something to simulate
  bool plays = false;          ///< whether time passes
  bool frames_anew = true;     ///< whether the camera shall look at it afresh
};

/// Everything that the window draws at a time.
struct Snapshot {
  std::uint64_t number = 0;  ///< differs from that of every other
  std::shared_ptr<const Subject> subject;
  std::vector<Planes3> cloths;   ///< of the subject's, now [m]
  std::vector<Planes3> colours;  ///< linear RGB of each cloth's samples; size 0: its own colour
  std::vector<Planes3> bodies;   ///< of those that move, now [m]; the others are empty
  int frame = 0;
  FrameReport report;  ///< of the last frame that was made
  Vec3d centre_of_mass;
  Colouring colouring;
  bool running = false, held = false;
  double speed = 0;  ///< of the scene's time against the clock; 0 while it stands still
};

/// What the simulating thread is about, in words.
struct Status {
  std::string stage;    ///< of loading; empty when nothing is loaded
  double fraction = 0;  ///< of the stage
  std::string message;  ///< the last thing worth telling
  std::string error;    ///< why there is nothing to see or nothing moves; empty when all is well
};

}  // namespace weft::viewer
