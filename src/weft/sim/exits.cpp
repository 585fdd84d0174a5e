#include "weft/sim/exits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/collide/contacts/body_query.h"
#include "weft/image/diagonals.h"

namespace weft {
namespace {

/// A distance that tears, in rest lengths and as a part of the cloth's length; and the length of a
/// tear as a part of that.
constexpr double torn_in_rest_lengths = 8, torn_part = 0.1, cut_part = 0.05;

struct Cut {
  double length = 0, apart = 0;  // of all that tears, and the largest distance [m]
};

/// Where samples inside a body leave it; the others stay. [n * n]
std::vector<Vec3d> exits_of(const SimulatedCloth& cloth, const PlacedBody& body,
                            const std::vector<char>& inside, ThreadTeam& team) {
  const SurfaceGrid grid(body.positions.size(), body.image.mates, choose_diagonals(body.image));
  BodyQuery query(grid);
  query.place(body.positions, team);
  std::vector<Vec3d> exits(inside.size());
  team.run([&](Worker& worker) {
    const Range mine = worker.share(static_cast<int>(inside.size()));
    for (int s = mine.first; s < mine.last; ++s) {
      exits[s] = vec_cast<double>(cloth.state.position.at(s));
      if (inside[s] == 0) continue;
      if (const auto found = query.closest(exits[s], HUGE_VAL)) exits[s] = found->position;
    }
  });
  return exits;
}

/// Adds the springs of one direction whose ends are inside and leave far apart.
void add_cut(const SpringPlane& springs, const std::vector<char>& inside,
             const std::vector<Vec3d>& exits, double length_of_cloth, Cut& cut) {
  const int n = springs.rest_length.rows();
  for (int r = 0; r + springs.down < n; ++r)
    for (int c = 0; c + springs.right < n; ++c) {
      const int here = r * n + c, there = here + springs.down * n + springs.right;
      if (inside[here] == 0 || inside[there] == 0 || !(springs.stiffness(r, c) > 0)) continue;
      const double rest = springs.rest_length(r, c), apart = length(exits[here] - exits[there]);
      if (apart <= std::max(torn_in_rest_lengths * rest, torn_part * length_of_cloth)) continue;
      cut.length += rest;
      cut.apart = std::max(cut.apart, apart);
    }
}

double length_of(const Cloth& cloth) {
  double mass = 0;
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) mass += cloth.owner(r, c) * cloth.mass(r, c);
  return std::sqrt(mass / cloth.material.density);
}

}  // namespace

std::optional<TornExit> find_torn_exit(const SimulatedCloth& cloth,
                                       std::span<const PlacedBody> bodies,
                                       std::span<const int> wrong_side, ThreadTeam& team) {
  const double size = length_of(*cloth.model);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<char> inside(wrong_side.size());
    for (std::size_t s = 0; s < inside.size(); ++s)
      inside[s] = wrong_side[s] == static_cast<int>(b) + 1 ? 1 : 0;
    if (std::find(inside.begin(), inside.end(), 1) == inside.end()) continue;
    const std::vector<Vec3d> exits = exits_of(cloth, bodies[b], inside, team);
    Cut cut;
    for (const int direction : {stretch_u, stretch_v})
      add_cut(cloth.model->springs[direction], inside, exits, size, cut);
    if (cut.length > cut_part * size) return TornExit{b, cut.apart};
  }
  return std::nullopt;
}

}  // namespace weft
