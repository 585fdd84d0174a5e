#include <cmath>

#include "weft/collide/kernels/isa/body_rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Bounds of the relative rounding of places and of lengths, generously.
constexpr float of_places = 4e-7F, of_lengths = 1e-5F;

inline float size(float x, float y, float z) { return std::fabs(x) + std::fabs(y) + std::fabs(z); }
inline float length(float x, float y, float z) { return std::sqrt(dot(x, y, z, x, y, z)); }

}  // namespace

void reach_row(int n, const KnownRow& known, const ReachRow& row, float* reach) {
  const float *start_x = row.start[0], *start_y = row.start[1], *start_z = row.start[2];
  const float *end_x = row.end[0], *end_y = row.end[1], *end_z = row.end[2];
  const float *carried_x = row.carried[0], *carried_y = row.carried[1], *carried_z = row.carried[2];
  const float *along_x = row.along[0], *along_y = row.along[1], *along_z = row.along[2];
  const float *place_x = known.place[0], *place_y = known.place[1], *place_z = known.place[2];
  float *seen_x = known.seen[0], *seen_y = known.seen[1], *seen_z = known.seen[2];
  float* distance = known.distance;
  const float *travelled = row.travelled, *approach = row.approach, *past = known.travelled;
  const float margin = row.margin, farthest = row.farthest, most = row.max_approach;
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float x = start_x[c], y = start_y[c], z = start_z[c];
    const float dx = end_x[c] - x, dy = end_y[c] - y, dz = end_z[c] - z;
    const float cx = carried_x[c], cy = carried_y[c], cz = carried_z[c];
    // Where the sample moves too far for its block to tell, any part of the body may come near.
    const float whole = length(dx, dy, dz);
    const float beside = length(dx - along_x[c], dy - along_y[c], dz - along_z[c]) + approach[c];
    const float meets = whole <= farthest ? beside : whole + most;
    const float off = of_places * (size(x, y, z) + 2 * size(cx, cy, cz) + travelled[c]);
    const float wanted = (margin + meets) * (1 + of_lengths) + off;
    const float moved = length(x - seen_x[c], y - seen_y[c], z - seen_z[c]);
    const float before = distance[c];
    const float valid = moved <= farthest ? before : 0.0F;
    const float since = length(x - cx - place_x[c], y - cy - place_y[c], z - cz - place_z[c]) +
                        (travelled[c] - past[c]);
    seen_x[c] = x;
    seen_y[c] = y;
    seen_z[c] = z;
    distance[c] = valid;
    reach[c] = valid - since > wanted ? 0.0F : wanted;
  }
}

}  // namespace weft::WEFT_KERNEL_SET
