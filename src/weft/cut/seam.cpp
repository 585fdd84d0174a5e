#include "weft/cut/seam.h"

#include <algorithm>
#include <climits>

#include <fmt/format.h>

#include "weft/cut/cut_graph.h"
#include "weft/cut/cut_surface.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"

namespace weft {

Seam parse_seam(std::string_view bytes, std::string_view name) {
  std::string decoded;
  const std::string_view text = plain_text(bytes, decoded);
  require_text(text, name, "a text file of vertex paths");
  Seam seam{std::string(name), {}};
  LineReader reader(text, name);
  while (reader.next_filled_line()) {
    SeamPath path{reader.line_number(), {}};
    for (std::string_view field = reader.next_field(); !field.empty();
         field = reader.next_field()) {
      const std::optional<std::int64_t> vertex = to_integer(field);
      if (!vertex || *vertex < 0 || *vertex > INT_MAX)
        reader.fail(in_quotes(field), "vertex numbers from 0 are wanted");
      path.vertices.push_back(static_cast<int>(*vertex));
    }
    if (path.vertices.size() < 2)
      reader.fail("a path of one vertex", "at least two vertices are wanted");
    seam.paths.push_back(std::move(path));
  }
  if (seam.paths.empty())
    throw InputError(name, "has no path", "a line of vertex numbers is wanted");
  return seam;
}

Seam read_seam(const std::filesystem::path& path) {
  return parse_seam(read_file(path), path.string());
}
namespace {

using HalfEdgePath = std::vector<int>;

/// Finds the half-edges along a seam's paths.
class SeamFinder {
 public:
  SeamFinder(const CutSurface& surface, std::span<const int> source_vertex, const Seam& seam)
      : surface_(surface), seam_(seam) {
    for (std::size_t v = 0; v < source_vertex.size(); ++v) {
      const auto source = static_cast<std::size_t>(source_vertex[v]);
      if (source >= copies_.size()) copies_.resize(source + 1);
      copies_[source].push_back(static_cast<int>(v));
    }
  }

  [[nodiscard]] HalfEdgePath edges_of(const SeamPath& path) const {
    HalfEdgePath edges;
    for (std::size_t i = 1; i < path.vertices.size(); ++i) {
      const std::vector<int>& from = vertices_of(path, i - 1);
      const std::vector<int>& to = vertices_of(path, i);
      const HalfEdgePath piece = join(from, to);
      edges.insert(edges.end(), piece.begin(), piece.end());
    }
    return edges;
  }

  [[noreturn]] void fail(const SeamPath& path, const std::string& found,
                         const std::string& wanted) const {
    throw InputError(fmt::format("{}:{}", seam_.name, path.line), found, wanted);
  }

 private:
  /// The mesh's vertices with the number of the path's i-th vertex: several where repair split it.
  [[nodiscard]] const std::vector<int>& vertices_of(const SeamPath& path, std::size_t i) const {
    const auto number = static_cast<std::size_t>(path.vertices[i]);
    if (number >= copies_.size() || copies_[number].empty())
      fail(path, fmt::format("vertex {} is not in the mesh", number),
           fmt::format("vertices of the surface that is converted, from 0 to {} in the order of "
                       "its file, are wanted",
                       copies_.size() - 1));
    return copies_[number];
  }

  [[nodiscard]] HalfEdgePath join(const std::vector<int>& from, const std::vector<int>& to) const {
    const auto is_goal = [&](int v) { return std::find(to.begin(), to.end(), v) != to.end(); };
    // A shared edge is preferred to a path of several edges, which may be as short.
    int edge = -1;
    for (const int v : from)
      surface_.for_each_edge(v, [&](int h) {
        if (is_goal(surface_.other_end(h, v))) edge = h;
      });
    if (edge >= 0) return {edge};
    const PathTree tree = search_paths(surface_, from, is_goal);
    return path_to(surface_, tree, tree.end);
  }

  const CutSurface& surface_;
  const Seam& seam_;
  std::vector<std::vector<int>> copies_;  // vertices of the mesh by their number in the seam's file
};

void open_path(CutGraph& graph, const HalfEdgePath& path) {
  for (const int h : path) graph.add(h);
}

/// Throws for the first path that leaves the surface in several pieces.
void refuse_subdivisions(const CutSurface& surface, const SeamFinder& finder, const Seam& seam) {
  CutGraph graph(surface);
  for (const SeamPath& path : seam.paths) {
    open_path(graph, finder.edges_of(path));
    if (graph.piece_count() > 1)
      finder.fail(path, "this path cuts the surface in pieces",
                  "a seam that leaves it in one piece is wanted");
  }
}

}  // namespace

SeamCut cut_along_seam(const TriangleMesh& mesh, std::span<const int> source_vertex,
                       const Seam& seam, const CutOptions& options) {
  const CutSurface surface(mesh);
  const SeamFinder finder(surface, source_vertex, seam);
  CutGraph graph(surface);
  for (const SeamPath& path : seam.paths) open_path(graph, finder.edges_of(path));
  if (graph.piece_count() > 1) refuse_subdivisions(surface, finder, seam);
  SeamCut made{complete_cut(graph, options), 0};
  made.added_edges = static_cast<int>(made.cut.edges.size() - graph.cut().edges.size());
  return made;
}

}  // namespace weft
