#include "weft/collide/contacts/pair_contacts.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "tests/collide/halved_sheet.h"
#include "tests/collide/test_bodies.h"
#include "weft/collide/contacts/closest.h"
#include "weft/collide/contacts/contact_finder.h"
#include "weft/core/random.h"

namespace weft::pair_contacts_test {
namespace {

using test::HalvedSheet;
using test::TestCloth;

constexpr double gap = 0.05;
/// The gap that edges of parallel cells keep, which is the least of all.
constexpr double min_gap = 0.5 * gap;

/// A cloth with diagonals at random where its charts have cells.
struct Layer {
  Layer(int n, const BorderMates& of, Random& random)
      : mates(of), cloth(n), diagonals(n - 1, n - 1) {
    for (int r = 0; r < n - 1; ++r)
      for (int c = 0; c < n - 1; ++c) {
        const bool there = mates.size() == 0 || mates.has_cell(r, c);
        const auto way = random.uniform(0, 1) < 0.5 ? Diagonal::rising : Diagonal::falling;
        diagonals(r, c) = there ? way : Diagonal::none;
      }
  }
  [[nodiscard]] CollidingCloth properties() const {
    return {.mates = mates,
            .size = cloth.start.size(),
            .diagonals = diagonals,
            .thickness = gap,
            .rest_spacing = 0.2,
            .self_collision = itself,
            .self_thickness = gap};
  }
  void lie_at(const Planes3& positions) { cloth.start = cloth.position = positions; }

  BorderMates mates;
  TestCloth cloth;
  Grid<Diagonal> diagonals;
  bool itself = false;  // whether contacts with itself are looked for
};

/// Samples of a feature by the points that they are.
using Points = std::set<int>;
/// A feature of each of two layers.
using Meeting = std::pair<Points, Points>;

/// Every point, edge and triangle of a layer, each once.
class Surface {
 public:
  explicit Surface(const Layer& layer)
      : grid_(layer.cloth.start.size(), layer.mates, layer.diagonals), at_(layer.cloth.start) {
    for (int cell = 0; cell < grid_.cells() * grid_.cells(); ++cell)
      for (int half = 0; half < 2; ++half)
        if (const std::array t = grid_.triangle(cell, half); !grid_.folded(t)) add(t);
  }
  [[nodiscard]] const std::map<Points, Feature>& of(int corners) const {
    return features_[corners - 1];
  }
  [[nodiscard]] int point(int sample) const { return grid_.point(sample); }
  /// Whether a point is beyond a vertex or an edge: no triangle that has it is closer, and the
  /// direction to it is within 45 degrees of one's normal.
  [[nodiscard]] bool is_ridge(const Points& feature, Vec3d on_it, Vec3d point) const {
    const double distance = length(point - on_it);
    bool faces = false;
    for (const auto& [points, triangle] : of(3)) {
      if (!std::includes(points.begin(), points.end(), feature.begin(), feature.end())) continue;
      const auto& [a, b, c] = triangle.corners;
      const std::array<double, 3> w = closest_weights(point, triangle.corners);
      if (length(point - (w[0] * a + w[1] * b + w[2] * c)) < distance * (1 - 1e-9)) return false;
      const Vec3d normal = cross(b - a, c - a);
      faces = faces ||
              std::abs(dot(normal, point - on_it)) > std::sqrt(0.5) * length(normal) * distance;
    }
    return faces;
  }

 private:
  void add(const std::array<int, 3>& t) {
    put({t[0], t[1], t[2]});
    for (std::size_t k = 0; k < 3; ++k) {
      put({t[k]});
      put({t[k], t[(k + 1) % 3]});
    }
  }
  void put(const std::vector<int>& samples) {
    Points points;
    Feature feature;
    feature.count = static_cast<int>(samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
      feature.corners[k] = vec_cast<double>(at_.at(samples[k]));
      points.insert(grid_.point(samples[k]));
    }
    features_[samples.size() - 1][points] = feature;
  }

  SurfaceGrid grid_;
  Planes3 at_;
  std::array<std::map<Points, Feature>, 3> features_;
};

/// The closest points of a vertex and a vertex or an edge.
ClosestPair closest_to_vertex(const Feature& vertex, const Feature& other) {
  const Vec3d p = vertex.corners[0], from = other.corners[0];
  ClosestPair closest;
  closest.a = p;
  closest.weights_a = closest.weights_b = {1, 0, 0};
  closest.b = from;
  if (other.count == 2) {
    const Vec3d along = other.corners[1] - from;
    const double part = std::clamp(dot(p - from, along) / squared_length(along), 0.0, 1.0);
    closest.weights_b = {1 - part, part, 0};
    closest.b = from + part * along;
  }
  closest.squared_distance = squared_length(p - closest.b);
  return closest;
}

ClosestPair closest_of(const Feature& a, const Feature& b) {
  if (a.count == 1 && b.count < 3) return closest_to_vertex(a, b);
  if (b.count != 1 || a.count == 3) return closest_points(a, b);
  ClosestPair closest = closest_to_vertex(b, a);
  std::swap(closest.a, closest.b);
  std::swap(closest.weights_a, closest.weights_b);
  return closest;
}

/// Pairs of features with their closest points inside both, by their distance: of vertices and
/// triangles, of edges, and of vertices that are beyond a ridge of the other surface.
std::map<Meeting, double> all_pairs(const Surface& a, const Surface& b) {
  std::map<Meeting, double> pairs;
  for (const auto& [of_a, of_b] : {std::pair(1, 3), std::pair(3, 1), std::pair(2, 2),
                                   std::pair(1, 2), std::pair(2, 1), std::pair(1, 1)})
    for (const auto& [points_a, feature_a] : a.of(of_a))
      for (const auto& [points_b, feature_b] : b.of(of_b)) {
        const ClosestPair closest = closest_of(feature_a, feature_b);
        const auto inner = [](const std::array<double, 3>& weights, int count) {
          return std::all_of(weights.begin(), weights.begin() + count,
                             [](double weight) { return weight > 0; });
        };
        const bool near = closest.squared_distance < contact_margin * gap * contact_margin * gap;
        const bool beyond = of_a + of_b == 4 ||
                            (near && of_a == 1 && b.is_ridge(points_b, closest.b, closest.a)) ||
                            (near && of_b == 1 && a.is_ridge(points_a, closest.a, closest.b));
        if (beyond && inner(closest.weights_a, of_a) && inner(closest.weights_b, of_b))
          pairs[{points_a, points_b}] = std::sqrt(closest.squared_distance);
      }
  return pairs;
}

/// The search for contacts of layers alone, without bodies.
class Search {
 public:
  explicit Search(std::span<Layer* const> layers) {
    for (Layer* layer : layers) {
      properties_.push_back(layer->properties());
      moving_.push_back(layer->cloth.moving());
    }
    world_.emplace(test::pyramid, nothing_, properties_);
    std::vector<const SurfaceGrid*> grids;
    for (const WorldCloth& cloth : world_->cloths) grids.push_back(&cloth.grid);
    untangler_.set_up(grids, properties_);
    finder_.emplace(*world_, nothing_);
    finder_->share(true);
    world_->gather_surfaces(moving_);
    world_->place_bodies(team_);
    world_->refit(team_);
    finder_->find_with_bodies(moving_, 0.01, team_);
    finder_->find_between_cloths(moving_, 0.01, untangler_, team_);
  }

  /// How often each pair of features of two layers has a contact.
  [[nodiscard]] std::map<Meeting, int> between() const {
    std::map<Meeting, int> found;
    for (const SharedContact& one : finder_->shared()) {
      const Meeting meeting = meeting_of(one.contact, one.first, one.second);
      ++found[one.first == 0 ? meeting : Meeting{meeting.second, meeting.first}];
    }
    return found;
  }
  /// The same of a layer with itself.
  [[nodiscard]] std::map<Meeting, int> with_itself() const {
    std::map<Meeting, int> found;
    for (const Contact& one : finder_->contacts(0)) ++found[meeting_of(one, 0, 0)];
    return found;
  }

 private:
  [[nodiscard]] Meeting meeting_of(const Contact& contact, int first, int second) const {
    Meeting meeting;
    const auto point = [&](int cloth, int sample) {
      return world_->cloths[static_cast<std::size_t>(cloth)].grid.point(sample);
    };
    for (std::size_t k = 0; k < 4; ++k) {
      const float weight = contact.weights[k];
      if (weight > 0) meeting.first.insert(point(first, contact.samples[k]));
      if (weight < 0) meeting.second.insert(point(second, contact.samples[k]));
    }
    return meeting;
  }

  std::vector<CollidingCloth> properties_;
  std::vector<MovingCloth> moving_;
  Obstacles nothing_;
  ThreadTeam team_{2};
  std::optional<CollisionWorld> world_;
  Untangler untangler_;
  std::optional<ContactFinder> finder_;
};

/// That all pairs of features that are near have one contact, and no others have any.
/// @return how many there are
int check_every_pair(Layer& a, Layer& b) {
  const std::map<Meeting, double> pairs = all_pairs(Surface(a), Surface(b));
  const std::map<Meeting, int> found = Search(std::array{&a, &b}).between();
  int missed = 0, strange = 0;
  for (const auto& [meeting, distance] : pairs) {
    const bool of_edges = meeting.first.size() == 2 && meeting.second.size() == 2;
    const double reach = contact_margin * (of_edges ? min_gap : gap);
    if (distance < reach && !found.contains(meeting)) ++missed;
  }
  for (const auto& [meeting, times] : found) {
    const auto known = pairs.find(meeting);
    if (known == pairs.end() || !(known->second < contact_margin * gap)) ++strange;
    EXPECT_EQ(times, 1);
  }
  EXPECT_EQ(missed, 0) << "of " << pairs.size();
  EXPECT_EQ(strange, 0);
  return static_cast<int>(found.size());
}

/// A rumpled sheet of 9 x 9 samples, turned about its middle and moved.
Planes3 rumpled(Vec3d middle, Random& random) {
  constexpr int n = HalvedSheet::n;
  Planes3 sheet(n);
  const double turn = random.uniform(0, 2 * pi);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double x = 0.2 * (c - 0.5 * (n - 1)), z = 0.2 * (r - 0.5 * (n - 1));
      const auto shake = [&](double size) { return size * random.uniform(-1, 1); };
      const Vec3d at{cosine(turn) * x - sine(turn) * z + shake(0.05), shake(0.06),
                     sine(turn) * x + cosine(turn) * z + shake(0.05)};
      sheet.set(r, c, vec_cast<float>(middle + at));
    }
  return sheet;
}

/// Places a second layer above a first, over its middle or beyond its border.
Vec3d place_above(Random& random) {
  return {random.uniform(-0.9, 0.9), 0.08, random.uniform(-0.9, 0.9)};
}

TEST(PairContacts, EveryPairOfFeaturesOfTwoSheetsHasOne) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Layer a(HalvedSheet::n, {}, random), b(HalvedSheet::n, {}, random);
    a.lie_at(rumpled({}, random));
    b.lie_at(rumpled(place_above(random), random));
    found += check_every_pair(a, b);
  }
  EXPECT_GT(found, 400);
}

TEST(PairContacts, SoItIsWhereChartsEndAndAreJoined) {
  int found = 0;
  for (int way = 0; way < 8; ++way)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Random random(seed);
      const HalvedSheet halved(way);
      Layer a(HalvedSheet::size, halved.mates, random), b(HalvedSheet::n, {}, random);
      a.lie_at(halved.image_of(rumpled({}, random)));
      b.lie_at(rumpled(place_above(random), random));
      found += check_every_pair(a, b) + check_every_pair(b, a);
    }
  EXPECT_GT(found, 800);
}

TEST(PairContacts, SoItIsOnSurfacesWithoutABorder) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Body ball = test::octahedral_sphere(9, 0.5, {0, -0.5, 0}),
               ring = test::torus(9, 0.6, 0.3);
    Layer of_ball(9, ball.mates, random), of_ring(9, ring.mates, random),
        b(HalvedSheet::n, {}, random);
    of_ball.lie_at(ball.positions);
    of_ring.lie_at(ring.positions);
    b.lie_at(rumpled({0, 0.02, 0}, random));
    found += check_every_pair(of_ball, b);
    b.lie_at(rumpled({random.uniform(-0.9, 0.9), 0.32, random.uniform(-0.9, 0.9)}, random));
    found += check_every_pair(of_ring, b);
  }
  EXPECT_GT(found, 100);
}

/// The contacts of a cut sheet with itself, by the points of the uncut one.
std::map<Meeting, int> as_uncut(const HalvedSheet& halved, const std::map<Meeting, int>& found) {
  const SurfaceGrid cut(HalvedSheet::size, halved.mates, {});
  std::map<int, int> uncut;
  for (int s = 0; s < HalvedSheet::n * HalvedSheet::n; ++s) {
    const int row = s / HalvedSheet::n, col = s % HalvedSheet::n;
    uncut[cut.point(halved.image_sample(row, col, col > HalvedSheet::half))] = s;
  }
  const auto points = [&](const Points& of) {
    Points there;
    for (const int point : of) there.insert(uncut.at(point));
    return there;
  };
  std::map<Meeting, int> same;
  for (const auto& [meeting, times] : found)
    same[{points(meeting.first), points(meeting.second)}] += times;
  return same;
}

/// Whether the features of an uncut sheet lie on one side of the cut, or so far apart along it that
/// they keep the whole gap: across a cut nothing tells how far they are.
bool are_comparable(const Meeting& meeting) {
  const auto pair = [](int a, int b) {
    constexpr int n = HalvedSheet::n, cut = HalvedSheet::half;
    return (a % n - cut) * (b % n - cut) > 0 ||
           std::max(std::abs(a / n - b / n), std::abs(a % n - b % n)) >= 4;
  };
  return std::all_of(meeting.first.begin(), meeting.first.end(), [&](int a) {
    return std::all_of(meeting.second.begin(), meeting.second.end(),
                       [&](int b) { return pair(a, b); });
  });
}

/// Those that are comparable, without an order of the two sides.
std::map<Meeting, int> unordered(const std::map<Meeting, int>& found) {
  std::map<Meeting, int> same;
  for (const auto& [meeting, times] : found)
    if (are_comparable(meeting)) same[std::minmax(meeting.first, meeting.second)] += times;
  return same;
}

/// The diagonals of a cut sheet that divide its cells as those of the uncut one.
Grid<Diagonal> cut_diagonals(const HalvedSheet& halved, const Grid<Diagonal>& uncut) {
  Grid<Diagonal> cut(HalvedSheet::size - 1, HalvedSheet::size - 1, Diagonal::none);
  for (int r = 0; r < uncut.rows(); ++r)
    for (int c = 0; c < uncut.cols(); ++c) {
      const bool right = c >= HalvedSheet::half;
      const int a = halved.image_sample(r, c, right), b = halved.image_sample(r + 1, c + 1, right);
      const bool mirrored = (b / HalvedSheet::size > a / HalvedSheet::size) !=
                            (b % HalvedSheet::size > a % HalvedSheet::size);
      const bool rises = (uncut(r, c) == Diagonal::rising) != mirrored;
      const int cell = halved.image_cell(r, c);
      cut(cell / (HalvedSheet::size - 1), cell % (HalvedSheet::size - 1)) =
          rises ? Diagonal::rising : Diagonal::falling;
    }
  return cut;
}

/// A sheet rolled up along a turned axis, and rumpled.
Planes3 rolled(double radius, Random& random) {
  Planes3 sheet = rumpled({}, random);
  for (int s = 0; s < HalvedSheet::n * HalvedSheet::n; ++s) {
    const Vec3d p = vec_cast<double>(sheet.at(s));
    const double angle = p.x / radius, out = radius * (1 - 0.03 * angle) + 0.3 * p.y;
    sheet.set(s, vec_cast<float>(Vec3d{out * sine(angle), out * cosine(angle), p.z}));
  }
  return sheet;
}

TEST(PairContacts, ACutSheetHasThoseOfTheUncutOneWithItself) {
  int all = 0;
  // The ways that keep every cell's first corner: the cells that edges belong to decide which of
  // them count as parallel.
  for (const int way : {0, 1})
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Random random(seed);
      const HalvedSheet halved(way);
      Layer whole(HalvedSheet::n, {}, random), cut(HalvedSheet::size, halved.mates, random);
      cut.diagonals = cut_diagonals(halved, whole.diagonals);
      whole.lie_at(rolled(random.uniform(0.12, 0.2), random));
      cut.lie_at(halved.image_of(whole.cloth.start));
      whole.itself = cut.itself = true;
      const auto of_whole = unordered(Search(std::array{&whole}).with_itself());
      const auto of_cut = unordered(as_uncut(halved, Search(std::array{&cut}).with_itself()));
      EXPECT_EQ(of_whole, of_cut) << way << ' ' << seed;
      all += static_cast<int>(of_whole.size());
    }
  EXPECT_GT(all, 1000);
}

}  // namespace
}  // namespace weft::pair_contacts_test
