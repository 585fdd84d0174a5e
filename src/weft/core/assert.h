#pragma once

#include <cassert>

/// A broken invariant of this library (never bad input, which throws): aborts in builds with
/// asserts.
#define WEFT_ASSERT(condition) assert(condition)
