#include "apps/ccd/queries.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/multiprecision/cpp_int.hpp>
#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"

namespace weft::ccd {
namespace {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;

constexpr int points_a_query = 8, fields_a_line = 7;
/// Longer numbers are no coordinates; parsing takes time by the square of their length.
constexpr std::size_t max_digits = 1000;

class Reader {
 public:
  Reader(std::string_view text, std::string name) : name_(std::move(name)), rest_(text) {}

  std::vector<Query> read() {
    std::vector<Query> queries;
    while (!rest_.empty()) queries.push_back(query());
    if (queries.empty()) fail("is empty", "queries of 8 lines are wanted");
    return queries;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& wanted) const {
    throw InputError(line_ > 0 ? fmt::format("{}:{}", name_, line_) : name_, found, wanted);
  }

  Query query() {
    Query query;
    for (int i = 0; i < points_a_query; ++i) {
      if (rest_.empty())
        fail(fmt::format("the last query ends after {} lines", i), "8 lines a query are wanted");
      const bool collides = line(query.points[i], query.input_error);
      if (i > 0 && collides != query.collides)
        fail("the truth changes within a query", "the same in all of its 8 lines is wanted");
      query.collides = collides;
    }
    return query;
  }

  /// @return whether the query collides
  bool line(Vec3d& point, double& error) {
    ++line_;
    std::string_view text = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(rest_.size(), text.size() + 1));
    if (text.ends_with('\r')) text.remove_suffix(1);
    const auto fields = split(text);
    point = {number(fields[0], fields[1], error), number(fields[2], fields[3], error),
             number(fields[4], fields[5], error)};
    if (fields[6] != "0" && fields[6] != "1")
      fail(fmt::format("'{}' as truth", fields[6]), "0 or 1 is wanted");
    return fields[6] == "1";
  }

  [[nodiscard]] std::array<std::string_view, fields_a_line> split(std::string_view text) const {
    if (std::count(text.begin(), text.end(), ',') != fields_a_line - 1)
      fail("not 7 fields", "x, y and z as numerator,denominator each, and 0 or 1 are wanted");
    std::array<std::string_view, fields_a_line> fields;
    for (std::string_view& field : fields) {
      field = text.substr(0, text.find(','));
      text.remove_prefix(std::min(text.size(), field.size() + 1));
    }
    return fields;
  }

  [[nodiscard]] cpp_int whole(std::string_view text) const {
    const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
    const bool right =
        !digits.empty() && digits.size() <= max_digits &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!right) fail(fmt::format("'{}'", text.substr(0, 40)), "a whole number is wanted");
    // A leading zero would mean an octal number.
    const std::size_t first = std::min(digits.find_first_not_of('0'), digits.size() - 1);
    const cpp_int value{std::string(digits.substr(first))};
    return digits.size() < text.size() ? -value : value;
  }

  /// The double nearest to a quotient; raises `error` to a bound on the rounding error.
  [[nodiscard]] double number(std::string_view above, std::string_view below, double& error) const {
    const cpp_int denominator = whole(below);
    if (denominator <= 0) fail(fmt::format("denominator '{}'", below), "one above 0 is wanted");
    const cpp_rational exact(whole(above), denominator);
    const auto nearest = exact.convert_to<double>();
    // Products of three differences have to stay far from overflow.
    if (!(std::abs(nearest) < 1e30))
      fail(fmt::format("a coordinate of {:.3g}", nearest), "one below 1e30 is wanted");
    const cpp_rational lost = abs(exact - cpp_rational(nearest));
    // The conversion is right to a few units in the last place: twice as much is enough.
    if (lost != 0) error = std::max({error, 2 * lost.convert_to<double>(), 1e-300});
    return nearest;
  }

  std::string name_;
  std::string_view rest_;
  int line_ = 0;
};

QueryKind kind_of(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  if (name.find("edge-edge") != std::string::npos) return QueryKind::edge_edge;
  if (name.find("vertex-face") != std::string::npos) return QueryKind::vertex_face;
  throw InputError(path.string(), "a name that does not tell what the queries are",
                   "one with edge-edge or vertex-face in it is wanted");
}

}  // namespace

std::vector<Query> parse_queries(std::string_view text, const std::string& name) {
  return Reader(text, name).read();
}

QueryFile read_queries(const std::filesystem::path& path) {
  const QueryKind kind = kind_of(path);
  return {kind, parse_queries(read_file(path), path.string())};
}

std::optional<Impact> answer(const Query& query, QueryKind kind, CcdOptions options) {
  options.input_error = query.input_error;
  const auto& p = query.points;
  if (kind == QueryKind::vertex_face)
    return time_of_impact(VertexFace{p[0], {p[1], p[2], p[3]}},
                          VertexFace{p[4], {p[5], p[6], p[7]}}, options);
  return time_of_impact(EdgeEdge{{p[0], p[1]}, {p[2], p[3]}}, EdgeEdge{{p[4], p[5]}, {p[6], p[7]}},
                        options);
}

}  // namespace weft::ccd
