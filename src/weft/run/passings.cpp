#include "weft/run/passings.h"

#include <algorithm>
#include <set>

#include "weft/collide/ccd.h"
#include "weft/sim/loading/insides.h"

namespace weft {
namespace {

Vec3d at(const Planes3& planes, int sample) { return vec_cast<double>(planes.at(sample)); }

Corners corners_at(const Planes3& planes, const Triangle& t) {
  return {at(planes, t[0]), at(planes, t[1]), at(planes, t[2])};
}

std::vector<Corners> all_corners(const Planes3& planes, std::span<const Triangle> triangles) {
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles) corners.push_back(corners_at(planes, t));
  return corners;
}

/// The box around two.
Box3d joined(const Box3d& a, const Box3d& b) {
  return {min(a.lower, b.lower), max(a.upper, b.upper)};
}

/// Both ends of an edge of a triangle.
std::array<int, 2> edge_of(const Triangle& t, std::size_t k) { return {t[k], t[(k + 1) % 3]}; }

VertexFace vertex_face(Vec3d vertex, const Planes3& of_face, const Triangle& face) {
  return {vertex, corners_at(of_face, face)};
}
EdgeEdge edge_edge(const Planes3& first, const std::array<int, 2>& p, const Planes3& second,
                   const std::array<int, 2>& q) {
  return {{at(first, p[0]), at(first, p[1])}, {at(second, q[0]), at(second, q[1])}};
}

}  // namespace

/// State of a traversal of two trees.
struct PassingSurface::Pairs {
  bool same = false;
  std::int64_t count = 0;
};

PassingSurface::PassingSurface(const GeometryImage& image, const Planes3& start,
                               const BorderMates* sewn)
    : triangles_(joined_triangles(image)),
      tree_(all_corners(start, triangles_)),
      boxes_(tree_.nodes.size()),
      swept_boxes_(triangles_.size()),
      sample_boxes_(start.size() * start.size()) {
  const int samples = image.size() * image.size();
  for (int v = 0; v < samples; ++v) joint_.push_back(sewn != nullptr ? sewn->representative(v) : v);
  own_features();
  follow({&start, &start});
}

void PassingSurface::own_features() {
  std::set<int> vertices;
  std::set<std::pair<int, int>> edges;
  owned_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [p, q] = edge_of(triangles_[t], k);
      if (vertices.insert(p).second) owned_[t].vertices |= static_cast<unsigned char>(1U << k);
      if (edges.insert({std::min(p, q), std::max(p, q)}).second)
        owned_[t].edges |= static_cast<unsigned char>(1U << k);
    }
}

void PassingSurface::follow(const StepMotion::Path& step) {
  const bool stands = step.start == step.end && step_.start == step.start && step_.end == step.end;
  step_ = step;
  if (stands) return;  // in both steps: all boxes hold
  for (std::size_t v = 0; v < sample_boxes_.size(); ++v) {
    const int sample = static_cast<int>(v);
    const Vec3d from = at(*step.start, sample), to = at(*step.end, sample);
    sample_boxes_[v] = {min(from, to), max(from, to)};
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    swept_boxes_[t] = joined(joined(sample_boxes_[a], sample_boxes_[b]), sample_boxes_[c]);
  }
  fit_nodes();
}

void PassingSurface::fit_nodes() {
  for (std::size_t i = boxes_.size(); i-- > 0;) {
    const BoxTree::Node& node = tree_.nodes[i];
    if (node.right >= 0) {
      boxes_[i] = joined(boxes_[i + 1], boxes_[static_cast<std::size_t>(node.right)]);
      continue;
    }
    boxes_[i] = {};
    for (int place = node.first; place < node.last; ++place)
      boxes_[i] =
          joined(boxes_[i], swept_boxes_[static_cast<std::size_t>(tree_.triangle_at[place])]);
  }
}

std::int64_t PassingSurface::count_vertices(int s, const PassingSurface& other, int t,
                                            bool same) const {
  std::int64_t count = 0;
  const Triangle &own = triangles_[s], &face = other.triangles_[t];
  for (std::size_t k = 0; k < 3; ++k) {
    const int v = own[k];
    if ((owned_[s].vertices >> k & 1U) == 0 || (same && touches(face, v))) continue;
    if (!overlap(sample_boxes_[v], other.swept_boxes_[t])) continue;
    const auto hit = time_of_impact(vertex_face(at(*step_.start, v), *other.step_.start, face),
                                    vertex_face(at(*step_.end, v), *other.step_.end, face));
    count += hit ? 1 : 0;
  }
  return count;
}

std::int64_t PassingSurface::count_between(int s, const PassingSurface& other, int t,
                                           bool same) const {
  std::int64_t count = count_vertices(s, other, t, same) + other.count_vertices(t, *this, s, same);
  const Triangle &a = triangles_[s], &b = other.triangles_[t];
  for (std::size_t i = 0; i < 3; ++i) {
    if ((owned_[s].edges >> i & 1U) == 0) continue;
    const std::array<int, 2> p = edge_of(a, i);
    const Box3d way = swept_edge(p);
    if (!overlap(way, other.swept_boxes_[t])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<int, 2> q = edge_of(b, k);
      if ((other.owned_[t].edges >> k & 1U) == 0 || !overlap(way, other.swept_edge(q))) continue;
      if (same && (meet(p[0], q[0]) || meet(p[0], q[1]) || meet(p[1], q[0]) || meet(p[1], q[1])))
        continue;
      const auto hit = time_of_impact(edge_edge(*step_.start, p, *other.step_.start, q),
                                      edge_edge(*step_.end, p, *other.step_.end, q));
      count += hit ? 1 : 0;
    }
  }
  return count;
}

Box3d PassingSurface::swept_edge(const std::array<int, 2>& ends) const {
  return joined(sample_boxes_[ends[0]], sample_boxes_[ends[1]]);
}

/// Traverses both trees, or one with itself; each pair of triangles is tested once.
void PassingSurface::find(int node, const PassingSurface& other, int other_node,
                          Pairs& pairs) const {
  if (!overlap(boxes_[static_cast<std::size_t>(node)],
               other.boxes_[static_cast<std::size_t>(other_node)]))
    return;
  const BoxTree::Node& a = tree_.nodes[static_cast<std::size_t>(node)];
  const BoxTree::Node& b = other.tree_.nodes[static_cast<std::size_t>(other_node)];
  if (pairs.same && node == other_node && a.right >= 0) {
    find(node + 1, other, node + 1, pairs);
    find(a.right, other, a.right, pairs);
    return find(node + 1, other, a.right, pairs);
  }
  const bool split_b = a.right < 0 || (b.right >= 0 && b.last - b.first > a.last - a.first);
  if (split_b && b.right >= 0) {
    find(node, other, other_node + 1, pairs);
    return find(node, other, b.right, pairs);
  }
  if (a.right >= 0) {
    find(node + 1, other, other_node, pairs);
    return find(a.right, other, other_node, pairs);
  }
  for (int i = a.first; i < a.last; ++i)
    for (int k = pairs.same && node == other_node ? i + 1 : b.first; k < b.last; ++k) {
      const int s = tree_.triangle_at[i], t = other.tree_.triangle_at[k];
      if (overlap(swept_boxes_[s], other.swept_boxes_[t]) && !other.is_buried(other.triangles_[t]))
        pairs.count += count_between(s, other, t, pairs.same);
    }
}

std::int64_t PassingSurface::count(const PassingSurface& other) const {
  Pairs pairs;
  if (!triangles_.empty() && !other.triangles_.empty()) find(0, other, 0, pairs);
  return pairs.count;
}

std::int64_t PassingSurface::count_self() const {
  Pairs pairs{true, 0};
  if (!triangles_.empty()) find(0, *this, 0, pairs);
  return pairs.count;
}

std::int64_t PassingSurface::count_below(double height) const {
  std::int64_t count = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = triangles_[t][k];
      if ((owned_[t].vertices >> k & 1U) != 0 && step_.start->at(v).y >= height &&
          step_.end->at(v).y < height)
        ++count;
    }
  return count;
}

PassingCheck::PassingCheck(std::span<const Surface> cloths, std::span<const Surface> bodies,
                           std::optional<double> ground)
    : ground_(ground) {
  for (const Surface& of : cloths) cloths_.emplace_back(*of.image, *of.positions, of.sewn);
  for (const Surface& of : bodies) {
    bodies_.emplace_back(*of.image, *of.positions, of.sewn);
    if (of.buried != nullptr) bodies_.back().leave_out(*of.buried);
  }
}

std::int64_t PassingCheck::count(const StepMotion& step) {
  for (std::size_t i = 0; i < cloths_.size(); ++i) cloths_[i].follow(step.cloths[i]);
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].follow(step.bodies[i]);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    count += cloths_[i].count_self();
    for (std::size_t j = 0; j < i; ++j) count += cloths_[i].count(cloths_[j]);
    for (const PassingSurface& body : bodies_) count += cloths_[i].count(body);
    if (ground_) count += cloths_[i].count_below(*ground_);
  }
  return count;
}

}  // namespace weft
