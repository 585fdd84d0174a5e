#include "weft/convert/more_charts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "weft/convert/pieces.h"
#include "weft/core/stopwatch.h"
#include "weft/error.h"
#include "weft/param/square_map.h"

namespace weft {
namespace {

constexpr int max_trials = 2;
/// After a gain of enough_db, half the distance, no other trial follows.
constexpr double max_loss_db = 0.2, min_gain_db = 0.5, enough_db = 6;

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
/// @param spent  the trial's seconds are added; those of one that leads to nothing went into cuts
std::optional<Conversion> attempt(const ConvertToCharts& convert, int charts, StageSeconds& spent) {
  const Stopwatch watch;
  try {
    if (std::optional<Conversion> made = convert(charts)) {
      add(spent, std::exchange(made->seconds, {}));
      return made;
    }
  } catch (const TopologyError&) {
    // As one that does not fit.
  }
  spent.cut += watch.seconds();
  return std::nullopt;
}

/// Puts those in front that are not there already: trials repeat what the first image was told.
void put_before(std::vector<std::string>& warnings, const std::vector<std::string>& earlier) {
  std::vector<std::string> all = earlier;
  for (std::string& warning : warnings)
    if (std::find(earlier.begin(), earlier.end(), warning) == earlier.end())
      all.push_back(std::move(warning));
  warnings = std::move(all);
}

bool is_better(const Conversion& made, const Conversion& best, double first_psnr) {
  const double psnr = made.quality.psnr_db;
  if (is_poor(made) == is_poor(best)) return psnr > best.quality.psnr_db + min_gain_db;
  return is_poor(best) && psnr >= first_psnr - max_loss_db;
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

MoreCharts more_charts_for(const Conversion& made) {
  // Charts of less than the first stretch stay whole; the second is what parts are to have.
  constexpr double stretched = 1.5, wanted = 4;
  constexpr int at_least = 8, at_most = 32, min_samples = 32 * 32;
  MoreCharts more;
  more.divisible.resize(made.input.mesh.triangles.size(), false);
  double needed = 0;
  int triangles = 0;
  for (const ConvertedChart& chart : made.charts) {
    const double stretch = chart.mapped->quality.stretch_l2;
    if (stretch <= stretched) continue;
    needed = std::min<double>(at_most, needed + stretch * stretch / (wanted * wanted));
    triangles += static_cast<int>(chart.piece->triangle.size());
    for (const int t : chart.piece->triangle) more.divisible[t] = true;
  }
  const int samples = made.image.size() * made.image.size();
  more.most = std::min({at_most, samples / min_samples - chart_count(made),
                        triangles / min_triangles_of_more_charts});
  more.first = std::min(more.most, std::max(at_least, static_cast<int>(std::ceil(needed))));
  return more;
}

Conversion with_more_charts(Conversion first, const MoreCharts& more,
                            const ConvertToCharts& convert) {
  const int least = chart_count(first);
  StageSeconds spent = std::exchange(first.seconds, {});
  const std::vector<std::string> warnings = first.warnings;
  const std::string why =
      fmt::format("in {} the image would be poor: {}", charts_text(least), folds_of(first));
  const double first_psnr = first.quality.psnr_db;
  Conversion best = std::move(first);
  int count = more.first;
  for (int trial = 0; trial < max_trials && count >= 2; ++trial) {
    std::optional<Conversion> made = attempt(convert, least + count, spent);
    const bool fits = made && chart_count(*made) > least;
    if (fits) {
      if (is_better(*made, best, first_psnr)) best = std::move(*made);
      if (!is_poor(best) && best.quality.psnr_db >= first_psnr + enough_db) break;
    }
    const int next = fits ? std::min(4 * count, more.most) : count / 4;
    if (next == count) break;
    count = next;
  }
  best.seconds = spent;
  if (const int taken = chart_count(best); taken != least) {
    put_before(best.warnings, warnings);
    best.warnings.push_back(fmt::format("{}; {} were taken", why, charts_text(taken)));
  }
  return best;
}

}  // namespace weft
