#include "apps/ccd/queries.h"

#include <cmath>

#include "fuzz/properties.h"

namespace {

using namespace weft;
using namespace weft::fuzz;

void check_answer(const ccd::Query& query, ccd::QueryKind kind) {
  // More steps are the same again and would only make the fuzzer slow.
  const auto impact = ccd::answer(query, kind, {.max_steps = 200});
  if (!impact) return;
  require(impact->time >= 0 && impact->time <= 1, "the time lies in the motion");
  const double rounding = 1e-12;
  require(impact->u >= -rounding && impact->u <= 1 + rounding, "the first place is in range");
  require(impact->v >= -rounding && impact->v <= 1 + rounding, "the second place is in range");
  require(std::isfinite(impact->distance) && impact->distance >= 0, "the distance is a number");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = as_text(data, size);
  const auto read = [&] { return ccd::parse_queries(text, file_name); };
  const auto queries = read_or_refuse(read);
  if (!queries) return 0;
  require(!queries->empty(), "a file that is read has queries");
  for (const ccd::Query& query : *queries) {
    require(std::isfinite(query.input_error) && query.input_error >= 0, "errors are numbers");
    for (const Vec3d& p : query.points)
      require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "points are finite");
    check_answer(query, ccd::QueryKind::edge_edge);
    check_answer(query, ccd::QueryKind::vertex_face);
  }
  return 0;
}
