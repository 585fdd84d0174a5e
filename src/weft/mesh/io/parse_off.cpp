#include <array>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"

// A vertex or a face that is not whole at the end of its line goes on on the next. What follows it
// on its last line, such as its colour, is not needed: so each begins on a line of its own.

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

/// Binary OFF says so in its first line, of which its zero bytes would tell less.
void refuse_binary(std::string_view text, std::string_view name) {
  LineReader reader(text, name);
  reader.next_filled_line();
  if (reader.next_field().ends_with("OFF") && reader.next_field() == "BINARY")
    reader.fail("is binary OFF", "OFF as text is wanted");
}

/// Goes on on the next line where this one has no further field.
void reach_field(LineReader& reader, std::string_view what) {
  if (!reader.has_field() && !reader.next_filled_line())
    reader.fail(fmt::format("the file ends before {}", what), "a whole file is wanted");
}

/// Steps over an edge count that has a line to itself, lest it count as a coordinate.
void skip_edge_count(LineReader& reader) {
  LineReader ahead = reader;
  if (!reader.has_field() && ahead.next_filled_line() && to_integer(ahead.next_field()) &&
      !ahead.has_field())
    reader = ahead;
}

struct Counts {
  std::int64_t vertices = 0, faces = 0;
};

Counts read_counts(LineReader& reader) {
  Counts counts;
  reach_field(reader, "the counts");
  counts.vertices = reader.integer("the vertex count", 0, max_elements);
  reach_field(reader, "the face count");
  counts.faces = reader.integer("the face count", 0, max_elements);
  skip_edge_count(reader);
  // A line takes at least two bytes: this keeps a false count from allocating. Smaller differences
  // are found when lines are missing.
  const std::size_t left = reader.remaining().size();
  if (2 * (counts.vertices + counts.faces) > static_cast<std::int64_t>(left) + 1)
    reader.fail(fmt::format("{} vertices and {} faces cannot fit into the {} bytes that follow",
                            counts.vertices, counts.faces, left),
                "a whole file is wanted");
  return counts;
}

void read_vertex(LineReader& reader, TriangleMesh& mesh) {
  std::array<double, 3> p{};
  for (double& x : p) {
    reach_field(reader, "three coordinates");
    x = reader.coordinate();
  }
  mesh.positions.push_back({p[0], p[1], p[2]});
}

void read_face(LineReader& reader, TriangleMesh& mesh, std::vector<int>& polygon) {
  const auto last = static_cast<std::int64_t>(mesh.positions.size()) - 1;
  const std::int64_t corners = reader.integer("the number of corners", 3, max_elements);
  polygon.clear();
  for (std::int64_t i = 0; i < corners; ++i) {
    reach_field(reader, "a vertex index");
    polygon.push_back(static_cast<int>(reader.integer("a vertex index", 0, last)));
  }
  add_polygon(mesh, polygon);
}

void next_line_of(LineReader& reader, std::string_view what, std::int64_t done,
                  std::int64_t count) {
  if (!reader.next_filled_line())
    reader.fail(fmt::format("the file ends after {} of {} {}", done, count, what),
                "a whole file, each vertex and face on lines of its own, is wanted");
}

}  // namespace

TriangleMesh parse_off(std::string_view bytes, std::string_view name) {
  std::string decoded;
  const std::string_view text = plain_text(bytes, decoded);
  refuse_binary(text, name);
  require_text(text, name, "an OFF text file");
  LineReader reader(text, name);
  read_keyword(reader);
  const Counts counts = read_counts(reader);
  TriangleMesh mesh;
  mesh.positions.reserve(counts.vertices);
  mesh.triangles.reserve(counts.faces);
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    next_line_of(reader, "vertices", i, counts.vertices);
    read_vertex(reader, mesh);
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
