#include "weft/convert/automatic_size.h"

#include "weft/geometry_image.h"
#include "weft/param/border_layout.h"

namespace weft {
namespace {

constexpr int min_suitable = 33;
/// More samples than this for detail alone are to be asked for.
constexpr int max_for_detail = 1025;
/// The paths that better the map later lengthen the border, and one interval a path distorts.
constexpr int spare_border = 2;

}  // namespace

int suitable_size(const CutDisk& cut, int vertex_count) {
  const int border = spare_border * (min_size(cut) - 1);
  int n = min_suitable;
  const auto larger = [&] { return n = 2 * n - 1; };
  while (n < max_for_detail && n * n < vertex_count) larger();
  while (n - 1 < border && 2 * n - 1 <= largest_image_size) larger();
  return n;
}

}  // namespace weft
