#include "weft/cloth/wind.h"

#include <cmath>
#include <utility>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// One corner of the triangles of a row of cells: a row of samples and a shift of columns.
struct Corner {
  ConstRow3 position, velocity;
  int shift = 0;
};

struct Air {
  Vec3f velocity;
  float drag = 0, lift = 0;  ///< times half the density
  float held_back = 0;       ///< time step over the cloth's area density [m^2 s/kg]
};

/// A third of the force on the triangles a, b, c of a row of cells.
void push_row(const Air& air, const Corner& a, const Corner& b, const Corner& c, int cells,
              Row3 third) {
  constexpr float min_squared = 1e-30F, per_corner = 1.0F / 3;
  const float strength = std::abs(air.drag) + std::abs(air.lift);
#pragma omp simd
  for (int i = 0; i < cells; ++i) {
    const int ia = i + a.shift, ib = i + b.shift, ic = i + c.shift;
    const float ux = b.position.x[ib] - a.position.x[ia], vx = c.position.x[ic] - a.position.x[ia];
    const float uy = b.position.y[ib] - a.position.y[ia], vy = c.position.y[ic] - a.position.y[ia];
    const float uz = b.position.z[ib] - a.position.z[ia], vz = c.position.z[ic] - a.position.z[ia];
    // Twice the area along the normal.
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float wx =
        air.velocity.x - per_corner * (a.velocity.x[ia] + b.velocity.x[ib] + c.velocity.x[ic]);
    const float wy =
        air.velocity.y - per_corner * (a.velocity.y[ia] + b.velocity.y[ib] + c.velocity.y[ic]);
    const float wz =
        air.velocity.z - per_corner * (a.velocity.z[ia] + b.velocity.z[ib] + c.velocity.z[ic]);
    const float squared_area = nx * nx + ny * ny + nz * nz,
                squared_speed = wx * wx + wy * wy + wz * wz;
    const float area = std::sqrt(squared_area > min_squared ? squared_area : min_squared);
    const float speed = std::sqrt(squared_speed > min_squared ? squared_speed : min_squared);
    const float facing = wx * nx + wy * ny + wz * nz;
    const float flow =
        0.5F * per_corner * std::abs(facing) / (1 + air.held_back * strength * speed);
    const float along = flow * (air.drag - air.lift * std::abs(facing) / (area * speed));
    const float up = flow * air.lift * (facing < 0 ? -speed : speed) / area;
    third.x[i] = along * wx + up * nx;
    third.y[i] = along * wy + up * ny;
    third.z[i] = along * wz + up * nz;
  }
}

}  // namespace

Wind::Wind(const WindOptions& options, const Cloth& cloth)
    : velocity_(vec_cast<float>(options.velocity)),
      drag_(static_cast<float>(0.5 * air_density * options.drag)),
      lift_(static_cast<float>(0.5 * air_density * options.lift)),
      cloth_(cloth),
      upper_(cloth.size + 1),
      lower_(cloth.size + 1),
      force_(cloth.size),
      rows_(cloth.mates) {}

void Wind::blow(double time_step, ClothState& state, ThreadTeam& team) {
  const auto h = static_cast<float>(time_step);
  team.run([&](Worker& worker) {
    const Range cells = worker.share(cloth_.size - 1), mine = worker.share(cloth_.size);
    for (int r = cells.first; r < cells.last; ++r) push_triangles_row(h, state, r);
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r) gather_row(r);
    worker.barrier();
    sum_over_mates(cloth_.mates, worker, {&force_.x, &force_.y, &force_.z});
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r) kick_row(h, r, state.velocity);
  });
}

void Wind::push_triangles_row(float time_step, const ClothState& state, int row) {
  const auto held_back = static_cast<float>(time_step / cloth_.material.density);
  const Air air{velocity_, drag_, lift_, held_back};
  for (const auto& [columns, rows, chart] : rows_.row(row)) {
    if (row + 1 == rows.last) continue;
    const int first = columns.first, cells = columns.last - first - 1;
    const auto corner = [&](int down, int right) {
      return Corner{row_of(state.position, row + down), row_of(state.velocity, row + down),
                    first + right};
    };
    push_row(air, corner(0, 0), corner(0, 1), corner(1, 1), cells,
             shifted(row_of(upper_, row + 1), first + 1));
    push_row(air, corner(0, 0), corner(1, 1), corner(1, 0), cells,
             shifted(row_of(lower_, row + 1), first + 1));
  }
}

void Wind::gather_row(int row) {
  const Row3 sum = row_of(force_, row);
  const ConstRow3 upper_below = row_of(std::as_const(upper_), row + 1);
  const ConstRow3 lower_below = row_of(std::as_const(lower_), row + 1);
  const ConstRow3 upper_above = row_of(std::as_const(upper_), row);
  const ConstRow3 lower_above = row_of(std::as_const(lower_), row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    sum.x[c] = (upper_below.x[c + 1] + lower_below.x[c + 1]) +
               (upper_above.x[c] + lower_above.x[c]) + (upper_below.x[c] + lower_above.x[c + 1]);
    sum.y[c] = (upper_below.y[c + 1] + lower_below.y[c + 1]) +
               (upper_above.y[c] + lower_above.y[c]) + (upper_below.y[c] + lower_above.y[c + 1]);
    sum.z[c] = (upper_below.z[c + 1] + lower_below.z[c + 1]) +
               (upper_above.z[c] + lower_above.z[c]) + (upper_below.z[c] + lower_above.z[c + 1]);
  }
}

void Wind::kick_row(float time_step, int row, Planes3& velocity) const {
  const float* inverse_mass = cloth_.inverse_mass.row(row);
  const ConstRow3 f = row_of(force_, row);
  const Row3 v = row_of(velocity, row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    const float scale = time_step * inverse_mass[c];
    v.x[c] += scale * f.x[c];
    v.y[c] += scale * f.y[c];
    v.z[c] += scale * f.z[c];
  }
}

}  // namespace weft
