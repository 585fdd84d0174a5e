#include "weft/mesh/one_ring.h"

#include <algorithm>

namespace weft {

std::vector<int> one_ring(std::span<const Triangle> triangles, std::span<const int> around,
                          int vertex) {
  std::vector<int> found;
  for (const int t : around)
    for (const int v : triangles[t])
      if (v != vertex) found.push_back(v);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace weft
