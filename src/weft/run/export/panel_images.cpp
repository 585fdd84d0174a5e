#include "weft/run/export/panel_images.h"

#include <vector>

#include "weft/image/io/image_parts.h"
#include "weft/run/export/distinct_names.h"
#include "weft/run/export/exported_surface.h"

namespace weft {
namespace {

/// Names of panels as names of files, which unpacking may make of them, no two alike.
std::vector<std::string> file_names(const std::vector<Chart>& charts) {
  std::vector<std::string> names;
  DistinctNames distinct;
  const auto unwanted = [](char c) { return c == '/' || c == '\\' || c == '\0'; };
  for (const Chart& chart : charts) names.push_back(distinct.add(chart.name, unwanted));
  return names;
}

ImagePart::Channel channel_of(const char* name, const Chart& chart, const Grid<float>& plane,
                              float scale) {
  ImagePart::Channel channel{name, {}};
  for (int r = 0; r < chart.rows; ++r)
    for (int c = 0; c < chart.cols; ++c)
      channel.values.push_back(scale * plane(chart.row + r, chart.col + c));
  return channel;
}

}  // namespace

PanelImages panel_images(const Garment& garment, const Planes3& samples) {
  const std::vector<Chart>& charts = garment.image.mates.charts();
  const std::vector<std::string> names = file_names(charts);
  std::vector<ImagePart> parts, arrays;
  for (std::size_t p = 0; p < charts.size(); ++p) {
    const Chart& chart = charts[p];
    const ImagePart position{
        names[p] + ".position",
        chart.rows,
        chart.cols,
        {channel_of("R", chart, samples.x, 1), channel_of("G", chart, samples.y, 1),
         channel_of("B", chart, samples.z, 1)}};
    const ImagePart pattern{names[p] + ".pattern",
                            chart.rows,
                            chart.cols,
                            {channel_of("U", chart, garment.texture.x, pattern_units),
                             channel_of("V", chart, garment.texture.y, pattern_units)}};
    arrays.push_back(position);
    arrays.push_back(pattern);
    ImagePart both = position;
    both.name = names[p];
    both.channels.insert(both.channels.end(), pattern.channels.begin(), pattern.channels.end());
    parts.push_back(std::move(both));
  }
  return {encode_exr_parts(parts), encode_npz_parts(arrays)};
}

}  // namespace weft
