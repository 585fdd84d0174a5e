#pragma once

#include <cstdint>
#include <string>

#include "weft/mesh.h"

namespace weft::test {

/// A mesh made by chance, and how.
struct RandomMesh {
  TriangleMesh mesh;
  std::string made_of;  ///< what was done, for messages
};

/// A connected, orientable manifold of random genus (0 to 8), holes, noise, slivers, subdivision
/// and scaling (axes up to 1:1000), of about 20 to 5000 triangles in random order; the same for
/// the same seed everywhere. Its triangles may lie both ways round.
RandomMesh random_mesh(std::uint64_t seed);

/// A way to spoil a mesh, and what the error about it says.
struct BrokenMesh {
  TriangleMesh mesh;
  std::string made_of;
  std::string error;  ///< words that the message has
};
/// A random mesh that no image can be made of.
BrokenMesh random_broken_mesh(std::uint64_t seed);

/// A mesh of what files hold that are no manifold.
struct RandomComplex {
  TriangleMesh mesh;
  TriangleMesh whole;  ///< the same before its triangles were repeated and its vertices split
  std::string made_of;
};
/// A random mesh with some of: fins on edges, which then have 3 to 5 triangles; twisted handles;
/// Moebius bands, Klein bottles and further random meshes beside it; triangles that are there
/// twice; vertices split as at texture seams, where there are no fins.
RandomComplex random_complex(std::uint64_t seed);

}  // namespace weft::test
