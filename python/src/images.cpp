#include "python/src/images.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "python/src/arrays.h"
#include "python/src/calls.h"
#include "weft/convert.h"
#include "weft/error.h"
#include "weft/image_file.h"
#include "weft/image_quality.h"
#include "weft/mesh_statistics.h"
#include "weft/shapes.h"

namespace weft::python {

namespace py = pybind11;

TriangleMesh mesh_of(const Doubles& vertices, const Ints& faces) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3 || faces.ndim() != 2 || faces.shape(1) != 3)
    throw py::value_error("arrays (n, 3) of vertices and (m, 3) of faces are wanted");
  TriangleMesh mesh;
  mesh.positions.reserve(static_cast<std::size_t>(vertices.shape(0)));
  const auto v = vertices.unchecked<2>();
  for (py::ssize_t i = 0; i < v.shape(0); ++i)
    mesh.positions.push_back({v(i, 0), v(i, 1), v(i, 2)});
  mesh.triangles.reserve(static_cast<std::size_t>(faces.shape(0)));
  const auto f = faces.unchecked<2>();
  for (py::ssize_t i = 0; i < f.shape(0); ++i)
    mesh.triangles.push_back({f(i, 0), f(i, 1), f(i, 2)});
  return mesh;
}

py::tuple arrays_of(TriangleMesh mesh) {
  const auto vertices = static_cast<py::ssize_t>(mesh.positions.size());
  const auto faces = static_cast<py::ssize_t>(mesh.triangles.size());
  return py::make_tuple(array_of<double>(std::move(mesh.positions), {vertices, 3}),
                        array_of<std::int32_t>(std::move(mesh.triangles), {faces, 3}));
}

std::vector<Vec3f> samples_of(const Planes3& planes) {
  std::vector<Vec3f> samples;
  const int count = planes.size() * planes.size();
  samples.reserve(static_cast<std::size_t>(count));
  for (int sample = 0; sample < count; ++sample) samples.push_back(planes.at(sample));
  return samples;
}

void set_texture(TriangleMesh& mesh, const Floats& corners) {
  if (corners.ndim() != 3 || corners.shape(0) != static_cast<py::ssize_t>(mesh.triangles.size()) ||
      corners.shape(1) != 3 || corners.shape(2) != 2)
    throw py::value_error("an array (m, 3, 2) of texture coordinates is wanted");
  const auto uv = corners.unchecked<3>();
  for (py::ssize_t i = 0; i < uv.shape(0); ++i)
    mesh.corner_uv.push_back(
        {{{uv(i, 0, 0), uv(i, 0, 1)}, {uv(i, 1, 0), uv(i, 1, 1)}, {uv(i, 2, 0), uv(i, 2, 1)}}});
}

namespace {

py::tuple read(const std::string& path) {
  TriangleMesh mesh = made_released([path] { return load_mesh(path); });
  std::vector<std::array<Vec2f, 3>> uv = std::move(mesh.corner_uv);
  const py::tuple arrays = arrays_of(std::move(mesh));
  const auto faces = static_cast<py::ssize_t>(uv.size());
  const py::object texture =
      uv.empty() ? py::none() : py::object(array_of<float>(std::move(uv), {faces, 3, 2}));
  return py::make_tuple(arrays[0], arrays[1], texture);
}

void write(const std::string& path, const Doubles& vertices, const Ints& faces) {
  const TriangleMesh mesh = mesh_of(vertices, faces);
  const Released released;
  write_mesh(path, mesh);
}

py::dict counts_of(const TopologyCounts& counts) {
  py::dict told;
  told["vertices"] = counts.vertices;
  told["triangles"] = counts.triangles;
  told["components"] = counts.components;
  told["boundaries"] = counts.boundaries;
  told["genus"] = counts.genus >= 0 ? py::object(py::int_(counts.genus)) : py::none();
  told["euler"] = counts.euler;
  return told;
}

py::dict quality_of(const Conversion& made) {
  py::dict told;
  const ImageQuality& quality = made.quality;
  told["mates_bit_equal"] = quality.mates_bit_equal;
  told["euler"] = quality.euler;
  told["boundaries"] = quality.boundaries;
  told["psnr_db"] = quality.psnr_db;
  told["hausdorff_percent"] = quality.hausdorff_percent;
  told["area_ratio"] = quality.area_ratio;
  told["reversed_area"] = quality.reversed_area;
  return told;
}

py::dict map_of(const Conversion& made) {
  py::dict told;
  told["parameterizer"] = made.parameterizer;
  told["flipped"] = made.map_quality.flipped;
  told["degenerate"] = made.map_quality.degenerate;
  told["stretch_l2"] = made.map_quality.stretch_l2;
  told["stretch_linf"] = made.map_quality.stretch_linf;
  return told;
}

/// What a conversion tells besides its image; `quality` where it was measured.
py::dict report_of(const Conversion& made, bool measured) {
  py::dict told;
  py::dict input = counts_of(made.input.counts);
  input["repairs"] = made.input.repairs;
  told["input"] = input;
  told["map"] = map_of(made);
  if (measured) told["quality"] = quality_of(made);
  told["warnings"] = made.warnings;
  told["seconds"] = made.seconds.total;
  return told;
}

template <class Value>
void take(const py::dict& options, const char* key, Value& value) {
  if (options.contains(key)) value = options[key].cast<Value>();
}

Seam seam_of(const std::vector<std::vector<int>>& paths) {
  Seam seam{"cut", {}};
  for (const std::vector<int>& path : paths)
    seam.paths.push_back({static_cast<int>(seam.paths.size()) + 1, path});
  return seam;
}

ConvertOptions options_of(const py::dict& given) {
  ConvertOptions options;
  take(given, "size", options.size);
  take(given, "normal_map", options.normal_map_size);
  take(given, "seed_triangle", options.seed_triangle);
  take(given, "fit", options.fit_samples);
  take(given, "measure", options.measure);
  take(given, "seed", options.seed);
  take(given, "threads", options.threads);
  if (given.contains("charts")) {
    const int charts = given["charts"].cast<int>();  // > 0: regions; else a ChartChoice
    options.charts = charts > 0 ? ChartChoice::regions : static_cast<ChartChoice>(-charts);
    if (charts > 0) options.max_charts = charts;
  }
  if (given.contains("parameterizer") && given["parameterizer"].cast<std::string>() == "floater")
    options.parameterizer = FloaterOptions{};
  if (given.contains("component")) {
    const int index = given["component"].cast<int>();
    options.component = {index < 0 ? ComponentChoice::Kind::largest : ComponentChoice::Kind::index,
                         index < 0 ? 0 : index};
  }
  if (given.contains("cut"))
    options.seam = seam_of(given["cut"].cast<std::vector<std::vector<int>>>());
  return options;
}

/// (image, what is told of it, normals (N, N, 3) or None)
py::tuple convert(const Doubles& vertices, const Ints& faces, const std::optional<Floats>& uv,
                  const std::string& name, const py::dict& given, const py::object& progress) {
  auto mesh = std::make_shared<TriangleMesh>(mesh_of(vertices, faces));
  if (uv) set_texture(*mesh, *uv);
  const ConvertOptions options = options_of(given);
  const auto made = std::make_shared<std::optional<Conversion>>();
  run_released(progress, [mesh, name, options, made](Progress& told) {
    ConvertOptions with_progress = options;
    with_progress.progress = &told;
    *made = convert_mesh(*mesh, name, with_progress);
  });
  Conversion& conversion = **made;
  const py::dict report = report_of(conversion, options.measure);
  py::object normals = py::none();
  if (conversion.normals) {
    const py::ssize_t n = conversion.normals->size();
    normals = array_of<float>(samples_of(conversion.normals->normal), {n, n, 3});
  }
  return py::make_tuple(Image{std::make_shared<const GeometryImage>(std::move(conversion.image))},
                        report, normals);
}

Image built_in(const std::string& name, int size, int threads, const py::object& progress) {
  const auto loaded = std::make_shared<std::optional<LoadedSurface>>();
  run_released(progress, [name, size, threads, loaded](Progress& told) {
    ConvertOptions options;
    options.size = size;
    options.threads = threads;
    options.progress = &told;
    *loaded = load_surface("builtin:" + name, options);
  });
  return {std::make_shared<const GeometryImage>(std::move((**loaded).image))};
}

Image read_picture(const std::string& path) {
  return {
      made_released([path] { return std::make_shared<const GeometryImage>(read_image(path)); })};
}

py::list charts_of(const Image& self) {
  py::list charts;
  const std::vector<Chart>& all = self.image->mates.charts();
  for (const Chart& chart : all)
    charts.append(py::make_tuple(chart.name, chart.row, chart.col, chart.rows, chart.cols));
  if (all.empty()) charts.append(py::make_tuple("", 0, 0, self.image->size(), self.image->size()));
  return charts;
}

/// World positions of all samples, as those of the rebuilt mesh. (n, n, 3) [m]
py::array_t<double> positions_of(const Image& self) {
  const int n = self.image->size();
  std::vector<Vec3d> positions;
  positions.reserve(static_cast<std::size_t>(n) * n);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) positions.push_back(self.image->world_position(row, col));
  return array_of<double>(std::move(positions), {n, n, 3});
}

/// The representative of every sample's class of mates; -1 for holes. (n, n)
py::array_t<std::int32_t> classes_of(const Image& self) {
  const int n = self.image->size();
  const BorderMates& mates = self.image->mates;
  std::vector<std::int32_t> classes;
  classes.reserve(static_cast<std::size_t>(n) * n);
  for (int sample = 0; sample < n * n; ++sample)
    classes.push_back(mates.is_hole(sample) ? -1 : mates.representative(sample));
  return array_of<std::int32_t>(std::move(classes), {n, n});
}

/// @return the rebuilt mesh of a level, and the samples a side of its image
std::pair<RebuiltMesh, int> rebuild_level(const GeometryImage& image, int level) {
  const std::optional<GeometryImage> coarse = coarser_image(image, level);
  if (!coarse)
    throw UsageError("level", std::to_string(level),
                     "a level from 0 to " + std::to_string(coarsest_level(image)) + " is wanted");
  return {rebuild_mesh(*coarse), coarse->size()};
}

/// (V, F, the vertex of every sample (n, n), the sample of every vertex)
py::tuple rebuilt_of(const Image& self, int level) {
  auto [rebuilt, n] =
      made_released([image = self.image, level] { return rebuild_level(*image, level); });
  const py::tuple arrays = arrays_of(std::move(rebuilt.mesh));
  const auto vertices = static_cast<py::ssize_t>(rebuilt.sample_of.size());
  return py::make_tuple(arrays[0], arrays[1],
                        array_of<std::int32_t>(std::move(rebuilt.vertex_of), {n, n}),
                        array_of<std::int32_t>(std::move(rebuilt.sample_of), {vertices}));
}

void save(const Image& self, const std::string& path) {
  const Released released;
  write_image(path, *self.image);
}

py::bytes exr_of(const Image& self) {
  std::string bytes;
  {
    const Released released;
    bytes = exr_bytes(*self.image);
  }
  return bytes;
}

Image from_exr(const std::string& bytes) {
  const Released released;
  return {std::make_shared<const GeometryImage>(parse_image(bytes, "image"))};
}

py::list shapes() {
  py::list named;
  for (const ShapeInfo& shape : built_in_shapes())
    named.append(py::make_tuple(std::string(shape.name), std::string(shape.description)));
  return named;
}

}  // namespace

void add_images(py::module_& module) {
  module.def("read_mesh", &read);
  module.def("write_mesh", &write);
  module.def("convert", &convert);
  module.def("builtin", &built_in);
  module.def("read_image", &read_picture);
  module.def("image_from_exr", &from_exr);
  module.def("shapes", &shapes);
  module.attr("min_image_size") = min_image_size;
  module.attr("largest_image_size") = largest_image_size;
  module.attr("largest_chart_count") = largest_chart_count;
  py::class_<Image>(module, "Image")
      .def_property_readonly("size", [](const Image& self) { return self.image->size(); })
      .def_property_readonly("source", [](const Image& self) { return self.image->source; })
      .def_property_readonly("source_hash",
                             [](const Image& self) { return self.image->source_hash; })
      .def_property_readonly(
          "coarsest_level",
          [](const Image& self) {
            return made_released([image = self.image] { return coarsest_level(*image); });
          })
      .def("charts", &charts_of)
      .def("positions", &positions_of)
      .def("classes", &classes_of)
      .def("rebuild", &rebuilt_of)
      .def("save", &save)
      .def("exr", &exr_of);
}

}  // namespace weft::python
