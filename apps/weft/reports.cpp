#include "apps/weft/reports.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/geometry_image.h"
#include "weft/mesh_statistics.h"

namespace weft::app {

std::optional<double> peak_memory_mb() {
  constexpr double mb_of_kib = 1024e-6;
  std::ifstream status("/proc/self/status");
  std::string arg;
  while (status >> arg) {
    double kib = 0;
    if (arg == "VmHWM:" && status >> kib) return kib * mb_of_kib;
  }
  return std::nullopt;
}
namespace {

Json seconds_json(const StageSeconds& s) {
  return {{"load", s.load},     {"cut", s.cut},         {"map", s.map},
          {"sample", s.sample}, {"measure", s.measure}, {"total", s.total}};
}

Json vector_json(Vec3d p) { return {p.x, p.y, p.z}; }

Json map_json(const Conversion& conversion) {
  const MapQuality& q = conversion.map_quality;
  return {{"parameterizer", conversion.parameterizer},
          {"flipped", q.flipped},
          {"degenerate", q.degenerate},
          {"stretch_l2", q.stretch_l2},
          {"stretch_linf", q.stretch_linf},
          {"area_ratio", conversion.quality.area_ratio},
          {"reversed_area", conversion.quality.reversed_area}};
}

Json charts_json(const GeometryImage& image) {
  Json list = Json::array();
  for (const Chart& chart : image.mates.charts())
    list.push_back({{"name", chart.name},
                    {"rows", chart.rows},
                    {"cols", chart.cols},
                    {"row", chart.row},
                    {"col", chart.col}});
  return list;
}

}  // namespace

Json genus_json(const TopologyCounts& counts) {
  return counts.genus >= 0 ? Json(counts.genus) : Json(nullptr);
}

Json box_json(const Box3d& box) {
  if (box.empty()) return nullptr;
  return {{"lower", vector_json(box.lower)}, {"upper", vector_json(box.upper)}};
}

Json paths_json(const std::vector<std::filesystem::path>& paths) {
  Json list = Json::array();
  for (const auto& path : paths) list.push_back(path.string());
  return list;
}

std::string genus_text(const Json& genus) {
  return genus.is_null() ? "no genus" : "genus " + std::to_string(genus.get<int>());
}

Json input_json(const std::string& path, const RepairedMesh& input) {
  const TopologyCounts& c = input.counts;
  return {{"path", path},
          {"vertices", c.vertices},
          {"triangles", c.triangles},
          {"components", input.components_found},
          {"boundaries", c.boundaries},
          {"genus", genus_json(c)},
          {"euler", c.euler},
          {"repairs", input.repairs}};
}

Json conversion_json(const std::string& path, const Conversion& conversion,
                     const std::vector<std::filesystem::path>& outputs) {
  const ImageQuality& q = conversion.quality;
  const std::optional<double> memory = peak_memory_mb();
  return {{"input", input_json(path, conversion.input)},
          {"cut",
           {{"paths", conversion.cut.paths},
            {"nodes", conversion.cut.nodes},
            {"length", conversion.cut.length},
            {"rounds", conversion.rounds}}},
          {"charts", charts_json(conversion.image)},
          {"map", map_json(conversion)},
          {"image",
           {{"size", conversion.image.size()},
            {"mates_bit_equal", q.mates_bit_equal},
            {"euler", q.euler},
            {"boundaries", q.boundaries},
            {"psnr_db", q.psnr_db},
            {"hausdorff_percent", q.hausdorff_percent},
            {"coarsest_level", coarsest_level(conversion.image)}}},
          {"seconds", seconds_json(conversion.seconds)},
          {"peak_memory_mb", memory ? Json(*memory) : Json()},
          {"warnings", conversion.warnings},
          {"outputs", paths_json(outputs)}};
}

Json image_json(const GeometryImage& image) {
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  const auto vertices = static_cast<int>(rebuilt.mesh.positions.size());
  const TopologyCounts counts = image.mates.keep_manifold()
                                    ? count_topology(vertices, rebuilt.mesh.triangles)
                                    : count_complex(vertices, rebuilt.mesh.triangles);
  return {{"size", image.size()},
          {"charts", charts_json(image)},
          {"source", image.source},
          {"source_hash", image.source_hash},
          {"mates_bit_equal", mates_bit_equal(image)},
          {"coarsest_level", coarsest_level(image)},
          {"mate_classes", image.mates.class_count()},
          {"vertices", counts.vertices},
          {"triangles", counts.triangles},
          {"euler", counts.euler},
          {"boundaries", counts.boundaries},
          {"genus", genus_json(counts)}};
}

void check_output(const std::filesystem::path& path,
                  std::initializer_list<std::string_view> endings) {
  if (std::find(endings.begin(), endings.end(), ending_of(path)) == endings.end()) {
    std::string wanted;
    for (const std::string_view ending : endings)
      wanted.append(wanted.empty() ? "" : " or ").append(ending);
    throw UsageError(path.string(), "has no ending that can be written here",
                     wanted + " is wanted");
  }
  const NewFile probe(path);
}

}  // namespace weft::app
