#pragma once

#include "weft/mesh.h"

namespace weft {

/// A t-shirt on the mannequin without touching it: an open mesh of genus 0 with four holes (neck,
/// hem, two sleeves), its normals outward.
TriangleMesh tshirt_mesh();

}  // namespace weft
