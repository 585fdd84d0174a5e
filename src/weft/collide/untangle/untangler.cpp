#include "weft/collide/untangle/untangler.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Speed of layers in rest spacings a second; and their largest displacement in a step, in rest
/// spacings.
constexpr double spacings_a_second = 30, max_spacings = 0.25;
/// Levels of SmoothMove around a contour: of the push that takes layers apart, and of the hold that
/// keeps them from going deeper. The reach in samples is a power of 2.
constexpr int push_levels = 5, hold_levels = 3;
/// Distance in gaps to which layers are moved beyond each other.
constexpr double margin_in_gaps = 0.5;
/// Component of a direction along the other layer's normal below which the depth of a crossing is
/// not used.
constexpr double min_slope = 0.05;
/// Largest change of a contour's length per displacement at a node, so that single edges that
/// hardly pass through do not decide.
constexpr double max_shortening = 4;
/// Evidence needed to tell which side of another cloth a cloth belongs on: number of its samples
/// that lie on the other, and the excess of one side as a part of them.
constexpr int min_lying = 30;
constexpr double clear_majority = 0.2;
/// Weight of displacements that only shorten a contour: small, so that the values around count more
/// and the layers move as wholes.
constexpr double light = 0.1;

/// Confidence in a sum, given the sum of its terms' squares: near 0 where the terms scatter.
double trust(double sum, double squares) {
  return sum != 0 ? sum * sum / (sum * sum + squares) : 0;
}

double sign(double x) { return x > 0 ? 1 : (x < 0 ? -1 : 0); }

}  // namespace

void Untangler::set_up(std::span<const SurfaceGrid* const> grids,
                       std::span<const CollidingCloth> properties) {
  grids_.assign(grids.begin(), grids.end());
  properties_.clear();
  for (const CollidingCloth& one : properties) properties_.push_back(one);
  pairs_ = std::vector<Pair>(grids_.size() * grids_.size());
  pushes_.resize(grids_.size());
  holds_.resize(grids_.size());
}

int Untangler::crossings() const {
  int total = 0;
  for (const Pair& one : pairs_) total += one.crossings;
  return total;
}

Untangler::Frame Untangler::frame_of(const StandingPair& standing, const ContourNode& node) {
  Frame frame;
  frame.normals[node.layer] = standing.normal(node.crossing.side, node.own);
  frame.normals[1 - node.layer] =
      standing.normal(node.triangle_side(standing.same), node.crossing.triangle);
  return frame;
}

void Untangler::find_regions(const StandingPair& standing, const Pair& pair) {
  for (int side = 0; side < (standing.same ? 1 : 2); ++side) {
    cuts_.clear();
    for (const ContourNode& node : pair.contours.nodes())
      if (node.crossing.side == side) cuts_.push_back(node.crossing.edge);
    regions_[side].find(*standing.grids[side], cuts_);
  }
}

/// Adds the votes of a crossing. If it cuts a region off its edge's sheet, that region should come
/// back through the triangle; and in any case some displacement shortens the contour.
void Untangler::vote(const StandingPair& standing, const ContourNode& node,
                     Verdict& verdict) const {
  const Frame frame = frame_of(standing, node);
  verdict.alike += dot(frame.normals[0], frame.normals[1]);
  const Vec3d shorter = shortening(standing, node);
  const std::array<Vec3d, 3> axes = frame.axes();
  const Vec3d own{dot(shorter, axes[0]), dot(shorter, axes[1]), dot(shorter, axes[2])};
  verdict.shorter += own;
  verdict.scatter += {0, own.y * own.y, own.z * own.z};
  ++verdict.edges[node.layer];
  verdict.first_side = node.crossing.side ^ node.layer;
  const Regions& regions = regions_[node.crossing.side];
  const auto [p, q] = node.crossing.edge;
  const int of_p = regions.of(p), of_q = regions.of(q);
  if (of_p == of_q) return;
  ++verdict.cutting[node.layer];
  const int size_p = regions.size(of_p), size_q = regions.size(of_q);
  const bool p_is_right = size_p != size_q ? size_p > size_q : of_p < of_q;
  const Vec3d displacement =
      standing.at(node.crossing.side, p) - standing.at(node.crossing.side, q);
  const Vec3d normal = frame.normals[1 - node.layer];
  verdict.turns[node.layer] += (p_is_right ? 1 : -1) * sign(dot(normal, displacement));
  int& size = verdict.sizes[node.layer];
  const int min = std::min(size_p, size_q);
  size = size == 0 ? min : std::min(size, min);
}

void Untangler::choose_directions(const StandingPair& standing, const Pair& pair) {
  verdicts_.assign(static_cast<std::size_t>(pair.contours.count()), {});
  for (const ContourNode& node : pair.contours.nodes())
    vote(standing, node, verdicts_[node.contour]);
  for (Verdict& verdict : verdicts_) {
    for (std::size_t layer = 0; layer < 2; ++layer)
      if (2 * verdict.cutting[layer] > verdict.edges[layer])
        verdict.settled[layer] = sign(verdict.turns[layer]);
    verdict.shorter.y *= trust(verdict.shorter.y, verdict.scatter.y);
    verdict.shorter.z *= trust(verdict.shorter.z, verdict.scatter.z);
    // Where both layers would have to move the same way, only the one with the smaller region
    // moves.
    if (verdict.alike * verdict.settled[0] * verdict.settled[1] > 0)
      verdict.settled[verdict.sizes[0] <= verdict.sizes[1] ? 1 : 0] = 0;
  }
}

int Untangler::side_of(const StandingPair& standing, const CandidatePair& cells, double reach) {
  const Vec3d point = standing.at(0, standing.grids[0]->first_sample(cells.a));
  int side = 0;
  for (int half = 0; half < 2; ++half) {
    const std::array<int, 3> triangle = standing.grids[1]->triangle(cells.b, half);
    const Vec3d a = standing.at(1, triangle[0]), b = standing.at(1, triangle[1]),
                c = standing.at(1, triangle[2]), normal = standing.normal(1, triangle);
    const auto left_of = [&](Vec3d from, Vec3d to) {
      return dot(cross(to - from, point - from), normal) > 0;
    };
    if (!left_of(a, b) || !left_of(b, c) || !left_of(c, a)) continue;
    const double height = dot(normal, point - a);
    if (std::abs(height) <= reach) side = height > 0 ? 1 : -1;
  }
  return side;
}

double Untangler::lying(const StandingPair& standing, std::span<const CandidateTile> cells,
                        double reach) {
  const Tiling of_a(standing.grids[0]->cells()), of_b(standing.grids[1]->cells());
  int above = 0, below = 0;
  for (const CandidateTile& one : cells)
    for_pairs(one, of_a, of_b, [&](const CandidatePair& pair) {
      const int side = side_of(standing, pair, reach);
      above += side > 0 ? 1 : 0;
      below += side < 0 ? 1 : 0;
    });
  const int all = above + below;
  return all >= min_lying ? static_cast<double>(above - below) / all : 0;
}

void Untangler::add_lying(double side) {
  if (std::abs(side) < clear_majority) return;
  for (Verdict& verdict : verdicts_)
    if (!verdict.is_settled()) verdict.settled[verdict.first_side] = sign(side);
}

/// Direction of the first layer relative to the second; the one that shortens the contour where
/// nothing else is known.
Vec3d Untangler::direction(const StandingPair& standing, const ContourNode& node) const {
  const Verdict& verdict = verdicts_[node.contour];
  const Frame frame = frame_of(standing, node);
  if (verdict.is_settled())
    return normalized(verdict.settled[0] * frame.normals[1] -
                      verdict.settled[1] * frame.normals[0]);
  const std::array<Vec3d, 3> axes = frame.axes();
  return normalized(verdict.shorter.x * axes[0] + verdict.shorter.y * axes[1] +
                    verdict.shorter.z * axes[2]);
}

Vec3d Untangler::shortening(const StandingPair& standing, const ContourNode& node) {
  const auto [p, q] = node.crossing.edge;
  const Vec3d edge = standing.at(node.crossing.side, q) - standing.at(node.crossing.side, p);
  const Vec3d normal = standing.normal(node.triangle_side(standing.same), node.crossing.triangle);
  const double through = dot(edge, normal);
  if (through == 0) return {};
  const Vec3d displacement = node.onwards - (dot(edge, node.onwards) / through) * normal;
  const double max = std::max(1.0, length(displacement) / max_shortening);
  return ((node.layer == 0 ? 1 : -1) / max) * displacement;
}

void Untangler::find_ways(const StandingPair& standing, double max, double margin, Pair& pair) {
  pair.ways.clear();
  for (const ContourNode& node : pair.contours.nodes()) {
    Way displacement;
    displacement.apart = (node.layer == 0 ? 1.0 : -1.0) * direction(standing, node);
    const int other = node.triangle_side(standing.same);
    const Vec3d normal = standing.normal(other, node.crossing.triangle);
    const double slope = dot(normal, displacement.apart);
    double depth = 0;
    for (const int sample : node.crossing.edge) {
      const double height = dot(normal, standing.at(node.crossing.side, sample) - node.point);
      if (height * slope < 0) depth = std::abs(height);
    }
    displacement.amount =
        std::abs(slope) > min_slope ? std::min(max, (depth + margin) / std::abs(slope)) : max;
    if (!verdicts_[node.contour].is_settled()) displacement.weight = light;
    pair.ways.push_back(displacement);
  }
}

void Untangler::mark(const StandingPair& standing, Pair& pair) {
  pair.marks.clear(*standing.grids[0], *standing.grids[1]);
  for (const ContourNode& node : pair.contours.nodes()) {
    const int side = node.crossing.side, other = node.triangle_side(standing.same);
    for (const int s : node.crossing.edge) pair.marks.mark_layer(side, s, node.contour, node.layer);
    for (const int s : node.crossing.triangle)
      pair.marks.mark_layer(other, s, node.contour, 1 - node.layer);
  }
  for (int side = 0; side < (standing.same ? 1 : 2); ++side) {
    const int n = standing.grids[side]->size();
    const Regions& regions = regions_[side];
    wrong_regions_.assign(static_cast<std::size_t>(n) * n, 0);
    for (const ContourNode& node : pair.contours.nodes()) {
      if (node.crossing.side != side || verdicts_[node.contour].settled[node.layer] == 0) continue;
      const int p = regions.of(node.crossing.edge[0]), q = regions.of(node.crossing.edge[1]);
      if (p != q) wrong_regions_[regions.size(p) < regions.size(q) ? p : q] = 1;
    }
    for (int s = 0; s < n * n; ++s)
      if (standing.grids[side]->point(s) == s && wrong_regions_[regions.of(s)] != 0)
        pair.marks.mark_wrong(side, s);
  }
}

void Untangler::find_crossings(std::size_t a, std::size_t b, std::span<const MovingCloth> cloths,
                               std::span<const CandidateTile> cells, ThreadTeam& team) {
  Pair& looked = pair(a, b);
  const StandingPair standing{{grids_[a], grids_[b]}, {&cloths[a].start, &cloths[b].start}, a == b};
  looked.contours.find(standing, cells, team);
  looked.crossings = static_cast<int>(looked.contours.nodes().size());
  looked.open = looked.crossings > 0;
  if (!looked.open) return;
  const double gap = 0.5 * (properties_[a].self_thickness + properties_[b].self_thickness);
  find_regions(standing, looked);
  choose_directions(standing, looked);
  if (a != b) add_lying(lying(standing, cells, gap));
  const double spacing = std::min(properties_[a].rest_spacing, properties_[b].rest_spacing);
  find_ways(standing, spacing, margin_in_gaps * gap, looked);
  mark(standing, looked);
}

void Untangler::want(const ContourNode& node, const Way& displacement,
                     std::array<std::size_t, 2> of, std::span<const MovingCloth> cloths) {
  const auto& edge = node.crossing.edge;
  const auto& triangle = node.crossing.triangle;
  const MovingCloth &own = cloths[of[0]], &other = cloths[of[1]];
  const auto mean_displacement = [](const MovingCloth& cloth, const auto& samples) {
    Vec3d sum;
    for (const int s : samples)
      sum += vec_cast<double>(cloth.position.at(s)) - vec_cast<double>(cloth.start.at(s));
    return (1.0 / static_cast<double>(samples.size())) * sum;
  };
  const auto pinned = [](const MovingCloth& cloth, const auto& samples) {
    const int n = cloth.start.size();
    return std::all_of(samples.begin(), samples.end(),
                       [&](int s) { return cloth.inverse_mass(s / n, s % n) <= 0; });
  };
  const double own_part = pinned(own, edge) ? 0 : (pinned(other, triangle) ? 1 : 0.5);
  const double other_part = pinned(other, triangle) ? 0 : 1 - own_part;
  const double going =
      dot(displacement.apart, mean_displacement(own, edge) - mean_displacement(other, triangle));
  const double hold = std::max(0.0, -going);
  const double push = std::max(0.0, displacement.amount - std::max(0.0, going));
  for (const int s : edge) {
    pushes_[of[0]].want(s, (own_part * push) * displacement.apart, displacement.weight);
    holds_[of[0]].want(s, (own_part * hold) * displacement.apart, displacement.weight);
  }
  for (const int s : triangle) {
    pushes_[of[1]].want(s, (-other_part * push) * displacement.apart, displacement.weight);
    holds_[of[1]].want(s, (-other_part * hold) * displacement.apart, displacement.weight);
  }
}

void Untangler::move(std::span<const MovingCloth> cloths, double time_step) {
  if (crossings() == 0) return;
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    pushes_[i].clear(*grids_[i], push_levels);
    holds_[i].clear(*grids_[i], hold_levels);
  }
  for (std::size_t a = 0; a < grids_.size(); ++a)
    for (std::size_t b = a; b < grids_.size(); ++b) {
      const Pair& moved = pair(a, b);
      const double max = std::min(max_spacings, spacings_a_second * time_step) *
                         std::min(properties_[a].rest_spacing, properties_[b].rest_spacing);
      for (std::size_t k = 0; k < moved.ways.size() && moved.crossings > 0; ++k) {
        const ContourNode& node = moved.contours.nodes()[k];
        const bool of_b = node.crossing.side == 1;
        const bool triangle_of_b = node.triangle_side(a == b) == 1;
        want(node, {moved.ways[k].apart, std::min(max, moved.ways[k].amount), moved.ways[k].weight},
             {of_b ? b : a, triangle_of_b ? b : a}, cloths);
      }
    }
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    pushes_[i].spread(*grids_[i]);
    holds_[i].spread(*grids_[i]);
    const int n = grids_[i]->size();
    for (int s = 0; s < n * n; ++s) {
      if (grids_[i]->point(s) != s || cloths[i].inverse_mass(s / n, s % n) <= 0) continue;
      const Vec3d hold = holds_[i].at(s), whole = hold + pushes_[i].at(s);
      if (whole == Vec3d{}) continue;
      cloths[i].position.set(s, cloths[i].position.at(s) + vec_cast<float>(whole));
      const Vec3d was = vec_cast<double>(cloths[i].velocity.at(s));
      Vec3d now = was + (1 / time_step) * hold;
      const double speed = length(now), max = length(was);
      if (speed > max) now = (max / speed) * now;
      cloths[i].velocity.set(s, vec_cast<float>(now));
    }
  }
}

}  // namespace weft
