#pragma once

#include <cstdint>
#include <vector>

#include "weft/material.h"

namespace weft::bench {

/// One sheet to be hung.
struct Trial {
  int size = 65, substeps = 4;
  Material material;
  int compared_frames = 30;  ///< against the tight solve
  int frames = 240;          ///< over which energy is watched
};

/// How far the integrator was off the tight solve in a trial.
struct Outcome {
  double centre = 0;        ///< largest distance of the centres of mass over compared frames [m]
  double rms = 0;           ///< of particles' distances over compared frames [m]
  double gained = 0;        ///< largest rise of the energy beyond its least so far [m g L]
  double iterations = 0;    ///< a step
  double milliseconds = 0;  ///< a frame
  double strain = 0, tight_strain = 0;  ///< largest over the compared frames
  /// Largest distance of the tight solve's centre of mass from its own, started elsewhere [m].
  double spread = 0;
  int unsolved = 0;  ///< tight steps that missed their tolerance
};

/// Prints a row for each fabric, and the worst of each measure.
void print_fabrics(const std::vector<Trial>& trials, const std::vector<Outcome>& outcomes);

/// Prints the median and the worst of each measure, and the trials that are among the worst.
/// @param seed  of the first material
void print_materials(const std::vector<Trial>& trials, const std::vector<Outcome>& outcomes,
                     std::uint64_t seed);

}  // namespace weft::bench
