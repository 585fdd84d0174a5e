#include <climits>

#include <fmt/format.h>

#include "weft/cut/seam.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"

namespace weft {

Seam parse_seam(std::string_view bytes, std::string_view name) {
  require_text(bytes, name, "a text file of vertex paths");
  Seam seam{std::string(name), {}};
  LineReader reader(without_mark(bytes), name);
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

}  // namespace weft
