#include "weft/convert/more_charts.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"

namespace weft {
namespace {

/// How many times as many charts are tried at most.
constexpr int max_factor = 64;

int chart_count(const Conversion& made) { return static_cast<int>(made.charts.size()); }

std::string charts_text(int count) {
  return fmt::format("{} chart{}", count, count == 1 ? "" : "s");
}

void add(StageSeconds& to, const StageSeconds& more) {
  to.load += more.load;
  to.cut += more.cut;
  to.map += more.map;
  to.sample += more.sample;
  to.measure += more.measure;
}

/// Too many charts for a small mesh, say, do not prevent what was found already.
std::optional<Conversion> attempt(const ConvertToCharts& convert, int charts) {
  try {
    return convert(charts);
  } catch (const TopologyError&) {
    return std::nullopt;
  }
}

}  // namespace

bool is_poor(const Conversion& made) {
  constexpr double max_stretch = 5, max_area_ratio = 1.05, max_reversed = 0.02;
  return made.map_quality.stretch_l2 > max_stretch || made.quality.area_ratio > max_area_ratio ||
         made.quality.reversed_area > max_reversed;
}

std::string folds_of(const Conversion& made) {
  return fmt::format(
      "stretch {:.3g} (L2), {:.3g} times the mesh's area, {:.2g} % of it facing the wrong way",
      made.map_quality.stretch_l2, made.quality.area_ratio, 100 * made.quality.reversed_area);
}

Conversion with_more_charts(Conversion first, const ConvertToCharts& convert, const PsnrOf& psnr) {
  const int least = chart_count(first);
  const int most = std::min({max_factor * least, largest_chart_count,
                             static_cast<int>(first.input.mesh.triangles.size())});
  StageSeconds spent = std::exchange(first.seconds, {});
  const std::vector<std::string> warnings = first.warnings;
  const std::string why =
      fmt::format("in {} the image would be poor: {}", charts_text(least), folds_of(first));
  double best_psnr = psnr(first);
  Conversion best = std::move(first);
  for (int count = 2 * least; count <= most; count *= 2) {
    std::optional<Conversion> made = attempt(convert, count);
    if (!made || chart_count(*made) <= least) continue;
    add(spent, std::exchange(made->seconds, {}));
    const bool is_good = !is_poor(*made);
    const double made_psnr = is_good ? 0 : psnr(*made);
    if (!is_good && made_psnr <= best_psnr) continue;
    best_psnr = made_psnr;
    best = std::move(*made);
    if (is_good) break;
  }
  best.seconds = spent;
  if (const int taken = chart_count(best); taken != least) {
    best.warnings.insert(best.warnings.begin(), warnings.begin(), warnings.end());
    best.warnings.push_back(fmt::format("{}; {} were taken", why, charts_text(taken)));
  }
  return best;
}

}  // namespace weft
