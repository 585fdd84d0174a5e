#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/isa/rows.h"

// The start of a step and the guess that it is solved from.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Whether any lane differs.
[[gnu::always_inline]] inline bool differ(const Pack3& a, const Pack3& b, int count) {
  const auto apart = (a.x != b.x) | (a.y != b.y) | (a.z != b.z);
  int any = 0;
  for (int i = 0; i < width; ++i) any |= i < count ? static_cast<int>(apart[i]) : 0;
  return any != 0;
}

/// The velocity that leads from start to guess.
[[gnu::always_inline]] inline Pack followed(Pack start, Pack guess, Pack velocity, Pack time_step,
                                            Pack per_step) {
  const Pack straight = start + time_step * velocity;
  return guess != straight ? per_step * (guess - start) : velocity;
}

}  // namespace

bool begin_step(const StepStartRow& in, const StepGuessRow& out) {
  const Pack time_step = Pack{} + in.time_step;
  bool same = true;
  for (int c = 0; c < in.count; c += width) {
    const int count = in.count - c;
    const Pack3 x = load(in.position, c), v = load(in.velocity, c);
    same = same && !differ(x, load(in.known, c), count);
    const Pack3 gained =
        in.velocity_before.x == nullptr ? Pack3{} : v - load(in.velocity_before, c);
    store_first(count, gained, out.gained, c);
    store_first(count, x, out.start, c);
    store_first(count, v, out.start_velocity, c);
    store_first(count, x + time_step * v, out.position, c);
    store_first(count, v, out.velocity, c);
  }
  return same;
}

void follow_guess(const GuessRow& guess, Row3 position, Row3 velocity) {
  const Pack time_step = Pack{} + guess.time_step, per_step = Pack{} + 1 / guess.time_step;
  for (int c = 0; c < guess.count; c += width) {
    const int count = guess.count - c;
    const Pack3 x0 = load(guess.start, c), x = load(guess.position, c), v = load(guess.velocity, c);
    store_first(count, x, position, c);
    store_first(count,
                {followed(x0.x, x.x, v.x, time_step, per_step),
                 followed(x0.y, x.y, v.y, time_step, per_step),
                 followed(x0.z, x.z, v.z, time_step, per_step)},
                velocity, c);
  }
}

}  // namespace weft::WEFT_KERNEL_SET
