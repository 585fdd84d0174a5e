#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"

namespace weft {
namespace {

/// Reads the first line: OFF, after letters for texture (ST), colour (C) or normal (N) of each
/// vertex.
void read_keyword(LineReader& reader) {
  if (!reader.next_filled_line()) reader.fail("no line with content", "an OFF mesh is wanted");
  const std::string_view keyword = reader.next_field();
  const bool known =
      keyword.ends_with("OFF") &&
      keyword.substr(0, keyword.size() - 3).find_first_not_of("STCN") == keyword.npos;
  if (!known) reader.fail("begins with " + in_quotes(keyword), "the keyword OFF is wanted");
}

struct Counts {
  std::int64_t vertices = 0, faces = 0;
};

Counts read_counts(LineReader& reader) {
  LineReader ahead = reader;
  if (ahead.next_field().empty() && !reader.next_filled_line())
    reader.fail("the file ends before the counts", "vertex and face count are wanted");
  Counts counts;
  counts.vertices = reader.integer("the vertex count", 1, max_elements);
  counts.faces = reader.integer("the face count", 1, max_elements);
  // A line takes at least two bytes: this keeps a false count from allocating. Smaller differences
  // are found when lines are missing.
  const std::size_t left = reader.remaining().size();
  if (2 * (counts.vertices + counts.faces) > static_cast<std::int64_t>(left) + 1)
    reader.fail(fmt::format("{} vertices and {} faces cannot fit into the {} bytes that follow",
                            counts.vertices, counts.faces, left),
                "a whole file is wanted");
  return counts;
}

void read_face(LineReader& reader, TriangleMesh& mesh, std::vector<int>& polygon) {
  const auto last = static_cast<std::int64_t>(mesh.positions.size()) - 1;
  const std::int64_t corners = reader.integer("the number of corners", 3, max_elements);
  polygon.clear();
  for (std::int64_t i = 0; i < corners; ++i)
    polygon.push_back(static_cast<int>(reader.integer("a vertex index", 0, last)));
  add_polygon(mesh, polygon);
}

void next_line_of(LineReader& reader, std::string_view what, std::int64_t done,
                  std::int64_t count) {
  if (!reader.next_filled_line())
    reader.fail(fmt::format("the file ends after {} of {} {}", done, count, what),
                "a whole file is wanted");
}

}  // namespace

TriangleMesh parse_off(std::string_view bytes, std::string_view name) {
  require_text(bytes, name, "an OFF text file");
  LineReader reader(without_mark(bytes), name);
  read_keyword(reader);
  const Counts counts = read_counts(reader);
  TriangleMesh mesh;
  mesh.positions.reserve(counts.vertices);
  mesh.triangles.reserve(counts.faces);
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    next_line_of(reader, "vertices", i, counts.vertices);
    const double x = reader.coordinate();
    const double y = reader.coordinate();
    const double z = reader.coordinate();
    mesh.positions.push_back({x, y, z});
  }
  std::vector<int> polygon;
  for (std::int64_t i = 0; i < counts.faces; ++i) {
    next_line_of(reader, "faces", i, counts.faces);
    read_face(reader, mesh, polygon);
  }
  if (reader.next_filled_line())
    reader.fail(
        "content behind the last face",
        fmt::format("{} vertices and {} faces are announced", counts.vertices, counts.faces));
  require_surface(mesh, name);
  return mesh;
}

}  // namespace weft
