#pragma once

namespace weft {

/// Four numbers that are computed with at once. All processors that Weft runs on have such
/// registers.
using Four = float __attribute__((vector_size(16)));

/// A 4 x 4 matrix, by rows, becomes its transpose. Always inlined: sources that are compiled for
/// several instruction sets include this, and must not share one copy.
__attribute__((always_inline)) inline void transpose(Four* m) {
  const Four a = __builtin_shufflevector(m[0], m[1], 0, 4, 1, 5),
             b = __builtin_shufflevector(m[0], m[1], 2, 6, 3, 7),
             c = __builtin_shufflevector(m[2], m[3], 0, 4, 1, 5),
             d = __builtin_shufflevector(m[2], m[3], 2, 6, 3, 7);
  m[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  m[1] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  m[2] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  m[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

}  // namespace weft
