#include "weft/sim/loading/exits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/collide/contacts/body_query.h"
#include "weft/core/disjoint_sets.h"
#include "weft/image/diagonals.h"

namespace weft {
namespace {

/// A distance that tears, in rest lengths and as a part of the cloth's length; and the length of a
/// tear as a part of that.
constexpr double torn_in_rest_lengths = 8, torn_part = 0.1, cut_part = 0.05;

/// The same for a hole that a body makes in a cloth: in rest lengths, and over the hole's width.
constexpr double pierced_in_rest_lengths = 4, pierced_part = 0.5;

struct Cut {
  double length = 0, apart = 0;  // of all that tears, and the largest distance [m]
};

/// A connected part of a cloth that is inside a body.
struct Region {
  double area = 0;         // [m^2]
  double apart = 0;        // largest distance at which neighbours leave [m]
  bool at_border = false;  // it may be pulled out sideways
};

/// The springs along threads whose ends are both inside: visit(sample, sample, rest length).
template <class Visit>
void each_inside(const Cloth& cloth, const std::vector<char>& inside, const Visit& visit) {
  for (const int direction : {stretch_u, stretch_v}) {
    const SpringPlane& springs = cloth.springs[direction];
    for (int r = 0; r + springs.down < cloth.size; ++r)
      for (int c = 0; c + springs.right < cloth.size; ++c) {
        const int here = r * cloth.size + c;
        const int there = here + springs.down * cloth.size + springs.right;
        if (inside[here] != 0 && inside[there] != 0 && springs.stiffness(r, c) > 0)
          visit(here, there, double{springs.rest_length(r, c)});
      }
  }
}

/// Marks the samples on the border of a cloth: on that of a chart, without mates. [n * n]
std::vector<char> border_of(const Cloth& cloth) {
  const int count = cloth.size * cloth.size;
  std::vector<int> copies(static_cast<std::size_t>(count), 0);
  for (int s = 0; s < count; ++s)
    if (!cloth.mates.is_hole(s)) ++copies[cloth.mates.representative(s)];
  std::vector<char> border(copies.size(), 0);
  for (int i = 0; i < cloth.mates.border_length(); ++i) {
    const int sample = cloth.mates.sample_at(i);
    if (copies[cloth.mates.representative(sample)] == 1) border[sample] = 1;
  }
  return border;
}

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

/// Everything along which a cloth would tear.
Cut cut_of(const Cloth& cloth, const std::vector<char>& inside, const std::vector<Vec3d>& exits,
           double length_of_cloth) {
  Cut cut;
  each_inside(cloth, inside, [&](int here, int there, double rest) {
    const double apart = length(exits[here] - exits[there]);
    if (apart <= std::max(torn_in_rest_lengths * rest, torn_part * length_of_cloth)) return;
    cut.length += rest;
    cut.apart = std::max(cut.apart, apart);
  });
  return cut;
}

/// The largest distance at which neighbours leave a body that passes through a hole in the cloth;
/// 0 where none does.
double pierced_by(const Cloth& cloth, const std::vector<char>& inside,
                  const std::vector<Vec3d>& exits) {
  const int count = cloth.size * cloth.size;
  DisjointSets sets(count);
  for (int s = 0; s < count; ++s) sets.join(s, cloth.mates.representative(s));
  each_inside(cloth, inside, [&](int here, int there, double) { sets.join(here, there); });
  const std::vector<char> border = border_of(cloth);
  std::vector<Region> regions(static_cast<std::size_t>(count));
  for (int s = 0; s < count; ++s) {
    if (inside[s] == 0) continue;
    Region& region = regions[sets.root(s)];
    const int row = s / cloth.size, col = s % cloth.size;
    region.area += cloth.owner(row, col) * cloth.mass(row, col) / cloth.material.density;
    region.at_border |= border[s] != 0;
  }
  each_inside(cloth, inside, [&](int here, int there, double rest) {
    const double apart = length(exits[here] - exits[there]);
    if (apart <= pierced_in_rest_lengths * rest) return;
    Region& region = regions[sets.root(here)];
    region.apart = std::max(region.apart, apart);
  });
  double widest = 0;
  for (const Region& region : regions)
    if (!region.at_border && region.apart > pierced_part * std::sqrt(region.area))
      widest = std::max(widest, region.apart);
  return widest;
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
    const Cut cut = cut_of(*cloth.model, inside, exits, size);
    if (cut.length > cut_part * size) return TornExit{b, cut.apart};
    if (const double apart = pierced_by(*cloth.model, inside, exits); apart > 0)
      return TornExit{b, apart};
  }
  return std::nullopt;
}

}  // namespace weft
