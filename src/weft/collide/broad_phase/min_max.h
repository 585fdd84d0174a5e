#pragma once

// By value, unlike those of the standard library, so that loops over them become vector code.

namespace weft {

inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }

}  // namespace weft
