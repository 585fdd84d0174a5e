#include "weft/sim/sewing/rolled_panels.h"

#include <algorithm>
#include <array>
#include <optional>

#include "weft/sim/sewing/panels_in_bodies.h"
#include "weft/sim/sewing/tube_panel.h"

namespace weft {
namespace {

/// How much of a circle tubes take: the first that does.
constexpr std::array parts_of_circle{0.9, 0.8, 0.7, 0.6, 0.5};
/// Tubes are moved in steps of this length, up to so many, to get round a body. [m]
constexpr double step_aside = 0.02;
constexpr int max_moves_out = 15, max_moves_across = 5;

/// The ways that tubes are moved, the shortest first.
std::vector<Tube> moves(double part) {
  std::vector<Tube> moves;
  for (int i = -max_moves_out; i <= max_moves_out; ++i)
    for (int k = -max_moves_across; k <= max_moves_across; ++k)
      moves.push_back({part, step_aside * i, step_aside * k});
  std::stable_sort(moves.begin(), moves.end(), [](const Tube& a, const Tube& b) {
    return a.out * a.out + a.across * a.across < b.out * b.out + b.across * b.across;
  });
  return moves;
}

/// A panel that is to be rolled up, among bodies.
struct Rolling {
  const TubePanel& panel;
  int number;
  const PanelsInBodies& bodies;

  /// All panels, this one as a tube, if that is free of bodies.
  [[nodiscard]] std::optional<Planes3> at(Tube tube) const {
    if (!panel.has_gap(tube)) return std::nullopt;
    tube.turn = panel.best_turn(tube);
    Planes3 rolled = panel.rolled(tube);
    if (!bodies.is_free(number, rolled)) return std::nullopt;
    return rolled;
  }
  /// Whether a body is in the tube, along half of it at least.
  [[nodiscard]] bool is_worn(const Tube& tube) const {
    const std::vector<Vec3d> axis = panel.axis(tube);
    const auto held =
        std::count_if(axis.begin(), axis.end(), [&](Vec3d p) { return bodies.hold(p); });
    return 2 * held >= static_cast<std::ptrdiff_t>(axis.size());
  }
  /// Round a body, or else where the panel is.
  [[nodiscard]] std::optional<Planes3> find() const {
    for (const double part : parts_of_circle)
      for (const Tube& tube : moves(part)) {
        if (!is_worn(tube)) continue;
        if (std::optional<Planes3> rolled = at(tube)) return rolled;
      }
    return at({parts_of_circle.front()});
  }
};

}  // namespace

std::vector<char> roll_up_panels(const Garment& garment, std::span<const PlacedBody> bodies,
                                 Planes3& placed) {
  std::optional<PanelsInBodies> in_bodies;
  std::vector<char> rolled(garment.panel_holds.size());
  for (std::size_t i = 0; i < rolled.size(); ++i) {
    const auto number = static_cast<int>(i);
    const TubePanel panel(garment, number, placed);
    if (!panel.is_tube()) continue;
    if (!in_bodies) in_bodies.emplace(garment.image, bodies, placed);
    std::optional<Planes3> found = Rolling{panel, number, *in_bodies}.find();
    if (!found) continue;
    placed = std::move(*found);
    rolled[i] = 1;
  }
  return rolled;
}

}  // namespace weft
