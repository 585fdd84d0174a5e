#pragma once

#include <string>

#include "weft/scene.h"
#include "weft/simulation.h"

namespace weft::python {

/// Of what a simulation is made of: only states of its like fit to it. The same in every process.
/// @param json        the scene, which does not tell what is in memory
/// @param simulation  of it, at its start
std::string identity_of(const std::string& json, const Scene& scene, const Simulation& simulation);

}  // namespace weft::python
