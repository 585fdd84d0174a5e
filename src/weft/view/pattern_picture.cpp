#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "weft/drawing.h"
#include "weft/garment.h"
#include "weft/garment/edge_curve.h"
#include "weft/picture.h"
#include "weft/view/polygon.h"
#include "weft/view/text.h"

namespace weft {
namespace {

constexpr Vec3f white{1, 1, 1}, fabric{0.93F, 0.91F, 0.87F}, hem{0.25F, 0.26F, 0.28F},
    name_colour{0.15F, 0.15F, 0.17F};
/// Of the picture's shorter side: between panels, less where they are many, and of lines.
constexpr double gap_share = 0.035, gap_share_of_many = 0.2, seam_share = 0.007, hem_share = 0.003;
/// Halvings of the scale's bounds.
constexpr int halvings = 30;

/// A panel as it lies in its file.
struct FlatPanel {
  std::vector<std::vector<Vec2d>> edges;  // [m]
  Vec2d low, extent;                      // of its box [m]
  int name_width = 0;                     // [pixels]
};

FlatPanel flat_of(const PatternPanel& panel) {
  FlatPanel flat;
  Vec2d low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const PatternEdge& edge : panel.edges) {
    flat.edges.push_back(edge_polyline(panel, edge));
    for (const Vec2d p : flat.edges.back()) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  flat.low = low;
  flat.extent = high - low;
  return flat;
}

/// Panels in rows, the highest first, that fill a picture.
class PanelLayout {
 public:
  PanelLayout(const Pattern& pattern, int width, int height)
      : width_(width),
        height_(height),
        gap_(std::min(width, height) *
             std::min(gap_share, gap_share_of_many / std::sqrt(pattern.panels.size()))) {
    for (const PatternPanel& panel : pattern.panels) {
      panels_.push_back(flat_of(panel));
      panels_.back().name_width = text_width(panel.name, text_scale());
    }
    order_.resize(panels_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return panels_[a].extent.y > panels_[b].extent.y; });
    if (!place(0)) leave_names_out();
    scale_ = largest_scale();
    place(scale_);
    for (Vec2d& corner : corners_) corner.y += 0.5 * (height_ - bottom_);
  }

  [[nodiscard]] int text_scale() const { return std::max(1, std::min(width_, height_) / 480); }
  [[nodiscard]] bool has_names() const { return has_names_; }
  [[nodiscard]] const FlatPanel& panel(std::size_t k) const { return panels_[k]; }
  /// Of a point of the panel. [pixels]
  [[nodiscard]] Vec2d pixel(std::size_t k, Vec2d point) const {
    const Vec2d in = point - panels_[k].low;
    return corners_[k] + scale_ * Vec2d{in.x, panels_[k].extent.y - in.y};
  }
  [[nodiscard]] Vec2d middle(std::size_t k) const {
    return corners_[k] + (0.5 * scale_) * panels_[k].extent;
  }

 private:
  /// For a picture that would have no room but for them.
  void leave_names_out() {
    has_names_ = false;
    for (FlatPanel& panel : panels_) panel.name_width = 0;
  }
  /// Bisection: what fits at a scale fits at smaller ones, but for rows that break otherwise.
  double largest_scale() {
    double low = 0, high = 0;
    for (const FlatPanel& panel : panels_)
      high = std::max({high, width_ / panel.extent.x, height_ / panel.extent.y});
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (place(middle) ? low : high) = middle;
    }
    return low;
  }
  /// Each with room for its name. @return whether they fit
  bool place(double scale) {
    corners_.resize(panels_.size());
    double x = gap_, y = gap_, row = 0;
    bool fits = true;
    for (const int k : order_) {
      const Vec2d size = scale * panels_[k].extent;
      const double room = std::max<double>(size.x, panels_[k].name_width);
      if (x > gap_ && x + room + gap_ > width_) {
        x = gap_;
        y += row + gap_;
        row = 0;
      }
      corners_[k] = {x + 0.5 * (room - size.x), y};
      x += room + gap_;
      row = std::max(row, size.y);
      fits = fits && x <= width_;
    }
    bottom_ = y + row + gap_;
    return fits && bottom_ <= height_;
  }

  int width_, height_;
  double gap_, scale_ = 0, bottom_ = 0;  // [pixels], [pixels a metre], [pixels]
  bool has_names_ = true;
  std::vector<FlatPanel> panels_;
  std::vector<int> order_;
  std::vector<Vec2d> corners_;  // upper left [pixels]
};

class PatternDrawing {
 public:
  PatternDrawing(const Pattern& pattern, int width, int height)
      : pattern_(pattern),
        layout_(pattern, width, height),
        picture_(blank_picture(width, height, white)) {}

  Picture draw() {
    for (std::size_t k = 0; k < pattern_.panels.size(); ++k) draw_panel(k);
    for (std::size_t s = 0; s < pattern_.stitches.size(); ++s)
      for (const PanelEdge& edge : {pattern_.stitches[s].a, pattern_.stitches[s].b})
        draw_edge(edge, seam_share, curve_colour(static_cast<int>(s)));
    for (std::size_t k = 0; layout_.has_names() && k < pattern_.panels.size(); ++k) draw_name(k);
    return std::move(picture_);
  }

 private:
  [[nodiscard]] int side() const { return std::min(picture_.width, picture_.height); }
  [[nodiscard]] std::vector<Vec2d> pixels(std::size_t k, const std::vector<Vec2d>& points) const {
    std::vector<Vec2d> pixels;
    pixels.reserve(points.size());
    for (const Vec2d p : points) pixels.push_back(layout_.pixel(k, p));
    return pixels;
  }
  void draw_panel(std::size_t k) {
    std::vector<Vec2d> outline;
    for (const auto& edge : layout_.panel(k).edges) {
      const std::vector<Vec2d> part = pixels(k, edge);
      outline.insert(outline.end(), part.begin(), part.end());
    }
    fill_polygon(picture_, outline, fabric);
    for (std::size_t e = 0; e < layout_.panel(k).edges.size(); ++e)
      draw_edge({static_cast<int>(k), static_cast<int>(e)}, hem_share, hem);
  }
  void draw_edge(const PanelEdge& edge, double share, Vec3f colour) {
    draw_line(picture_, pixels(edge.panel, layout_.panel(edge.panel).edges[edge.edge]),
              std::max(1.0, share * side()), colour);
  }
  void draw_name(std::size_t k) {
    const int scale = layout_.text_scale();
    const std::string& name = pattern_.panels[k].name;
    const Vec2d at = layout_.middle(k);
    draw_text(picture_, name,
              {static_cast<int>(at.x) - text_width(name, scale) / 2,
               static_cast<int>(at.y) - text_height(scale) / 2, scale},
              name_colour);
  }

  const Pattern& pattern_;
  PanelLayout layout_;
  Picture picture_;
};

}  // namespace

Picture draw_pattern(const Pattern& pattern, int width, int height) {
  return PatternDrawing(pattern, width, height).draw();
}

}  // namespace weft
