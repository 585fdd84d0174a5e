#include "apps/weft/strain_colours.h"

#include <algorithm>
#include <cmath>

#include "apps/viewer/colouring.h"
#include "weft/error.h"

namespace weft::app {

StrainColours::StrainColours(const RunFolder& run) {
  for (const RecordedCloth& cloth : run.cloths) {
    if (cloth.rest.size() == 0)
      throw UsageError("--show", "strain of " + cloth.name + ", whose rest shape was not recorded",
                       "a run of this version is wanted");
    strains_.emplace_back(cloth);
  }
}

double StrainColours::most_of(const std::vector<Planes3>& cloths) const {
  constexpr double part = 0.99;
  double most = 0;
  for (std::size_t k = 0; k < cloths.size(); ++k) {
    const Grid<float> strains = strains_[k].at_samples(cloths[k]);
    const int n = strains.rows();
    std::vector<float> sizes(static_cast<std::size_t>(n) * n);
    for (int s = 0; s < n * n; ++s) {
      const float size = std::abs(strains(s / n, s % n));
      sizes[s] = std::isfinite(size) ? size : 0;  // of a damaged cache
    }
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(part * (sizes.size() - 1));
    std::nth_element(sizes.begin(), at, sizes.end());
    most = std::max<double>(most, *at);
  }
  return most;
}

Planes3 StrainColours::of(std::size_t cloth, const Planes3& positions) const {
  Planes3 colours;
  viewer::colour_strain(strains_[cloth].at_samples(positions), full_, colours);
  return colours;
}

Legend StrainColours::legend() const {
  return viewer::legend_of({viewer::ColourBy::strain}, full_);
}

double rounded_scale(double strain) {
  constexpr double least = 1e-4;
  if (!(strain > least)) return least;
  const double decade = std::pow(10, std::floor(std::log10(strain)));
  for (const double step : {1.0, 2.0, 5.0})
    if (strain <= step * decade) return step * decade;
  return 10 * decade;
}

}  // namespace weft::app
