#include "weft/convert/seam_curves.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "weft/mesh/topology.h"

namespace weft {
namespace {

/// An edge of the surface as it was before it was parted: two points, the lesser first.
using EdgeKey = std::pair<int, int>;

EdgeKey key_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class CurveFinder {
 public:
  CurveFinder(const RepairedMesh& input, std::span<const Piece> pieces, std::span<const Cut> cuts)
      : input_(input), triangles_(input.mesh.triangles) {
    find_border();
    find_seam_edges();
    find_nodes();
    for (std::size_t k = 0; k < pieces.size(); ++k) end_at_cut(pieces[k], cuts[k]);
    trace_all();
  }

  [[nodiscard]] SeamCurves gather(std::span<const Piece> pieces) {
    SeamCurves result{std::move(lengths_), std::vector<FixedBorder>(pieces.size())};
    number_.resize(input_.mesh.positions.size());
    for (const Piece& piece : pieces)
      for (std::size_t v = 0; v < piece.vertex.size(); ++v)
        number_[piece.vertex[v]] = static_cast<int>(v);
    for (std::size_t k = 0; k < pieces.size(); ++k) add_border(pieces[k], result.borders[k]);
    return result;
  }

 private:
  [[nodiscard]] int point(int vertex) const { return input_.joined[vertex]; }
  [[nodiscard]] bool is_seam(const EdgeKey& key) const { return seams_.contains(key); }

  /// Every border vertex has one border edge that arrives and one that leaves.
  void find_border() {
    const auto vertices = static_cast<int>(input_.mesh.positions.size());
    const HalfEdges edges = half_edges(vertices, triangles_);
    next_.assign(static_cast<std::size_t>(vertices), -1);
    for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h)
      if (edges.twin[h] < 0) next_[from_vertex(triangles_, h)] = to_vertex(triangles_, h);
  }

  /// Border edges that are the same edge of the surface.
  void find_seam_edges() {
    std::map<EdgeKey, int> uses;
    for_border([&](int a, int b) { ++uses[key_of(point(a), point(b))]; });
    for (const auto& [key, count] : uses)
      if (count > 1) seams_.emplace(key, Place{});
    for (const auto& [key, place] : seams_) {
      around_[key.first].push_back(key.second);
      around_[key.second].push_back(key.first);
    }
  }

  /// A curve goes through a point where two parted edges meet and every border goes from one to the
  /// other.
  void find_nodes() {
    for (const auto& [at, others] : around_)
      if (others.size() != 2) nodes_.insert(at);
    for_border([&](int a, int b) {
      const int c = next_[b];
      const EdgeKey here = key_of(point(a), point(b)), there = key_of(point(b), point(c));
      if (is_seam(here) != is_seam(there)) nodes_.insert(point(b));
    });
  }

  void end_at_cut(const Piece& piece, const Cut& cut) {
    for (const std::array<int, 2>& edge : cut.edges)
      for (const int v : edge) {
        const int vertex = piece.vertex[v];
        if (next_[vertex] >= 0 && around_.contains(point(vertex))) nodes_.insert(point(vertex));
      }
  }

  void trace_all() {
    for (const auto& [at, others] : around_)
      if (nodes_.contains(at))
        for (const int other : others) trace(at, other);
    // Closed curves without an end begin at their least point.
    for (const auto& [key, place] : seams_) {
      if (place.curve >= 0) continue;
      nodes_.insert(key.first);
      trace(key.first, key.second);
    }
  }

  void trace(int from, int to) {
    if (seams_.at(key_of(from, to)).curve >= 0) return;
    const auto curve = static_cast<int>(lengths_.size());
    lengths_.push_back(0);
    for (;;) {
      seams_.at(key_of(from, to)) = {curve, from < to};
      lengths_.back() += length(place(to) - place(from));
      if (nodes_.contains(to)) return;
      const std::vector<int>& others = around_.at(to);
      const int beyond = others[0] == from ? others[1] : others[0];
      from = std::exchange(to, beyond);
    }
  }
  [[nodiscard]] Vec3d place(int point) const { return input_.mesh.positions[places_.at(point)]; }

  void add_border(const Piece& piece, FixedBorder& border) const {
    for (std::size_t v = 0; v < piece.vertex.size(); ++v) {
      const int a = piece.vertex[v], b = next_[a];
      if (b < 0) continue;
      if (nodes_.contains(point(a))) border.nodes.push_back(static_cast<int>(v));
      const auto found = seams_.find(key_of(point(a), point(b)));
      if (found == seams_.end()) continue;
      const Place& seam = found->second;
      border.edges.push_back(
          {static_cast<int>(v), number_[b], seam.curve, (point(a) < point(b)) == seam.ascends});
    }
  }

  template <class Visit>
  void for_border(const Visit& visit) {
    for (int a = 0; a < static_cast<int>(next_.size()); ++a) {
      if (next_[a] < 0) continue;
      places_.emplace(point(a), a);
      visit(a, next_[a]);
    }
  }

  /// Where an edge lies: on which curve, and whether that runs from its lesser to its larger point.
  struct Place {
    int curve = -1;
    bool ascends = true;
  };
  const RepairedMesh& input_;
  const std::vector<Triangle>& triangles_;
  std::vector<int> next_;                   // [V] along the border; -1 inside
  std::map<int, int> places_;               // of points on borders, a vertex there
  std::map<EdgeKey, Place> seams_;          // the parted edges
  std::map<int, std::vector<int>> around_;  // of points, the other ends of their parted edges
  std::set<int> nodes_;                     // points where curves end
  std::vector<double> lengths_;
  std::vector<int> number_;  // [V] within its piece
};

}  // namespace

SeamCurves find_seam_curves(const RepairedMesh& input, std::span<const Piece> pieces,
                            std::span<const Cut> cuts) {
  if (input.joined.empty()) return {{}, std::vector<FixedBorder>(pieces.size())};
  return CurveFinder(input, pieces, cuts).gather(pieces);
}

}  // namespace weft
