#include "weft/collide/contacts/pair_contacts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "weft/collide/contacts/closest.h"
#include "weft/collide/contacts/layer_features.h"

namespace weft {
namespace {

/// Stiffness of contacts between layers relative to the inertia of their points in a step. Hard
/// contacts of many layers, linearised anew each step, could hardly be satisfied together and
/// strained the cloth by several percent. The filter stops what these soft ones do not.
constexpr double softness = 100;
/// The part of the gap kept by edges of layers that lie flat on each other, which samples and
/// triangles hold apart as a rule, and by the two sides of a crease, which bending holds apart.
constexpr double worn = 0.5;
/// Distances along a cloth, in samples: up to crease_end two points lie on both sides of a crease,
/// where edges get no contact; from layer_start on they keep the whole gap. The gap grows in
/// between, so that no contact jumps where it goes on to another cell.
constexpr double crease_end = 2, layer_start = 3;
/// Cells no farther apart along the cloth than this many gaps get no contact: the cloth would have
/// to turn within half a gap to lie on itself, which bending prevents.
constexpr double beside_in_gaps = 3;

/// The half-space against one side: its offset and how it moves.
struct Plane {
  double offset;
  Vec3d surface_displacement;
};

/// Collects the contacts of one cell with those of a tile after the other.
class Finder {
 public:
  Finder(const ClothPair& pair, const CollideKernels& kernels, bool share, PairFound& out)
      : pair_(pair), kernels_(kernels), share_(share), out_(out) {}

  void find(const CandidateTile& found) {
    const SurfaceCell own(*pair_.grid_a, found.row_a, found.col_a);
    const CellCorners corners = pair_.tiles_a->cell(found.row_a, found.col_a);
    const TileCorners& tile = pair_.tiles_b->tile(pair_.tiles_b->tiling().tile_b(found));
    gather(own, corners, tile, found);
    if (count_ == 0) return;
    patches_ = {pair_.tiles_a->tiling().patch_a(found), pair_.tiles_b->tiling().patch_b(found)};
    const auto reach = static_cast<float>(contact_margin * pair_.gap);
    kernels_.tile_reaches(corners, tile, reach, static_cast<float>(worn) * reach, near_.data(),
                          near_edges_.data());
    for (int corner = 0; corner < 4; ++corner) {
      own_corner(own, corners, tile, corner);
      tile_corner(own, corners, tile, corner);
    }
    edges(own, corners, tile);
  }

 private:
  /// A cell of the tile that may come near.
  struct Other {
    SurfaceCell cell;
    int lane = 0;
    bool crease = false;  ///< whether both share a corner: they fold there alone
  };

  void gather(const SurfaceCell& own, const CellCorners& corners, const TileCorners& tile,
              const CandidateTile& found) {
    std::array<float, tile_cells> gaps;
    const auto reach = static_cast<float>(contact_margin * pair_.gap);
    kernels_.tile_gaps(corners, tile, reach, reach, gaps.data());
    count_ = 0;
    for_lanes(found.cells, [&](int lane) {
      if (!(gaps[lane] <= 0)) return;
      out_.near = true;
      const SurfaceCell cell(*pair_.grid_b, found.row_b + lane / Tiling::cols,
                             found.col_b + lane % Tiling::cols);
      const bool crease = pair_.same() && adjacent(own, cell);
      if (pair_.same() && (crease ? !pair_.creases : beside(own, cell))) return;
      others_[count_++] = {cell, lane, crease};
    });
  }

  static bool adjacent(const SurfaceCell& a, const SurfaceCell& b) {
    if (std::abs(a.row - b.row) <= 1 && std::abs(a.col - b.col) <= 1) return true;
    return a.features().at_seam && b.features().at_seam && a.shares_corner(b);
  }

  /// Whether the distance between two cells along a row and a column at rest is at most
  /// beside_in_gaps.
  [[nodiscard]] bool beside(const SurfaceCell& a, const SurfaceCell& b) const {
    if (pair_.rest == nullptr) return false;
    const double limit = beside_in_gaps * pair_.gap;
    const auto [row, last_row] = std::minmax(a.row, b.row);
    const auto [col, last_col] = std::minmax(a.col, b.col);
    double distance = 0;
    const auto step = [&](int r, int c, int to_r, int to_c) {
      distance += length(vec_cast<double>(pair_.rest->at(to_r, to_c) - pair_.rest->at(r, c)));
    };
    // Between the corners that face each other.
    for (int r = row + 1; r < last_row && distance <= limit; ++r)
      step(r, last_col, r + 1, last_col);
    for (int c = col + 1; c < last_col && distance <= limit; ++c) step(row + 1, c, row + 1, c + 1);
    return distance <= limit;
  }

  [[nodiscard]] const MovingCloth& cloth(bool b) const { return b ? *pair_.b : *pair_.a; }
  [[nodiscard]] const SurfaceGrid& grid(bool b) const { return b ? *pair_.grid_b : *pair_.grid_a; }
  /// How far beyond the edges of triangles samples have contacts with those. [m]
  [[nodiscard]] float beside_reach() const {
    return static_cast<float>(contact_margin * pair_.gap);
  }

  /// A corner of the cell with the tile's triangles.
  void own_corner(const SurfaceCell& own, const CellCorners& corners, const TileCorners& tile,
                  int corner) {
    if (!own.owns(corner)) return;
    kernels_.corner_over_tile(corners, corner, tile, near_.data(), beside_reach(), found_.data());
    for (int i = 0; i < count_; ++i)
      samples_with_triangles(own.sample(corner), others_[i].cell, others_[i], false);
  }

  /// That corner of the tile's cells with the cell's triangles.
  void tile_corner(const SurfaceCell& own, const CellCorners& corners, const TileCorners& tile,
                   int corner) {
    const auto owns = [&](const Other& other) { return other.cell.owns(corner); };
    if (std::none_of(others_.begin(), others_.begin() + count_, owns)) return;
    kernels_.tile_over_cell(corners, tile, corner, near_.data(), beside_reach(), found_.data());
    for (int i = 0; i < count_; ++i)
      if (owns(others_[i]))
        samples_with_triangles(others_[i].cell.sample(corner), own, others_[i], true);
  }

  /// @param swapped  whether the sample is of the second cloth
  void samples_with_triangles(int sample, const SurfaceCell& with, const Other& other,
                              bool swapped) {
    const int halves = found_[other.lane];
    gap_ = other.crease ? worn * pair_.gap : pair_.gap;
    for (int half = 0; half < 2; ++half)
      if ((halves >> half & 1) != 0) sample_with_triangle(sample, with, half, swapped);
  }

  void sample_with_triangle(int sample, const SurfaceCell& with, int half, bool swapped) {
    const std::array<int, 3> triangle = with.grid->triangle(with.cell, half);
    if (with.grid->folded(triangle) || (pair_.same() && shares_point(sample, triangle))) return;
    const std::array<double, 3> weights =
        closest_weights(vec_cast<double>(cloth(swapped).start.at(sample)),
                        corners_at(cloth(!swapped).start, triangle));
    const ContactSide own{&cloth(swapped), {sample, sample, sample}, {1, 0, 0}},
        other{&cloth(!swapped), triangle, weights};
    const bool inside = std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0; });
    if (inside || (!pair_.is_sewn() && meets_ridge(own, with, half, other, swapped)))
      add(own, other, swapped);
  }

  /// Whether a sample has a contact with an edge or a corner of a triangle.
  [[nodiscard]] bool meets_ridge(const ContactSide& own, const SurfaceCell& with, int half,
                                 const ContactSide& other, bool swapped) const {
    const std::array<int, 2> feature = other.feature();
    if (!with.gives(feature, half) || !is_ridge(other, !swapped, own)) return false;
    // Two vertices may be found both ways.
    return feature[0] != feature[1] || !swapped || !is_ridge(own, swapped, other);
  }

  /// Whether a point lies beyond a ridge of the cloth, to which nothing around is closer. The
  /// direction to it may lie along the cloth, where a push would strain it: that is left to the
  /// filter.
  /// @param b  whether the ridge is of the second cloth
  [[nodiscard]] bool is_ridge(const ContactSide& ridge, bool b, const ContactSide& of) const {
    const FeatureRing ring(grid(b), ridge.cloth->start, ridge.feature());
    const Vec3d point = of.start();
    return ring.faces(point - ridge.start()) && ring.is_closest_to(point);
  }

  [[nodiscard]] bool shares_point(int sample, const std::array<int, 3>& triangle) const {
    const SurfaceGrid& grid = *pair_.grid_a;
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](int corner) { return grid.joint(corner) == grid.joint(sample); });
  }

  void edges(const SurfaceCell& own, const CellCorners& corners, const TileCorners& tile) {
    kernels_.tile_edges(corners, tile, near_edges_.data(), found_.data());
    for (int i = 0; i < count_; ++i) {
      const Other& other = others_[i];
      if (other.crease) continue;
      gap_ = near_edges_[other.lane] < near_[other.lane] ? worn * pair_.gap : pair_.gap;
      for (auto left = static_cast<unsigned>(found_[other.lane]); left != 0; left &= left - 1) {
        const int pair = std::countr_zero(left);
        add_edges(own, pair / 3, other.cell, pair % 3);
      }
      last_edges(own, other.cell);
    }
  }

  /// Pairs of edges that have one at the last row or column of a chart.
  void last_edges(const SurfaceCell& a, const SurfaceCell& b) {
    constexpr int last = CellFeatures::last_edges;
    if ((a.features().own_edges | b.features().own_edges) >> last == 0) return;
    for (int p = 0; p < CellFeatures::edges; ++p)
      for (int q = p < last ? last : 0; q < CellFeatures::edges; ++q) add_edges(a, p, b, q);
  }

  void add_edges(const SurfaceCell& a, int p, const SurfaceCell& b, int q) {
    const bool own =
        (a.features().own_edges >> p & 1) != 0 && (b.features().own_edges >> q & 1) != 0;
    if (own) add_edges(a.edge(p), b.edge(q));
  }

  void add_edges(const std::array<int, 2>& p, const std::array<int, 2>& q) {
    if (pair_.same() &&
        (shares_point(p[0], {q[0], q[1], q[1]}) || shares_point(p[1], {q[0], q[1], q[1]})))
      return;
    Feature a, b;
    a.count = b.count = 2;
    for (std::size_t k = 0; k < 2; ++k) {
      a.corners[k] = vec_cast<double>(pair_.a->start.at(p[k]));
      b.corners[k] = vec_cast<double>(pair_.b->start.at(q[k]));
    }
    const ClosestPair closest = closest_points(a, b);
    const auto inner = [](const std::array<double, 3>& w) { return w[0] > 0 && w[1] > 0; };
    if (!inner(closest.weights_a) || !inner(closest.weights_b)) return;
    const ContactSide own{
        pair_.a, {p[0], p[1], p[1]}, {closest.weights_a[0], closest.weights_a[1], 0}};
    const ContactSide other{
        pair_.b, {q[0], q[1], q[1]}, {closest.weights_b[0], closest.weights_b[1], 0}};
    if (!pair_.same() || pair_.is_sewn() ||
        samples_between(*pair_.grid_a, own, other) >= crease_end)
      add(own, other, false);
  }

  /// Between layers that have come through each other a contact would push the wrong way.
  [[nodiscard]] bool misled(const ContactSide& own, const ContactSide& other, bool swapped) const {
    if (pair_.tangle == nullptr) return false;
    const ContactSide &a = swapped ? other : own, &b = swapped ? own : other;
    return TangleMarks::misled(pair_.tangle->of(0, *pair_.grid_a, a.samples),
                               pair_.tangle->of(1, *pair_.grid_b, b.samples));
  }

  [[nodiscard]] double gap_between(const ContactSide& own, const ContactSide& other) const {
    if (!pair_.same() || pair_.is_sewn()) return gap_;
    const double part =
        (samples_between(*pair_.grid_a, own, other) - crease_end) / (layer_start - crease_end);
    return std::min(gap_, pair_.gap * std::clamp(worn + (1 - worn) * part, worn, 1.0));
  }

  void add(const ContactSide& own, const ContactSide& other, bool swapped) {
    if (misled(own, other, swapped)) return;
    const Vec3d apart = own.start() - other.start();
    const double distance = length(apart), gap = gap_between(own, other);
    if (!(distance > 0)) return;
    const Vec3d normal = (1 / distance) * apart;
    const Vec3d own_displacement = own.displacement(), other_displacement = other.displacement();
    if (distance + dot(normal, own_displacement - other_displacement) >= contact_margin * gap)
      return;
    out_.patches.push_back(patches_);
    if (pair_.same()) {
      out_.of_a.push_back(joint(own, other, normal, gap));
    } else if (share_) {
      const int a = pair_.number_a, b = pair_.number_b;
      out_.shared.push_back({joint(own, other, normal, gap), swapped ? b : a, swapped ? a : b});
    } else {
      const Vec3d middle =
          0.5 * (own.start() + other.start() + own_displacement + other_displacement);
      const double half = 0.5 * gap, along = dot(normal, middle);
      add_half(own, normal, {along + half, other_displacement}, swapped ? out_.of_b : out_.of_a);
      add_half(other, -normal, {-along + half, own_displacement}, swapped ? out_.of_a : out_.of_b);
    }
  }

  /// Contact with both sides in it.
  [[nodiscard]] Contact joint(const ContactSide& own, const ContactSide& other, Vec3d normal,
                              double gap) const {
    Contact contact;
    contact.weights = {};
    std::size_t count = 0;
    const auto put = [&](const ContactSide& side, double sign) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (side.weights[k] == 0) continue;
        contact.samples[count] = side.samples[k];
        contact.weights[count++] = static_cast<float>(sign * side.weights[k]);
      }
    };
    put(own, 1);
    put(other, -1);
    contact.offset = static_cast<float>(gap);
    finish(normal, own.compliance() + other.compliance(), contact);
    return contact;
  }

  void add_half(const ContactSide& side, Vec3d normal, const Plane& plane,
                std::vector<Contact>& out) const {
    Contact contact;
    for (std::size_t k = 0; k < 3; ++k) {
      contact.samples[k] = side.samples[k];
      contact.weights[k] = static_cast<float>(side.weights[k]);
    }
    contact.weights[3] = 0;
    contact.offset = static_cast<float>(plane.offset);
    contact.surface_displacement = vec_cast<float>(plane.surface_displacement);
    finish(normal, side.compliance(), contact);
    out.push_back(contact);
  }

  void finish(Vec3d normal, double compliance, Contact& contact) const {
    contact.normal = vec_cast<float>(normal);
    contact.friction = static_cast<float>(pair_.friction);
    contact.stiffness = layer_stiffness(compliance, pair_.time_step);
  }

  const ClothPair& pair_;
  const CollideKernels& kernels_;
  bool share_;
  PairFound& out_;
  double gap_ = 0;  // that contacts of two cells keep, apart from creases [m]
  // Of one cell and a tile:
  ContactPatches patches_;
  std::array<Other, tile_cells> others_;
  int count_ = 0;
  std::array<float, tile_cells> near_{}, near_edges_{};  // see CollideKernels::tile_reaches [m]
  std::array<int, tile_cells> found_{};
};

}  // namespace

float layer_stiffness(double compliance, double time_step) {
  const double inertia = compliance > 0 ? 1 / (compliance * time_step * time_step) : 0;
  return static_cast<float>(softness * inertia);
}

void PairFound::clear() {
  of_a.clear();
  of_b.clear();
  shared.clear();
  patches.clear();
  near = false;
}

void PairFound::append(const PairFound& other) {
  of_a.insert(of_a.end(), other.of_a.begin(), other.of_a.end());
  of_b.insert(of_b.end(), other.of_b.begin(), other.of_b.end());
  shared.insert(shared.end(), other.shared.begin(), other.shared.end());
  patches.insert(patches.end(), other.patches.begin(), other.patches.end());
  near = near || other.near;
}

void PairContacts::find(const ClothPair& pair, std::span<const CandidateTile> cells, bool share,
                        ThreadTeam& team) {
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  parts_.fill(static_cast<int>(cells.size()), team,
              [&](int i, PairFound& mine) { Finder(pair, kernels, share, mine).find(cells[i]); });
  found_.clear();
  for (const PairFound& part : parts_.lists()) found_.append(part);
}

void PairContacts::keep_unmoved(const MovedPatches& moved) {
  std::size_t kept = 0;
  const auto keep = [&](auto& list, std::size_t i) {
    if (!list.empty()) list[kept] = list[i];
  };
  for (std::size_t i = 0; i < found_.patches.size(); ++i) {
    if (moved.a[found_.patches[i].a] != 0 || moved.b[found_.patches[i].b] != 0) continue;
    keep(found_.of_a, i);
    keep(found_.of_b, i);
    keep(found_.shared, i);
    found_.patches[kept++] = found_.patches[i];
  }
  const auto cut = [&](auto& list) { list.resize(std::min(list.size(), kept)); };
  cut(found_.of_a);
  cut(found_.of_b);
  cut(found_.shared);
  cut(found_.patches);
}

void PairContacts::find_again(const ClothPair& pair, std::span<const CandidateTile> cells,
                              const MovedPatches& moved, bool share, ThreadTeam& team) {
  keep_unmoved(moved);
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  const Tiling &of_a = pair.tiles_a->tiling(), &of_b = pair.tiles_b->tiling();
  parts_.fill(static_cast<int>(cells.size()), team, [&](int i, PairFound& mine) {
    if (moved.a[of_a.patch_a(cells[i])] != 0 || moved.b[of_b.patch_b(cells[i])] != 0)
      Finder(pair, kernels, share, mine).find(cells[i]);
  });
  for (const PairFound& part : parts_.lists()) found_.append(part);
}

}  // namespace weft
