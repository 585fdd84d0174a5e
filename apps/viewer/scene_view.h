#pragma once

#include "apps/viewer/snapshot.h"
#include "weft/drawing.h"

namespace weft::viewer {

/// The drawn scene of a snapshot. It points into the snapshot; revisions of surfaces change only
/// where they must be uploaded anew.
DrawnScene drawn_scene(const Snapshot& snapshot, const Camera& camera);

/// The box that the camera frames: everything at its current position, and the space below hanging
/// cloth.
Box3d box_to_frame(const Snapshot& snapshot);

}  // namespace weft::viewer
