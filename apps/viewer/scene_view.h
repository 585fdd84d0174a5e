#pragma once

#include "apps/viewer/snapshot.h"
#include "weft/drawing.h"

namespace weft::viewer {

/// What to draw of a snapshot; points into it, and is drawn no anew than it must be.
DrawnScene drawn_scene(const Snapshot& snapshot, const Camera& camera);

/// What the camera looks at: everything where it is, and the room below cloth that hangs.
Box3d box_to_frame(const Snapshot& snapshot);

}  // namespace weft::viewer
