#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/garment.h"
#include "weft/garment/grid_map.h"
#include "weft/garment/panel_outline.h"
#include "weft/image/skyline.h"

namespace weft {
namespace {

/// The samples of a panel, in its own axes.
PlaneGrid samples_of(const PanelOutline& outline, const std::string& place, Progress* progress) {
  std::optional<PlaneGrid> grid =
      spread_inside(outline.border_from(outline.start), outline.rows, outline.cols, progress);
  if (!grid)
    throw InputError(place, "an outline that no unfolded grid fits into",
                     "a simpler outline, or more samples, are wanted");
  if (outline.mirrored)
    for (Vec2d& p : grid->points) p.x *= -1;
  return std::move(*grid);
}

/// Where an edge's first sample, as the outline is walked, lies on the border of its chart.
int position_of(const PanelOutline& outline, int point) {
  const int count = static_cast<int>(outline.points.size());
  return (point - outline.start + count) % count;
}

/// Skirts and trousers hang from edges that are labelled as an interface, tops from all others:
/// collars, armholes, the upper edge of what has no straps.
PanelHold hold_of(const PatternPanel& panel) {
  PanelHold hold = PanelHold::other_panels;
  for (const PatternEdge& edge : panel.edges)
    if (!edge.label.empty())
      hold =
          std::max(hold, edge.label == "lower_interface" ? PanelHold::waist : PanelHold::shoulders);
  return hold;
}

/// Places a rectangle for each panel in the smallest square image that they fit in one after the
/// other, the highest first, with at least two samples between them (LevelLayout::gap).
/// @return in the panels' order, without names  @param size  set to the image's; larger than any
/// image where they do not fit
std::vector<Chart> pack_panels(std::span<const PanelOutline> outlines, int& size) {
  constexpr int gap = 2;
  std::vector<int> order(outlines.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return outlines[a].rows > outlines[b].rows; });
  std::vector<Chart> charts(outlines.size());
  size = min_image_size;
  for (const PanelOutline& outline : outlines) size = std::max({size, outline.rows, outline.cols});
  const auto place_all = [&] {
    Skyline skyline(size + gap);
    return std::all_of(order.begin(), order.end(), [&](int k) {
      const PanelOutline& outline = outlines[k];
      const auto [col, row] = skyline.take(outline.cols + gap, outline.rows + gap);
      charts[k] = {"", row, col, outline.rows, outline.cols};
      return row + outline.rows <= size;
    });
  };
  while (!place_all() && size <= largest_image_size) ++size;
  return charts;
}

/// Of a panel with its edges as straight lines. [m^2]
double area_of(const PatternPanel& panel) {
  double twice = 0;
  for (const PatternEdge& edge : panel.edges)
    twice += cross(panel.vertices[edge.from], panel.vertices[edge.to]);
  return 0.5 * std::abs(twice);
}

/// Of all panels. [m^2]
double area_of(const Pattern& pattern) {
  double area = 0;
  for (const PatternPanel& panel : pattern.panels) area += area_of(panel);
  return area;
}

/// Refuses samples so close that no image holds them, before any are laid.
const Pattern& checked(const Pattern& pattern, const std::string& name, double spacing) {
  if (min_garment_size(pattern, spacing) > largest_image_size)
    throw InputError(
        name,
        fmt::format("{:.3g} m^2 with samples {:.3g} mm apart", area_of(pattern), 1000 * spacing),
        fmt::format("an image has at most {} samples a side: a wider spacing is wanted",
                    largest_image_size));
  return pattern;
}

class Maker {
 public:
  Maker(const Pattern& pattern, const std::string& name, double spacing, Progress* progress)
      : pattern_(pattern),
        name_(name),
        progress_(progress),
        outlines_(lay_outlines(checked(pattern, name, spacing), name, spacing, progress)) {}

  Garment make() {
    Garment garment;
    garment.name = name_;
    std::vector<Chart> charts = pack_panels(outlines_, size_);
    if (size_ > largest_image_size)
      throw InputError(name_, fmt::format("an image of {} samples a side", size_),
                       fmt::format("at most {}: a wider spacing is wanted", largest_image_size));
    for (std::size_t p = 0; p < charts.size(); ++p) charts[p].name = pattern_.panels[p].name;
    garment.image.mates = BorderMates(size_, charts, {});
    garment.flat = garment.texture = Planes3(size_);
    world_.resize(static_cast<std::size_t>(size_) * size_);
    for (std::size_t p = 0; p < charts.size(); ++p) lay(p, charts[p], garment);
    sew(charts, garment);
    find_labels(garment);
    for (const PatternPanel& panel : pattern_.panels) garment.panel_holds.push_back(hold_of(panel));
    fill_holes(garment);
    set_positions(garment.image);
    garment.image.source = name_;
    return garment;
  }

 private:
  void lay(std::size_t p, const Chart& chart, Garment& garment) {
    const PatternPanel& panel = pattern_.panels[p];
    const auto count = static_cast<double>(pattern_.panels.size());
    PartOfProgress part(progress_, "lay panels", 0.5 + 0.5 * static_cast<double>(p) / count, 1);
    const PlaneGrid grid =
        samples_of(outlines_[p], fmt::format("{}: panel '{}'", name_, panel.name), &part);
    Vec2d middle;
    for (const Vec2d& q : grid.points)
      middle = middle + (1.0 / static_cast<double>(grid.points.size())) * q;
    for (int r = 0; r < chart.rows; ++r)
      for (int c = 0; c < chart.cols; ++c) {
        const Vec2d q = grid.at(r, c);
        const int sample = (chart.row + r) * size_ + chart.col + c;
        world_[sample] = panel.placed(q);
        garment.texture.set(sample, {static_cast<float>(q.x), static_cast<float>(q.y), 0});
        garment.flat.set(sample,
                         {static_cast<float>(q.x - middle.x), static_cast<float>(q.y - middle.y),
                          flat_distance * static_cast<float>(p)});
      }
  }

  void sew(const std::vector<Chart>& charts, Garment& garment) const {
    const BorderMates& apart = garment.image.mates;
    std::vector<MateInterval> runs;
    for (const Stitch& stitch : pattern_.stitches) {
      const PanelOutline &a = outlines_[stitch.a.panel], &b = outlines_[stitch.b.panel];
      const int count = a.intervals[stitch.a.edge];
      const int first =
          apart.first_position(stitch.a.panel) + position_of(a, a.first[stitch.a.edge]);
      const int mate =
          apart.first_position(stitch.b.panel) + position_of(b, b.first[stitch.b.edge] + count);
      runs.push_back({first, mate, count, false});
      GarmentSeam seam{
          fmt::format("{}.{}-{}.{}", pattern_.panels[stitch.a.panel].name, stitch.a.edge,
                      pattern_.panels[stitch.b.panel].name, stitch.b.edge),
          {}};
      for (int k = 0; k <= count; ++k)
        seam.pairs.push_back({apart.sample_at(apart.along_border(first, k)),
                              apart.sample_at(apart.along_border(mate, -k))});
      garment.seams.push_back(std::move(seam));
    }
    garment.sewn = BorderMates(size_, charts, std::move(runs));
  }

  void find_labels(Garment& garment) const {
    const BorderMates& apart = garment.image.mates;
    for (std::size_t p = 0; p < outlines_.size(); ++p)
      for (std::size_t k = 0; k < pattern_.panels[p].edges.size(); ++k) {
        const std::string& label = pattern_.panels[p].edges[k].label;
        if (label.empty()) continue;
        const int first = apart.first_position(static_cast<int>(p)) +
                          position_of(outlines_[p], outlines_[p].first[k]);
        std::vector<int>& samples = samples_with(label, garment.labels);
        for (int i = 0; i <= outlines_[p].intervals[k]; ++i)
          samples.push_back(apart.sample_at(apart.along_border(first, i)));
      }
  }
  static std::vector<int>& samples_with(const std::string& label,
                                        std::vector<GarmentLabel>& labels) {
    for (GarmentLabel& known : labels)
      if (known.name == label) return known.samples;
    return labels.emplace_back(GarmentLabel{label, {}}).samples;
  }

  /// Holes lie where the sample is that shelters them.
  void fill_holes(Garment& garment) {
    const BorderMates& apart = garment.image.mates;
    for (int s = 0; s < size_ * size_; ++s) {
      const int at = apart.representative(s);
      if (!apart.is_hole(s)) continue;
      world_[s] = world_[at];
      garment.flat.set(s, garment.flat.at(at));
      garment.texture.set(s, garment.texture.at(at));
    }
  }

  void set_positions(GeometryImage& image) const {
    Vec3d low = world_.front(), high = low;
    for (const Vec3d& p : world_) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    image.world = {low, std::max({high.x - low.x, high.y - low.y, high.z - low.z})};
    image.cube = Planes3(size_);
    for (int s = 0; s < size_ * size_; ++s)
      image.cube.set(s, vec_cast<float>((1 / image.world.scale) * (world_[s] - low)));
  }

  const Pattern& pattern_;
  std::string name_;
  Progress* progress_;
  std::vector<PanelOutline> outlines_;
  int size_ = 0;
  std::vector<Vec3d> world_;  // [n * n] [m]
};

}  // namespace

int min_garment_size(const Pattern& pattern, double spacing) {
  constexpr double curved_part = 0.2;  // of the area, which edges may leave out
  const double side = std::sqrt((1 - curved_part) * area_of(pattern)) / spacing;
  return static_cast<int>(std::min(side, 2.0 * largest_image_size));
}

Garment make_garment(const Pattern& pattern, const std::string& name, double spacing,
                     Progress* progress) {
  return Maker(pattern, name, spacing, progress).make();
}

}  // namespace weft
