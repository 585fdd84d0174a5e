#pragma once

#include "weft/mesh.h"

namespace weft {

/// A flared skirt on the mannequin, from the waist to the knee, without touching it: an open mesh
/// of genus 0 with two borders, its normals outward.
TriangleMesh skirt_mesh();

/// A t-shirt on the mannequin without touching it: an open mesh of genus 0 with four holes (neck,
/// hem, two sleeves), its normals outward.
TriangleMesh tshirt_mesh();

}  // namespace weft
