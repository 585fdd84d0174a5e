#pragma once

#include <string>

#include "weft/run/run.h"

namespace weft {

/// A run as one JSON object, the contract of `simulate --json`.
std::string to_json(const RunReport& report);

/// The largest rise of kinetic plus potential energy above the least that it was before, less the
/// work of pins, moving bodies and wind in between. [J]
double energy_gained(const RunReport& report);

/// The columns of frames.csv, one line with its end.
std::string frames_csv_header();
/// One frame as a line of frames.csv.
/// @param particles  of all cloths
std::string frames_csv_line(int frame, const FrameReport& report, int particles);

}  // namespace weft
