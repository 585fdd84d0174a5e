#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/cut/voxel_mesh.h"
#include "tests/support/meshes.h"
#include "weft/cut/disk_mesh.h"

namespace weft::test {

inline TriangleMesh one_triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

/// Small surfaces of many topologies, each with a name for messages.
inline std::vector<std::pair<std::string, TriangleMesh>> cut_cases() {
  return {{"tetrahedron", tetrahedron()},
          {"cube", slab_surface({"#"})},
          {"slab", slab_surface({"##", "##"}, 1.3)},
          {"torus", slab_surface({"####", "#..#", "####"}, 3.1)},
          {"double torus", slab_surface({"#####", "#.#.#", "#####"})},
          {"genus 4", slab_surface({"#####", "#.#.#", "#####", "#.#.#", "#####"}, 1.7)},
          {"triangle", one_triangle()},
          {"disk", slab_surface({"o"})},
          {"annulus", slab_surface({"o#o"})},
          {"four holes", slab_surface({"o#o", "###", "o#o"}, 0.7)},
          {"torus with two holes", slab_surface({"o##", "#.#", "##o"})},
          {"double torus with three holes", slab_surface({"o#o#o", "#.#.#", "#####"})}};
}

inline int border_size(const CutDisk& cut) { return static_cast<int>(cut.disk.border.size()); }

}  // namespace weft::test
