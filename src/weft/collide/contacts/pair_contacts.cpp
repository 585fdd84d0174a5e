#include "weft/collide/contacts/pair_contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "weft/collide/contacts/closest.h"
#include "weft/collide/pairs/cell_gaps.h"

namespace weft {
namespace {

/// Layers press on each other like soft springs, of this part of the stiffness that inertia has
/// against a step: hard ones of many layers, linearised anew each step, could hardly be satisfied
/// together, and strained the cloth by several percent. What they do not stop the guard does.
constexpr double softness = 100;
/// As for bodies: contacts begin this many gaps before the one that is kept.
constexpr double foresight = 1.5;
/// Edges that cross in layers lying flat on each other are left to samples and triangles.
constexpr double flat = 0.8;

/// One side of a contact: up to three samples of a cloth with weights that sum to 1.
struct Side {
  const MovingCloth* cloth;
  std::array<int, 3> samples;
  std::array<double, 3> weights;

  [[nodiscard]] Vec3d mean(const Planes3& planes) const {
    Vec3d sum;
    for (std::size_t k = 0; k < 3; ++k)
      if (weights[k] != 0) sum += weights[k] * vec_cast<double>(planes.at(samples[k]));
    return sum;
  }
  [[nodiscard]] Vec3d start() const { return mean(cloth->start); }
  /// How far the point gives way to an impulse. [1/kg]
  [[nodiscard]] double compliance() const {
    double sum = 0;
    const int n = cloth->start.size();
    for (std::size_t k = 0; k < 3; ++k)
      sum += weights[k] * weights[k] * cloth->inverse_mass(samples[k] / n, samples[k] % n);
    return sum;
  }
  [[nodiscard]] Vec3d way() const { return mean(cloth->position) - start(); }
};

/// What stands against one side: where, and how it moves.
struct Plane {
  double offset;
  Vec3d slide;
};

Vec3d cell_normal(const SurfaceGrid& grid, const Planes3& at, int cell) {
  const std::array<int, 4> s = grid.corners(cell);
  return normalized(cross(vec_cast<double>(at.at(s[1])) - vec_cast<double>(at.at(s[2])),
                          vec_cast<double>(at.at(s[3])) - vec_cast<double>(at.at(s[0]))));
}

/// Looks at one pair of cells after the other and collects contacts.
class Finder {
 public:
  Finder(const ClothPair& pair, std::vector<Contact>& of_a, std::vector<Contact>& of_b)
      : pair_(pair), of_a_(of_a), of_b_(of_b) {}

  void look_at(const CellPair& cells) {
    if (pair_.same && adjacent(cells)) return;
    const CellGaps gaps = gaps_of(cells);
    const double reach = foresight * pair_.gap;
    if (gaps.apart(reach, reach)) return;
    near_ = reach + gaps.most_approach();
    samples_with_triangles(*pair_.grid_a, cells.a, *pair_.grid_b, cells.b, false);
    samples_with_triangles(*pair_.grid_b, cells.b, *pair_.grid_a, cells.a, true);
    edges(cells);
  }

 private:
  /// Cells that share a corner fold onto each other at the crease only, where bending and the guard
  /// see to them.
  [[nodiscard]] bool adjacent(const CellPair& cells) const {
    const SurfaceGrid& grid = *pair_.grid_a;
    const int side = grid.cells();
    if (std::abs(cells.a / side - cells.b / side) <= 1 &&
        std::abs(cells.a % side - cells.b % side) <= 1)
      return true;
    if (!on_border(cells.a) || !on_border(cells.b)) return false;
    const std::array<int, 4> a = grid.corners(cells.a), b = grid.corners(cells.b);
    return std::any_of(a.begin(), a.end(), [&](int s) {
      return std::any_of(b.begin(), b.end(), [&](int t) { return grid.point(s) == grid.point(t); });
    });
  }

  [[nodiscard]] bool on_border(int cell) const {
    const int last = pair_.grid_a->cells() - 1, row = cell / (last + 1), col = cell % (last + 1);
    return row == 0 || col == 0 || row == last || col == last;
  }

  [[nodiscard]] CellGaps gaps_of(const CellPair& cells) const {
    const MovingSurface a{pair_.grid_a, &pair_.a->start, &pair_.a->position};
    const MovingSurface b{pair_.grid_b, &pair_.b->start, &pair_.b->position};
    return {a, cells.a, b, cells.b};
  }

  [[nodiscard]] const MovingCloth& cloth(bool b) const { return b ? *pair_.b : *pair_.a; }
  [[nodiscard]] const SurfaceGrid& grid(bool b) const { return b ? *pair_.grid_b : *pair_.grid_a; }

  /// Visits the samples that belong to a cell: its first, and at the last row and column those that
  /// no other cell begins with.
  template <class Visit>
  static void for_own_samples(const SurfaceGrid& grid, int cell, const Visit& visit) {
    const int last = grid.cells() - 1, row = cell / grid.cells(), col = cell % grid.cells();
    const std::array<int, 4> s = grid.corners(cell);
    const std::array<bool, 4> own{true, col == last, row == last, row == last && col == last};
    for (std::size_t k = 0; k < 4; ++k)
      if (own[k] && grid.point(s[k]) == s[k]) visit(s[k]);
  }

  void samples_with_triangles(const SurfaceGrid& own, int own_cell, const SurfaceGrid& other,
                              int other_cell, bool swapped) {
    for (int half = 0; half < 2; ++half) {
      const std::array<int, 3> triangle = other.triangle(other_cell, half);
      if (other.folded(triangle)) continue;
      std::array<Vec3d, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = vec_cast<double>(cloth(!swapped).start.at(triangle[k]));
      const Vec3d across = cross(corners[1] - corners[0], corners[2] - corners[0]);
      const double farthest = near_ * length(across);
      for_own_samples(own, own_cell, [&](int sample) {
        const Vec3d from = vec_cast<double>(cloth(swapped).start.at(sample)) - corners[0];
        if (std::abs(dot(across, from)) > farthest) return;
        if (pair_.same && shares_point(sample, triangle)) return;
        const std::array<double, 3> weights =
            closest_weights(vec_cast<double>(cloth(swapped).start.at(sample)), corners);
        // Before an edge or a corner the way to it may lie along the cloth, where a push would
        // strain it: that is left to edges and to the guard.
        if (std::any_of(weights.begin(), weights.end(), [](double w) { return !(w > 0); })) return;
        add({&cloth(swapped), {sample, sample, sample}, {1, 0, 0}},
            {&cloth(!swapped), triangle, weights}, swapped);
      });
    }
  }

  [[nodiscard]] bool shares_point(int sample, const std::array<int, 3>& triangle) const {
    const SurfaceGrid& grid = *pair_.grid_a;
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](int corner) { return grid.point(corner) == grid.point(sample); });
  }

  static std::array<std::array<int, 2>, 3> own_edges(const SurfaceGrid& grid, int cell) {
    const std::array<int, 4> s = grid.corners(cell);
    const std::array<int, 3> first = grid.triangle(cell, 0);
    const bool rising = first[2] == s[3];
    return {{{s[0], s[1]}, {s[0], s[2]}, {rising ? s[0] : s[1], rising ? s[3] : s[2]}}};
  }

  void edges(const CellPair& cells) {
    const Vec3d normal_a = cell_normal(grid(false), pair_.a->start, cells.a);
    const Vec3d normal_b = cell_normal(grid(true), pair_.b->start, cells.b);
    if (std::abs(dot(normal_a, normal_b)) > flat) return;
    for (const std::array<int, 2>& p : own_edges(grid(false), cells.a))
      for (const std::array<int, 2>& q : own_edges(grid(true), cells.b)) {
        if (pair_.same &&
            (shares_point(p[0], {q[0], q[1], q[1]}) || shares_point(p[1], {q[0], q[1], q[1]})))
          continue;
        add_edges(p, q);
      }
  }

  void add_edges(const std::array<int, 2>& p, const std::array<int, 2>& q) {
    Feature a, b;
    a.count = b.count = 2;
    for (std::size_t k = 0; k < 2; ++k) {
      a.corners[k] = vec_cast<double>(pair_.a->start.at(p[k]));
      b.corners[k] = vec_cast<double>(pair_.b->start.at(q[k]));
    }
    const Vec3d between = 0.5 * ((a.corners[0] + a.corners[1]) - (b.corners[0] + b.corners[1]));
    const double farthest =
        near_ + 0.5 * (length(a.corners[1] - a.corners[0]) + length(b.corners[1] - b.corners[0]));
    if (squared_length(between) > farthest * farthest) return;
    const ClosestPair closest = closest_points(a, b);
    const auto inner = [](const std::array<double, 3>& w) { return w[0] > 0 && w[1] > 0; };
    if (!inner(closest.weights_a) || !inner(closest.weights_b)) return;
    add({pair_.a, {p[0], p[1], p[1]}, {closest.weights_a[0], closest.weights_a[1], 0}},
        {pair_.b, {q[0], q[1], q[1]}, {closest.weights_b[0], closest.weights_b[1], 0}}, false);
  }

  void add(const Side& own, const Side& other, bool swapped) {
    const Vec3d apart = own.start() - other.start();
    const double distance = length(apart);
    if (!(distance > 0)) return;
    const Vec3d normal = (1 / distance) * apart;
    const Vec3d own_way = own.way(), other_way = other.way();
    if (distance + dot(normal, own_way - other_way) >= foresight * pair_.gap) return;
    if (pair_.same) {
      add_joint(own, other, normal);
    } else {
      const Vec3d middle = 0.5 * (own.start() + other.start() + own_way + other_way);
      const double half = 0.5 * pair_.gap, along = dot(normal, middle);
      add_half(own, normal, {along + half, other_way}, swapped ? of_b_ : of_a_);
      add_half(other, -normal, {-along + half, own_way}, swapped ? of_a_ : of_b_);
    }
  }

  void add_joint(const Side& own, const Side& other, Vec3d normal) {
    Contact contact;
    contact.weights = {};
    std::size_t count = 0;
    const auto put = [&](const Side& side, double sign) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (side.weights[k] == 0) continue;
        contact.samples[count] = side.samples[k];
        contact.weights[count++] = static_cast<float>(sign * side.weights[k]);
      }
    };
    put(own, 1);
    put(other, -1);
    contact.offset = static_cast<float>(pair_.gap);
    finish(normal, own.compliance() + other.compliance(), contact);
    of_a_.push_back(contact);
  }

  void add_half(const Side& side, Vec3d normal, const Plane& plane,
                std::vector<Contact>& out) const {
    Contact contact;
    for (std::size_t k = 0; k < 3; ++k) {
      contact.samples[k] = side.samples[k];
      contact.weights[k] = static_cast<float>(side.weights[k]);
    }
    contact.weights[3] = 0;
    contact.offset = static_cast<float>(plane.offset);
    contact.slide = vec_cast<float>(plane.slide);
    finish(normal, side.compliance(), contact);
    out.push_back(contact);
  }

  void finish(Vec3d normal, double compliance, Contact& contact) const {
    contact.normal = vec_cast<float>(normal);
    contact.friction = static_cast<float>(pair_.friction);
    const double inertia =
        compliance > 0 ? 1 / (compliance * pair_.time_step * pair_.time_step) : 0;
    contact.stiffness = static_cast<float>(softness * inertia);
  }

  const ClothPair& pair_;
  double near_ = 0;  // of the two cells: what starts farther apart makes no contact [m]
  std::vector<Contact>&of_a_, &of_b_;
};

}  // namespace

void PairContacts::find(const ClothPair& pair, std::span<const CellPair> cells, ThreadTeam& team,
                        std::vector<Contact>& of_a, std::vector<Contact>& of_b) {
  team.run([&](Worker& worker) {
    found_.fill(static_cast<int>(cells.size()), worker,
                [&](int i, Found& mine) { Finder(pair, mine.of_a, mine.of_b).look_at(cells[i]); });
  });
  for (const Found& mine : found_.lists()) {
    of_a.insert(of_a.end(), mine.of_a.begin(), mine.of_a.end());
    of_b.insert(of_b.end(), mine.of_b.begin(), mine.of_b.end());
  }
}

}  // namespace weft
