#include "weft/collide/contacts/pair_contacts.h"

#include <algorithm>
#include <cmath>

#include "weft/collide/contacts/closest.h"
#include "weft/collide/contacts/seen_cells.h"

namespace weft {
namespace {

/// Stiffness of contacts between layers relative to the inertia of their points in a step. Hard
/// contacts of many layers, linearised anew each step, could hardly be satisfied together and
/// strained the cloth by several percent. The filter stops what these soft ones do not.
constexpr double softness = 100;
/// Cosine between the normals of cells from which on layers count as lying flat on each other; and
/// the part of the gap kept by edges of such layers, which samples and triangles hold apart as a
/// rule, and by the two sides of a crease, which bending holds apart.
constexpr float flat = 0.8F;
constexpr double worn = 0.5;
/// Cells no farther apart along the cloth than this many gaps get no contact: the cloth would have
/// to turn within half a gap to lie on itself, which bending prevents.
constexpr double beside_in_gaps = 3;

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
  /// Inverse effective mass of the point. [1/kg]
  [[nodiscard]] double compliance() const {
    double sum = 0;
    const int n = cloth->start.size();
    for (std::size_t k = 0; k < 3; ++k)
      sum += weights[k] * weights[k] * cloth->inverse_mass(samples[k] / n, samples[k] % n);
    return sum;
  }
  [[nodiscard]] Vec3d displacement() const { return mean(cloth->position) - start(); }
};

/// The half-space against one side: its offset and how it moves.
struct Plane {
  double offset;
  Vec3d surface_displacement;
};

/// Collects the contacts of one pair of cells after the other.
class Finder {
 public:
  Finder(const ClothPair& pair, const PairLists& lists) : pair_(pair), lists_(lists) {}

  void find(const CandidatePair& cells) {
    const CandidateCell a(*pair_.grid_a, cells.a, false), b(*pair_.grid_b, cells.b, true);
    const bool crease = pair_.same() && adjacent(a, b);
    if (pair_.same() && (crease ? !pair_.creases : beside(a, b))) return;
    gap_ = crease ? worn * pair_.gap : pair_.gap;
    const MovingSurface surface_a{pair_.grid_a, &pair_.a->start, &pair_.a->position};
    const MovingSurface surface_b{pair_.grid_b, &pair_.b->start, &pair_.b->position};
    const CellGaps gaps(surface_a, cells.a, surface_b, cells.b);
    const double reach = contact_margin * gap_;
    if (gaps.apart(reach, reach)) return;
    approach_ = gaps.max_approach();
    samples_with_triangles(gaps, a, b);
    samples_with_triangles(gaps, b, a);
    if (crease) return;
    if (gaps.parallel(flat)) gap_ = worn * pair_.gap;
    edges(gaps, a, b);
  }

 private:
  /// Whether two cells share a corner: they fold onto each other at the crease only.
  static bool adjacent(const CandidateCell& a, const CandidateCell& b) {
    if (a.next_to(b)) return true;
    if (!a.is_border() || !b.is_border()) return false;
    return std::any_of(a.samples.begin(), a.samples.end(), [&](int s) {
      return std::any_of(b.samples.begin(), b.samples.end(),
                         [&](int t) { return a.grid->joint(s) == a.grid->joint(t); });
    });
  }

  /// Whether the distance between two cells along a row and a column at rest is at most
  /// beside_in_gaps.
  [[nodiscard]] bool beside(const CandidateCell& a, const CandidateCell& b) const {
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

  /// Distance at the start beyond which there is no contact. [m]
  [[nodiscard]] float near(const CellGaps& gaps) const {
    return static_cast<float>(contact_margin * gap_ + approach_) + gaps.margin();
  }

  void samples_with_triangles(const CellGaps& gaps, const CandidateCell& own,
                              const CandidateCell& other) {
    const float farthest = near(gaps);
    for (int half = 0; half < 2; ++half) {
      const std::array<int, 3> corners = other.grid->triangle_corners(other.cell, half);
      const CandidateTriangle seen(gaps, other.second, corners);
      own.for_own_corners([&](int k) {
        if (!seen.may_hold(gaps.start(own.second, k), farthest)) return;
        const std::array<int, 3> triangle{other.samples[corners[0]], other.samples[corners[1]],
                                          other.samples[corners[2]]};
        if (!other.grid->folded(triangle))
          sample_with_triangle(own.samples[k], triangle, own.second);
      });
    }
  }

  void sample_with_triangle(int sample, const std::array<int, 3>& triangle, bool swapped) {
    if (pair_.same() && shares_point(sample, triangle)) return;
    const Planes3& at = cloth(!swapped).start;
    const std::array<double, 3> weights =
        closest_weights(vec_cast<double>(cloth(swapped).start.at(sample)),
                        {vec_cast<double>(at.at(triangle[0])), vec_cast<double>(at.at(triangle[1])),
                         vec_cast<double>(at.at(triangle[2]))});
    // Where an edge or a corner is closest the direction to it may lie along the cloth, where a
    // push would strain it: that is left to edges and to the filter.
    if (std::any_of(weights.begin(), weights.end(), [](double w) { return !(w > 0); })) return;
    add({&cloth(swapped), {sample, sample, sample}, {1, 0, 0}},
        {&cloth(!swapped), triangle, weights}, swapped);
  }

  [[nodiscard]] bool shares_point(int sample, const std::array<int, 3>& triangle) const {
    const SurfaceGrid& grid = *pair_.grid_a;
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](int corner) { return grid.joint(corner) == grid.joint(sample); });
  }

  void edges(const CellGaps& gaps, const CandidateCell& a, const CandidateCell& b) {
    const float reach = near(gaps);
    const auto seen = [&](const CandidateCell& cell) {
      std::array<CandidateEdge, 3> edges{};
      const auto corners = cell.own_edges();
      for (std::size_t i = 0; i < 3; ++i) edges[i] = CandidateEdge::of(gaps, cell, corners[i]);
      return edges;
    };
    const std::array<CandidateEdge, 3> of_b = seen(b);
    for (const CandidateEdge& p : seen(a))
      for (const CandidateEdge& q : of_b)
        if (p.may_cross(q, reach)) add_edges(p.samples, q.samples);
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
    add({pair_.a, {p[0], p[1], p[1]}, {closest.weights_a[0], closest.weights_a[1], 0}},
        {pair_.b, {q[0], q[1], q[1]}, {closest.weights_b[0], closest.weights_b[1], 0}}, false);
  }

  /// Between layers that have come through each other a contact would push the wrong way.
  [[nodiscard]] bool misled(const Side& own, const Side& other, bool swapped) const {
    if (pair_.tangle == nullptr) return false;
    const Side &a = swapped ? other : own, &b = swapped ? own : other;
    return TangleMarks::misled(pair_.tangle->of(0, *pair_.grid_a, a.samples),
                               pair_.tangle->of(1, *pair_.grid_b, b.samples));
  }

  void add(const Side& own, const Side& other, bool swapped) {
    if (misled(own, other, swapped)) return;
    const Vec3d apart = own.start() - other.start();
    const double distance = length(apart);
    if (!(distance > 0)) return;
    const Vec3d normal = (1 / distance) * apart;
    const Vec3d own_displacement = own.displacement(), other_displacement = other.displacement();
    if (distance + dot(normal, own_displacement - other_displacement) >= contact_margin * gap_)
      return;
    if (pair_.same()) {
      lists_.of_a.push_back(joint(own, other, normal));
    } else if (lists_.shared != nullptr) {
      const int a = pair_.number_a, b = pair_.number_b;
      lists_.shared->push_back({joint(own, other, normal), swapped ? b : a, swapped ? a : b});
    } else {
      const Vec3d middle =
          0.5 * (own.start() + other.start() + own_displacement + other_displacement);
      const double half = 0.5 * gap_, along = dot(normal, middle);
      add_half(own, normal, {along + half, other_displacement},
               swapped ? lists_.of_b : lists_.of_a);
      add_half(other, -normal, {-along + half, own_displacement},
               swapped ? lists_.of_a : lists_.of_b);
    }
  }

  /// Contact with both sides in it.
  [[nodiscard]] Contact joint(const Side& own, const Side& other, Vec3d normal) const {
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
    contact.offset = static_cast<float>(gap_);
    finish(normal, own.compliance() + other.compliance(), contact);
    return contact;
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
  const PairLists& lists_;
  double gap_ = 0;       // that contacts of the cells keep [m]
  double approach_ = 0;  // of the cells in the step, at most [m]
};

}  // namespace

float layer_stiffness(double compliance, double time_step) {
  const double inertia = compliance > 0 ? 1 / (compliance * time_step * time_step) : 0;
  return static_cast<float>(softness * inertia);
}

void PairContacts::find(const ClothPair& pair, std::span<const CandidatePair> cells,
                        ThreadTeam& team, const PairLists& lists) {
  found_.fill(static_cast<int>(cells.size()), team, [&](int i, Found& mine) {
    const PairLists out{mine.of_a, mine.of_b, lists.shared != nullptr ? &mine.shared : nullptr};
    Finder(pair, out).find(cells[i]);
  });
  for (const Found& mine : found_.lists()) {
    lists.of_a.insert(lists.of_a.end(), mine.of_a.begin(), mine.of_a.end());
    lists.of_b.insert(lists.of_b.end(), mine.of_b.begin(), mine.of_b.end());
    if (lists.shared != nullptr)
      lists.shared->insert(lists.shared->end(), mine.shared.begin(), mine.shared.end());
  }
}

}  // namespace weft
