#include "weft/image/image_colours.h"

#include <fmt/format.h>

#include "weft/error.h"

namespace weft {
namespace {

bool is_colour(Vec3f c) {
  // Written so that what is not finite is none.
  return c.x >= 0 && c.x <= 1 && c.y >= 0 && c.y <= 1 && c.z >= 0 && c.z <= 1;
}

}  // namespace

void check_colours(const GeometryImage& image, std::string_view name) {
  if (!image.has_colours()) return;
  const int n = image.size();
  if (image.colours.size() != n)
    throw InputError(name, fmt::format("colours of a side of {}", image.colours.size()),
                     fmt::format("{} is wanted", n));
  for (int s = 0; s < n * n; ++s)
    if (!image.mates.is_hole(s) && !is_colour(image.colours.at(s)))
      throw InputError(name, fmt::format("the colour of row {}, column {}", s / n, s % n),
                       "red, green and blue from 0 to 1 are wanted");
}

void join_colours(GeometryImage& image) {
  for (int s = 0; s < image.colours.size() * image.colours.size(); ++s)
    image.colours.set(s, image.colours.at(image.mates.representative(s)));
}

std::vector<Vec3f> vertex_colours(const GeometryImage& image, const RebuiltMesh& rebuilt) {
  std::vector<Vec3f> colours;
  if (!image.has_colours()) return colours;
  colours.reserve(rebuilt.sample_of.size());
  for (const int sample : rebuilt.sample_of) colours.push_back(image.colours.at(sample));
  return colours;
}

}  // namespace weft
