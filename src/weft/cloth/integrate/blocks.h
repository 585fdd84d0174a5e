#pragma once

namespace weft {

/// A symmetric matrix by its upper triangle.
struct Symmetric3 {
  float xx, xy, xz, yy, yz, zz;
};

/// The inverse by cofactors, scaled to a trace of 1 meanwhile: cubes of masses of a milligram would
/// fall out of single precision.
inline Symmetric3 inverse(const Symmetric3& m) {
  const float scale = 1 / (m.xx + m.yy + m.zz);
  const float a = m.xx * scale, b = m.xy * scale, d = m.xz * scale;
  const float e = m.yy * scale, f = m.yz * scale, g = m.zz * scale;
  const float c0 = e * g - f * f, c1 = d * f - b * g, c2 = b * f - d * e;
  const float factor = scale / (a * c0 + b * c1 + d * c2);
  return {factor * c0,
          factor * c1,
          factor * c2,
          factor * (a * g - d * d),
          factor * (b * d - a * f),
          factor * (a * e - b * b)};
}

}  // namespace weft
