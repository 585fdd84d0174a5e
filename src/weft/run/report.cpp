#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/core/math.h"
#include "weft/run.h"

namespace weft {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// The smallest value that a share of all values does not exceed; 0 of none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

template <class Field>
std::vector<double> column(const RunReport& report, Field FrameReport::*field) {
  std::vector<double> values;
  for (const FrameReport& frame : report.history) values.push_back(frame.*field);
  return values;
}

OrderedJson milliseconds(const RunReport& report) {
  const auto median = [&](double FrameReport::*field) {
    return quantile(column(report, field), 0.5);
  };
  return {{"median", median(&FrameReport::milliseconds)},
          {"p95", quantile(column(report, &FrameReport::milliseconds), 0.95)},
          {"forces", median(&FrameReport::forces_ms)},
          {"solve", median(&FrameReport::solve_ms)},
          {"collide", median(&FrameReport::collide_ms)},
          {"limit", median(&FrameReport::limit_ms)}};
}

OrderedJson kinds_json(const IntersectionCounts& counts) {
  return {{"self", counts.self},
          {"cloths", counts.cloths},
          {"bodies", counts.bodies},
          {"ground", counts.ground}};
}

OrderedJson found_json(const FrameIntersections& found) {
  OrderedJson json{{"frame", found.frame}};
  json.update(kinds_json(found.counts));
  return json;
}

/// Strain of the frame with the largest strain; nothing where no frame was simulated.
OrderedJson worst_strain(const RunReport& report) {
  const auto worst = std::max_element(
      report.history.begin(), report.history.end(),
      [](const FrameReport& a, const FrameReport& b) { return a.strain.max < b.strain.max; });
  if (worst == report.history.end()) return {};
  return {{"frame", worst - report.history.begin() + 1},
          {"p99", worst->strain.p99},
          {"max", worst->strain.max}};
}

/// The largest count of a frame, and which frame that was; 0 and null where none was.
OrderedJson worst_count(const RunReport& report, int FrameReport::*count) {
  const auto worst = std::max_element(
      report.history.begin(), report.history.end(),
      [&](const FrameReport& a, const FrameReport& b) { return a.*count < b.*count; });
  if (worst == report.history.end() || (*worst).*count == 0)
    return {{"count", 0}, {"frame", nullptr}};
  return {{"count", (*worst).*count}, {"frame", worst - report.history.begin() + 1}};
}

/// Time by which cloth lagged behind in all frames together. [s]
double lost_time(const RunReport& report) {
  double sum = 0;
  for (const FrameReport& frame : report.history) sum += frame.lost_time;
  return sum;
}

/// The part of all points that the filter held back in a frame.
double blocked_share(const FrameReport& frame, int particles) {
  return particles > 0 ? static_cast<double>(frame.stopped) / particles : 0;
}

/// The largest blocked share of any frame.
double worst_blocked_share(const RunReport& report) {
  double worst = 0;
  for (const FrameReport& frame : report.history)
    worst = std::max(worst, blocked_share(frame, report.particles));
  return worst;
}

OrderedJson thickness_json(const RunReport& report) {
  OrderedJson json = OrderedJson::object();
  for (const auto& [name, thickness] : report.thickness_used) json[name] = thickness;
  return json;
}

OrderedJson start_insides_json(const RunReport& report) {
  OrderedJson json = OrderedJson::array();
  for (const StartInside& found : report.start_insides)
    json.push_back({{"cloth", found.cloth},
                    {"body", found.body},
                    {"samples", found.samples},
                    {"particles", found.particles},
                    {"kept_in", found.kept_in}});
  return json;
}

OrderedJson verification_json(const RunReport& report) {
  if (!report.verification) return {};
  const auto worst = [](const WorstCount& found) {
    return OrderedJson{{"count", found.count},
                       {"frame", found.count > 0 ? OrderedJson(found.frame) : OrderedJson()}};
  };
  return {{"passed", worst(report.verification->passed)},
          {"swallowed", worst(report.verification->swallowed)},
          {"written", worst(report.verification->written)}};
}

OrderedJson seams_json(const SeamsReport& seams) {
  OrderedJson open = OrderedJson::array();
  for (const OpenSeam& seam : seams.open)
    open.push_back({{"cloth", seam.cloth}, {"seam", seam.name}, {"gap_mm", 1000 * seam.gap}});
  OrderedJson tight = OrderedJson::array();
  for (const TightSeam& seam : seams.tight)
    tight.push_back(
        {{"cloth", seam.cloth}, {"seam", seam.name}, {"stretch_percent", 100 * seam.stretch}});
  return {{"count", seams.count},
          {"closed", seams.closed},
          {"largest_gap_mm", 1000 * seams.largest_gap},
          {"frames", seams.frames ? OrderedJson(*seams.frames) : OrderedJson()},
          {"open", open},
          {"tight", tight}};
}

}  // namespace

double energy_gained(const RunReport& report) {
  double min = report.start_energy, work = 0, gained = 0;
  for (const FrameReport& frame : report.history) {
    work += frame.work;
    const double energy = frame.kinetic_energy + frame.potential_energy - work;
    min = std::min(min, energy);
    gained = std::max(gained, energy - min);
  }
  return gained;
}

double relative_energy_gained(const RunReport& report) {
  constexpr double usual_height = 1;  // [m]
  const double weight = report.mass * standard_gravity;
  return weight > 0 ? energy_gained(report) / (weight * usual_height) : 0;
}

std::string to_json(const RunReport& report) {
  const std::vector<double> residuals = column(report, &FrameReport::residual);
  OrderedJson json{
      {"frames", report.frames},
      {"particles", report.particles},
      {"integrator", report.integrator},
      {"threads", report.threads},
      {"time_step", report.time_step},
      {"substeps", report.substeps},
      {"ms_per_frame", milliseconds(report)},
      {"strain",
       {{"mean", report.strain.mean}, {"p99", report.strain.p99}, {"max", report.strain.max}}},
      {"strain_worst", worst_strain(report)},
      {"residual", {{"median", quantile(residuals, 0.5)}, {"max", quantile(residuals, 1)}}},
      {"contacts_max", report.contacts_max},
      {"self_contacts_max", report.self_contacts_max},
      {"stopped", worst_count(report, &FrameReport::stopped)},
      {"fell_back", worst_count(report, &FrameReport::fell_back)},
      {"blocked_share", worst_blocked_share(report)},
      {"lost_time", lost_time(report)},
      {"buried", worst_count(report, &FrameReport::buried)},
      {"energy_gained", energy_gained(report)},
      {"energy_gained_mgl", relative_energy_gained(report)},
      {"thickness_used", thickness_json(report)},
      {"intersections", report.intersections.counts.total()}};
  json["centre_of_mass"] = OrderedJson::array();
  for (const Vec3d& c : report.centre_of_mass) json["centre_of_mass"].push_back({c.x, c.y, c.z});
  json["state_hash"] = report.state_hash;
  if (report.seams) {
    json["seams"] = seams_json(*report.seams);
    json["fell_off"] = report.fell_off;
  }
  json["intersections_found"] = found_json(report.intersections);
  json["start_intersections"] = kinds_json(report.start_intersections);
  json["verification"] = verification_json(report);
  json["start_insides"] = start_insides_json(report);
  json["untangled_frame"] =
      report.untangled_frame ? OrderedJson(*report.untangled_frame) : OrderedJson();
  json["estimated_memory_mb"] = 1e-6 * static_cast<double>(report.estimated_memory);
  json["outputs"] = OrderedJson::array();
  for (const auto& path : report.outputs) json["outputs"].push_back(path.string());
  return json_text(json);
}

std::string frames_csv_header() {
  return "frame,ms,forces_ms,solve_ms,collide_ms,limit_ms,iterations,residual,strain_mean,strain_"
         "p99,strain_max,"
         "kinetic_energy,potential_energy,contacts,stopped,fell_back,blocked_share,lost_time,work,"
         "smallest_gap,seam_gap,com_x,com_y,com_z,buried\n";
}

std::string frames_csv_line(int frame, const FrameReport& f, int particles) {
  // No gap is known when nothing is near: the field stays empty.
  const std::string gap =
      std::isfinite(f.smallest_gap) ? fmt::format("{:.6g}", f.smallest_gap) : "";
  return fmt::format(
             "{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{:.4g},{:.6g},{:.6g},{:.6g},{:.9g},{:.9g},{}"
             ",{},{},{:.4g},{:.6g},{:.6g},{},",
             frame, f.milliseconds, f.forces_ms, f.solve_ms, f.collide_ms, f.limit_ms, f.iterations,
             f.residual, f.strain.mean, f.strain.p99, f.strain.max, f.kinetic_energy,
             f.potential_energy, f.contacts, f.stopped, f.fell_back, blocked_share(f, particles),
             f.lost_time, f.work, gap) +
         fmt::format("{:.6g},{:.9g},{:.9g},{:.9g},{}\n", f.seam_gap, f.centre_of_mass.x,
                     f.centre_of_mass.y, f.centre_of_mass.z, f.buried);
}

}  // namespace weft
