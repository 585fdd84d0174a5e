#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/progress.h"
#include "weft/vec.h"

namespace weft {

/// How an edge of a panel goes from its first corner to its last.
struct PatternCurve {
  enum class Kind { straight, bezier, arc } kind = Kind::straight;
  /// Of a Bezier curve of second or third order: one or two control points. [m], in the panel
  std::vector<Vec2d> controls{};
  double radius = 0;              ///< of an arc [m]
  bool large = false;             ///< the longer of the arcs of that radius
  bool counterclockwise = false;  ///< the way an arc is walked, y up
};

struct PatternEdge {
  int from = 0, to = 0;  ///< vertices of the panel
  PatternCurve curve{};
  std::string label{};  ///< body part that the edge is held at; may be empty
};

/// A flat piece of fabric. Its edges are one closed loop, each beginning where the one before it
/// ends; the fabric's outer side is that from which the loop is walked counter-clockwise once it is
/// placed.
struct PatternPanel {
  std::string name, label;
  std::vector<Vec2d> vertices;  ///< [m], y along the grain
  std::vector<PatternEdge> edges;
  Vec3d rotate;     ///< degrees about x, then y, then z of the panel's own axes: R = Rz Ry Rx
  Vec3d translate;  ///< [m], after rotating
  [[nodiscard]] Vec3d placed(Vec2d point) const;
};

struct PanelEdge {
  int panel = 0, edge = 0;
};

/// Two edges that are sewn together, the start of one to the end of the other; where it is `turned`
/// the start of one to the start of the other.
struct Stitch {
  PanelEdge a, b;
  bool turned = false;
};

struct Pattern {
  std::vector<PatternPanel> panels;
  std::vector<Stitch> stitches;
  std::vector<std::string> notes{};  ///< what was left out of the file
};

/// Reads a sewing pattern as GarmentCode writes them (`*_specification.json`) [korosteleva23].
/// @param name  what errors call it
/// @throws InputError naming panel and edge, for what is no pattern or cannot be sewn: outlines
/// that are not closed, cross themselves or are not finite, stitches of edges that do not exist, of
/// an edge with itself, or of one edge several times
Pattern parse_pattern(std::string_view text, const std::string& name);
Pattern read_pattern(const std::string& path);

struct PanelMeasures {
  double area = 0;                   ///< [m^2]
  Vec2d extent;                      ///< of its box along its own axes [m]
  std::vector<double> edge_lengths;  ///< of its edges, along their curves [m]
};
PanelMeasures measure_panel(const PatternPanel& panel);

/// True when a name ends as pattern files do: .json.
bool is_pattern_name(std::string_view name);

/// A seam of a garment: a run of pairs of samples that become one.
struct GarmentSeam {
  std::string name;                       ///< PANEL.EDGE-PANEL.EDGE
  std::vector<std::array<int, 2>> pairs;  ///< [k] samples
};

/// Distance between charts that are laid flat above each other, so that no two are near. [m]
inline constexpr float flat_distance = 0.5F;

/// What holds a panel up while it is sewn: the panels that it is sewn to, or edges with a label, at
/// the waist (skirts, trousers) or higher (all other labels).
enum class PanelHold : char { other_panels, waist, shoulders };

/// Where a garment is worn, as a collar or a waist.
struct GarmentLabel {
  std::string name;
  std::vector<int> samples;  ///< of all edges with this label
};

/// A pattern as an image of charts, one rectangle for each panel in the pattern's order.
struct Garment {
  std::string name;
  GeometryImage image;  ///< panels as the pattern places them, with no mates between them
  BorderMates sewn;     ///< the same charts with the seams closed
  Planes3 flat;         ///< [n x n] the panels laid flat, flat_distance above each other [m]
  Planes3 texture;      ///< [n x n] x and y in the pattern's panel [m]
  std::vector<GarmentSeam> seams;
  std::vector<PanelHold> panel_holds;  ///< of each panel, by the labels of its edges
  std::vector<GarmentLabel> labels;    ///< in the order of their first edges
};

/// Makes charts of a pattern's panels. Edges that are sewn together get as many samples as the
/// longer one asks for; samples lie evenly along edges, and inside so that no cell is folded.
/// @param spacing   wanted distance of samples [m]
/// @param progress  may be null
/// @throws InputError for panels that cannot be joined to an oriented surface, or are too large
Garment make_garment(const Pattern& pattern, const std::string& name, double spacing,
                     Progress* progress = nullptr);

/// Samples a side that the image of a garment has at least, by the area of its panels; what lies
/// between their rectangles makes it larger.
/// @param spacing  distance of samples [m]
int min_garment_size(const Pattern& pattern, double spacing);

/// The default distance of samples of a garment. [m]
inline constexpr double default_spacing = 0.008;

}  // namespace weft
