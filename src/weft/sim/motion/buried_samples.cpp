#include "weft/sim/motion/buried_samples.h"

#include <algorithm>

namespace weft {
namespace {

/// What is this far before a sample, in gaps, is on its outer side for certain, and as good as
/// there.
constexpr double just_outside = 0.02;

Vec3d position(const Planes3& planes, int sample) { return vec_cast<double>(planes.at(sample)); }

}  // namespace

BuriedSamples::BuriedSamples(const GeometryImage& image, const Planes3& positions, double gap)
    : positions_(positions),
      mates_(image.mates),
      triangles_(joined_triangles(image)),
      body_(image, positions),
      gap_(gap),
      normals_(static_cast<std::size_t>(positions.size()) * positions.size()) {}

/// Adds up the normals of the triangles around each sample, by their areas. They point out of the
/// larger part of the body also where its triangles face inwards.
void BuriedSamples::add_normals() {
  std::fill(normals_.begin(), normals_.end(), Vec3d());
  double volume = 0;
  for (const Triangle& t : triangles_) {
    const Vec3d a = position(positions_, t[0]),
                normal = cross(position(positions_, t[1]) - a, position(positions_, t[2]) - a);
    for (const int corner : t) normals_[corner] += normal;
    volume += dot(a, normal);
  }
  if (volume >= 0) return;
  for (Vec3d& normal : normals_) normal = -normal;
}

char BuriedSamples::mark_of(int sample) const {
  const Vec3d along = normals_[mates_.size() > 0 ? mates_.representative(sample) : sample],
              at = position(positions_, sample), out = gap_ * normalized(along);
  if (body_.holds(at + just_outside * out, out)) return 2;
  return body_.holds(at + out, out) ? 1 : 0;
}

void BuriedSamples::find(ThreadTeam& team, std::vector<char>& marks) {
  body_.follow();
  add_normals();
  marks.resize(normals_.size());
  team.run([&](Worker& worker) {
    const Range mine = worker.share(static_cast<int>(marks.size()));
    for (int s = mine.first; s < mine.last; ++s) marks[s] = mark_of(s);
  });
}

}  // namespace weft
