#include "weft/cloth/kernels/isa/rows.h"
#include "weft/cloth/kernels/isa/spring_law.h"

// Springs linearised, and their energies: near ones of all directions at once, far ones direction
// by direction.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Number of lanes in which energies are summed, whatever the vector's width.
constexpr int lanes = 16;

using Three = Vector<Pack>;

[[gnu::always_inline]] inline Three difference(ConstRow3 from, ConstRow3 to, int c, int shift) {
  const Pack3 a = load(from, c), b = load(to, c + shift);
  return {b.x - a.x, b.y - a.y, b.z - a.z};
}

/// The columns from c on of the springs of a direction, whose other ends are `shift` columns to the
/// right in the same row or the one below.
struct NearDirection {
  int direction, shift;
  bool below, limited;
};
constexpr NearDirection directions[near_directions] = {
    {0, 0 + 1, false, true}, {1, 0, true, true}, {2, 1, true, false}, {3, -1, true, false}};

[[gnu::always_inline]] inline Three apart(const RowPair& rows, const NearDirection& to, int c) {
  return difference(rows.here, to.below ? rows.below : rows.here, c, to.shift);
}

[[gnu::always_inline]] inline SpringTerms<Pack> terms_of(const NearSprings& springs,
                                                         const NearDirection& to, int c) {
  const PlaneRows all = springs.constants;
  const float* first = all.first + to.direction * spring_constants * all.pitch + c;
  const Pack none{};
  return {load(first), load(first + all.pitch), load(first + 2 * all.pitch), none + springs.limit,
          none + (to.limited ? springs.limit_factor : 0)};
}

[[gnu::always_inline]] inline Pack3 linearise_direction(const NearSprings& springs,
                                                        const NearDirection& to, int c,
                                                        MutablePlaneRows out) {
  const Three x = apart(springs.position, to, c);
  const SpringHessianTerms<Pack> terms = linearise_spring<Pack>(
      terms_of(springs, to, c), {x, apart(springs.speed, to, c), apart(springs.start, to, c)},
      springs.per_step, springs.guessed_share);
  float* first = out.first + to.direction * spring_entries * out.pitch + c;
  store(terms.across, first);
  store(terms.along.x, first + out.pitch);
  store(terms.along.y, first + 2 * out.pitch);
  store(terms.along.z, first + 3 * out.pitch);
  return terms.force * Pack3{x.x, x.y, x.z};
}

template <class T>
[[gnu::always_inline]] inline Vector<T> vector_at(ConstRow3 from, ConstRow3 to, int c) {
  return {to.x[c] - from.x[c], to.y[c] - from.y[c], to.z[c] - from.z[c]};
}

}  // namespace

void linearise(int n, const NearSprings& springs, const InertiaRow& inertia,
               MutablePlaneRows hessian, const Passing& passing, Row3 force) {
  const Pack3 none{};
  const Pack3 gained{none.x + inertia.gained[0], none.x + inertia.gained[1],
                     none.x + inertia.gained[2]};
  Pack3 right_before = none, diagonal_before = none, left_before = none, pending = none;
  for (int c = 0; c < n; c += width) {
    const Pack3 right = linearise_direction(springs, directions[0], c, hessian),
                down = linearise_direction(springs, directions[1], c, hessian),
                diagonal = linearise_direction(springs, directions[2], c, hessian),
                left = linearise_direction(springs, directions[3], c, hessian);
    const Pack3 held =
        load(inertia.mass + c) * (load(inertia.speed, c) - load(inertia.start, c) - gained);
    const Pack3 pulled = (right + down) + (diagonal + left) - to_the_left(right_before, right);
    store(pulled + load(passing.carried, c) - held, force, c);
    // What the springs to the row below pull it by, once all three that end in a column are known.
    if (c > 0) store(none - (pending + to_the_right(left_before, left)), passing.carry, c - width);
    pending = down + to_the_left(diagonal_before, diagonal);
    right_before = right;
    diagonal_before = diagonal;
    left_before = left;
  }
  store(none - (pending + to_the_right(left_before, none)), passing.carry, n - width);
}

double near_energy(int n, const NearSprings& springs) {
  alignas(64) Pack sums[lanes / width] = {};
  for (int c = 0; c < n; c += lanes)
    for (int p = 0; p < lanes / width; ++p)
      for (const NearDirection& to : directions)
        sums[p] += spring_energy_of<Pack>(
            terms_of(springs, to, c + p * width), apart(springs.position, to, c + p * width),
            springs.step > 0 ? apart(springs.speed, to, c + p * width) : Three{}, springs.step);
  double sum = 0;
  for (const Pack& pack : sums)
    for (int i = 0; i < width; ++i) sum += double{pack[i]};
  return sum;
}

void linearise_far(int n, const LinearisedSprings& in, SpringHessianRow out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const SpringHessianTerms<float> terms = linearise_spring<float>(
        {in.rest_length[c], in.stiffness[c], in.damping[c], in.limit, in.limit_factor},
        {vector_at<float>(in.here, in.there, c), vector_at<float>(in.speed_here, in.speed_there, c),
         vector_at<float>(in.start_here, in.start_there, c)},
        in.per_step, in.guessed_share);
    out.f[c] = terms.force;
    out.t[c] = terms.across;
    out.x[c] = terms.along.x;
    out.y[c] = terms.along.y;
    out.z[c] = terms.along.z;
  }
}

double far_energy(int n, const LinearisedSprings& in) {
  const auto energy = [&](int c) __attribute__((always_inline)) {
    return spring_energy_of<float>(
        {in.rest_length[c], in.stiffness[c], in.damping[c], in.limit, in.limit_factor},
        vector_at<float>(in.here, in.there, c), vector_at<float>(in.speed_here, in.speed_there, c),
        in.step);
  };
  alignas(64) float sums[lanes] = {};
  int c = 0;
  for (; c + lanes <= n; c += lanes)
#pragma omp simd
    for (int lane = 0; lane < lanes; ++lane) sums[lane] += energy(c + lane);
  for (int lane = 0; c < n; ++c, ++lane) sums[lane] += energy(c);
  double sum = 0;
  for (const float lane : sums) sum += double{lane};
  return sum;
}

}  // namespace weft::WEFT_KERNEL_SET
