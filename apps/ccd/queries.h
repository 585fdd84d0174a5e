#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weft/collide/ccd.h"

namespace weft::ccd {

enum class QueryKind { edge_edge, vertex_face };

/// A moving pair of primitives and whether it collides.
struct Query {
  /// At the start, then at the end: the ends of the first and of the second edge, or the vertex and
  /// the corners of the face.
  std::array<Vec3d, 8> points;
  bool collides = false;
  /// Largest difference of a coordinate from the file's; 0 where doubles hold them all.
  double input_error = 0;
};

struct QueryFile {
  QueryKind kind = QueryKind::edge_edge;
  std::vector<Query> queries;
};

/// Reads a CSV file of 8 lines a query: x, y and z as numerator,denominator each, and the truth (0
/// or 1, the same in all 8).
/// @throws InputError for a file that cannot be read, whose name has neither `edge-edge` nor
/// `vertex-face` in it, or that is not of that form
QueryFile read_queries(const std::filesystem::path& path);
/// Reads the same from memory; `name` is what errors call it.
std::vector<Query> parse_queries(std::string_view text, const std::string& name);

/// Answers a query by time_of_impact.
std::optional<Impact> answer(const Query& query, QueryKind kind, CcdOptions options);

}  // namespace weft::ccd
