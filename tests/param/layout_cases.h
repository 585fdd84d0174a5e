#pragma once

#include <string>
#include <vector>

#include "tests/cut/cut_cases.h"
#include "weft/cut/open_to_disk.h"
#include "weft/mesh/topology.h"

namespace weft::test {

struct Case {
  std::string name;
  CutDisk cut;
  TopologyCounts surface;
};

/// Every small surface with its shortest cut, with an unstraightened one, and with a cut that
/// dangles.
inline std::vector<Case> layout_cases() {
  std::vector<Case> cases;
  for (const auto& [name, mesh] : cut_cases()) {
    const int vertices = static_cast<int>(mesh.positions.size());
    const TopologyCounts counts = count_topology(vertices, mesh.triangles);
    const Cut cut = open_to_disk(mesh);
    const Cut rough = open_to_disk(mesh, {.seed_triangle = 0, .straighten = false});
    const Cut longer = extend_cut(mesh, extend_cut(mesh, cut, vertices / 2), vertices / 3);
    cases.push_back({name, cut_open(mesh, cut), counts});
    cases.push_back({name + ", rough cut", cut_open(mesh, rough), counts});
    cases.push_back({name + ", extended cut", cut_open(mesh, longer), counts});
  }
  return cases;
}

}  // namespace weft::test
