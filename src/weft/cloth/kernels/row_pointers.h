#pragma once

// No functions here: sources that are compiled for several instruction sets include this, and an
// inline function of theirs might be linked into code for another processor.

namespace weft {

/// The three rows of a vector field.
struct ConstRow3 {
  const float *x, *y, *z;
};
struct Row3 {
  float *x, *y, *z;
};

}  // namespace weft
