// Sewing patterns, and garments as images of charts.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "python/src/arrays.h"
#include "python/src/calls.h"
#include "python/src/images.h"
#include "weft/files.h"
#include "weft/garment.h"

namespace weft::python {
namespace {

namespace py = pybind11;

py::array pairs_of(std::vector<Vec2d> points) {
  const auto count = static_cast<py::ssize_t>(points.size());
  return array_of<double>(std::move(points), {count, 2});
}

py::dict edge_of(const PatternEdge& edge) {
  const PatternCurve& curve = edge.curve;
  const bool arc = curve.kind == PatternCurve::Kind::arc;
  py::dict told;
  told["ends"] = py::make_tuple(edge.from, edge.to);
  told["label"] = edge.label;
  told["kind"] = arc ? "arc" : curve.kind == PatternCurve::Kind::bezier ? "bezier" : "straight";
  told["controls"] = pairs_of(curve.controls);
  told["radius"] = arc ? py::object(py::float_(curve.radius)) : py::none();
  told["large"] = curve.large;
  told["counterclockwise"] = curve.counterclockwise;
  return told;
}

py::dict panel_of(const PatternPanel& panel) {
  py::dict told;
  told["name"] = panel.name;
  told["label"] = panel.label;
  told["vertices"] = pairs_of(panel.vertices);
  py::list edges;
  for (const PatternEdge& edge : panel.edges) edges.append(edge_of(edge));
  told["edges"] = edges;
  told["rotate"] = py::make_tuple(panel.rotate.x, panel.rotate.y, panel.rotate.z);
  told["translate"] = py::make_tuple(panel.translate.x, panel.translate.y, panel.translate.z);
  return told;
}

py::bytes file_bytes(const std::string& path) {
  std::string bytes;
  {
    const Released released;
    bytes = read_file(path);
  }
  return bytes;
}

/// Panels, stitches as (panel, edge, panel, edge, turned), and notes of a pattern file's text.
py::tuple parse_panels(const std::string& text, const std::string& path) {
  Pattern pattern;
  {
    const Released released;
    pattern = parse_pattern(text, path);
  }
  py::list panels, stitches;
  for (const PatternPanel& panel : pattern.panels) panels.append(panel_of(panel));
  for (const Stitch& s : pattern.stitches)
    stitches.append(py::make_tuple(s.a.panel, s.a.edge, s.b.panel, s.b.edge, s.turned));
  return py::make_tuple(panels, stitches, pattern.notes);
}

std::vector<std::int32_t> sewn_classes(const BorderMates& mates) {
  std::vector<std::int32_t> classes;
  for (int s = 0; s < mates.size() * mates.size(); ++s)
    classes.push_back(mates.is_hole(s) ? -1 : mates.representative(s));
  return classes;
}

/// Image, places in the pattern [n, n, 2], sewn classes [n, n] and seams as (name, [k, 2]).
py::tuple sew_panels(const std::string& text, const std::string& path, double spacing,
                     const py::object& progress) {
  const auto made = std::make_shared<Garment>();
  run_released(progress, [text, path, spacing, made](Progress& told) {
    *made = make_garment(parse_pattern(text, path), path, spacing, &told);
  });
  const py::ssize_t n = made->image.size();
  std::vector<Vec2f> places;
  for (const Vec3f p : samples_of(made->texture)) places.push_back({p.x, p.y});
  py::list seams;
  for (GarmentSeam& seam : made->seams) {
    const auto count = static_cast<py::ssize_t>(seam.pairs.size());
    seams.append(
        py::make_tuple(seam.name, array_of<std::int32_t>(std::move(seam.pairs), {count, 2})));
  }
  return py::make_tuple(Image{std::make_shared<const GeometryImage>(std::move(made->image))},
                        array_of<float>(std::move(places), {n, n, 2}),
                        array_of<std::int32_t>(sewn_classes(made->sewn), {n, n}), seams);
}

}  // namespace

void add_garments(py::module_& module) {
  module.attr("default_spacing") = default_spacing;
  module.def("read_file", &file_bytes);
  module.def("parse_pattern", &parse_panels);
  module.def("sew_pattern", &sew_panels);
}

}  // namespace weft::python
