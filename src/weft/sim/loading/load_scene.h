#pragma once

#include <optional>
#include <string>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"
#include "weft/scene.h"
#include "weft/sim/loading/insides.h"
#include "weft/sim/motion/attachments.h"
#include "weft/sim/motion/body_motion.h"
#include "weft/sim/motion/pins.h"
#include "weft/sim/sewing/gathers.h"
#include "weft/sim/sewing/sewing.h"
#include "weft/sim/sewing/worn_places.h"
#include "weft/simulation.h"

namespace weft {

/// What a simulation begins with: the cloths and bodies of a scene in their places, and what moves
/// them.
struct LoadedScene {
  std::vector<SimulatedCloth> cloths;
  std::vector<PlacedBody> bodies;
  DrivenBodies driven;
  std::vector<std::string> notes;
  std::vector<StartInside> insides;
  std::vector<StartSides> start_sides;              // of each cloth
  std::vector<std::vector<PinMotion>> pin_motions;  // of each cloth
  std::vector<std::vector<TiedPin>> tied_pins;      // of each cloth
  std::vector<std::optional<Sewing>> sewing;        // of each cloth; none: it is no garment
  std::vector<WornPlaces> worn_places;              // of each cloth; none but of garments
  /// Of each cloth, the bending that is not in use: of a garment that slides that of its fabric,
  /// later that of stiff panels; of other cloths none.
  std::vector<BendingPlanes> other_bending;
  std::vector<Gathers> gathers;  // of each cloth; none but of garments
};

/// Loads and places the surfaces of a scene, and ties cloths to bodies.
/// @param name  of the scene, for errors
/// @throws SceneError  for what its methods cannot simulate, and as load_surface
LoadedScene load_scene(const Scene& scene, const std::string& name, const SimulationHelp& help,
                       ThreadTeam& team);

}  // namespace weft
