#include <array>
#include <cctype>

#include <fmt/format.h>

#include "weft/core/names.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"
#include "weft/repair.h"

namespace weft {
namespace {

constexpr std::size_t header_size = 84;  // 80 bytes of text and the count
constexpr std::size_t facet_size = 50;   // normal, three corners, two spare bytes

/// Facets of a text file hold their corners between "outer loop" and "endloop".
class TextFacets {
 public:
  TextFacets(std::string_view bytes, std::string_view name) : reader_(bytes, name) {}

  TriangleMesh read() {
    while (reader_.next_filled_line()) parse_line(lower_case(reader_.next_field()));
    if (inside_) reader_.fail("the file ends inside a solid", "endsolid is wanted");
    return std::move(mesh_);
  }

 private:
  void parse_line(const std::string& keyword) {
    if (keyword == "vertex") return parse_vertex();
    if (keyword == "endloop") return end_loop();
    if (!loop_.empty())
      reader_.fail(in_quotes(keyword) + " inside a loop", "vertex or endloop is wanted");
    if (keyword == "solid" || keyword == "endsolid") {
      inside_ = keyword == "solid";
    } else if (keyword != "outer" && keyword != "facet" && keyword != "endfacet") {
      reader_.fail("the line begins with " + in_quotes(keyword),
                   "solid, facet, outer loop, vertex or an end of them is wanted");
    }
  }

  void parse_vertex() {
    const double x = reader_.coordinate();
    const double y = reader_.coordinate();
    const double z = reader_.coordinate();
    loop_.push_back(static_cast<int>(mesh_.positions.size()));
    mesh_.positions.push_back({x, y, z});
  }

  void end_loop() {
    if (loop_.size() < 3)
      reader_.fail(fmt::format("a facet with {} vertices", loop_.size()), "at least 3 are wanted");
    add_polygon(mesh_, loop_);
    loop_.clear();
  }

  LineReader reader_;
  TriangleMesh mesh_;
  std::vector<int> loop_;
  bool inside_ = false;
};

std::uint64_t binary_size(std::string_view bytes) {
  return header_size +
         facet_size * std::uint64_t{load_integer<std::uint32_t>(bytes.substr(80), false)};
}

TriangleMesh read_binary(std::string_view bytes, std::string_view name) {
  TriangleMesh mesh;
  for (std::size_t at = header_size; at < bytes.size(); at += facet_size) {
    const int first = static_cast<int>(mesh.positions.size());
    for (std::size_t i = 3; i < 12; i += 3) {
      std::array<double, 3> p{};
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = load_float(bytes.substr(at + 4 * (i + k)), false);
        const std::string_view fault = coordinate_fault(p[k]);
        if (!fault.empty())
          throw InputError(name, fmt::format("a coordinate of facet {} {}", first / 3, fault),
                           "finite numbers are wanted");
      }
      mesh.positions.push_back({p[0], p[1], p[2]});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Whether a file looks like text. Many binary files begin with "solid", so the size of a binary
/// file is checked first.
bool looks_like_text(std::string_view bytes) {
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return start != bytes.npos && lower_case(bytes.substr(start, 5)) == "solid" &&
         bytes.find('\0') == bytes.npos;
}

}  // namespace

TriangleMesh parse_stl(std::string_view bytes, std::string_view name) {
  if (bytes.empty()) throw InputError(name, "is empty", "an STL mesh is wanted");
  TriangleMesh mesh;
  std::string decoded;
  if (bytes.size() >= header_size && bytes.size() == binary_size(bytes)) {
    mesh = read_binary(bytes, name);
  } else if (const std::string_view text = plain_text(bytes, decoded); looks_like_text(text)) {
    mesh = TextFacets(text, name).read();
  } else {
    const std::string found =
        bytes.size() < header_size || bytes.find('\0') == bytes.npos
            ? "begins with " + in_quotes(bytes.substr(0, bytes.find_first_of("\r\n")))
            : fmt::format("is {} bytes long where its facet count asks for {}", bytes.size(),
                          binary_size(bytes));
    throw InputError(name, found, "a whole STL file, text (solid ...) or binary, is wanted");
  }
  require_surface(mesh, name);
  return weld_exact(mesh);
}

}  // namespace weft
