#pragma once

#include "weft/mesh.h"

namespace weft {

/// A flared skirt on the mannequin, from the waist to the knee, without touching it: an open mesh
/// of genus 0 with two borders, its normals outward.
TriangleMesh skirt_mesh();

}  // namespace weft
