#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "weft/core/random.h"
#include "weft/mesh.h"
#include "weft/mesh/topology.h"

namespace weft::test {

/// A mesh under construction: manifold, connected, and it stays so.
class RandomMeshBuilder {
 public:
  explicit RandomMeshBuilder(std::uint64_t seed);

  /// Adds handles, holes, triangles, noise and slivers, and scales, each of it or not.
  void shape();
  /// Replaces what two triangles cover by a tube between them; `twisted` against the orientation.
  /// @return whether two triangles far enough apart were found
  bool add_handle(bool twisted = false);
  /// Puts vertices and triangles in random order, maybe some triangles the other way round.
  void shuffle();
  Random& random() { return random_; }
  TriangleMesh& mesh() { return mesh_; }
  [[nodiscard]] const std::string& made_of() const { return made_of_; }

 private:
  void say(std::string_view what) { made_of_.append(made_of_.empty() ? "" : ", ").append(what); }
  [[nodiscard]] int triangle_count() const { return static_cast<int>(mesh_.triangles.size()); }
  void start();
  void add_hole();
  void refine();
  void split_edge(int half_edge, double fraction);
  void split_face(int triangle, std::array<double, 3> weights);
  void add_noise();
  void add_slivers();
  void scale();
  [[nodiscard]] HalfEdges edges() const {
    return half_edges(static_cast<int>(mesh_.positions.size()), mesh_.triangles);
  }
  [[nodiscard]] double mean_edge() const;

  Random random_;
  double wanted_ = 0;
  TriangleMesh mesh_;
  std::string made_of_;
};

}  // namespace weft::test
