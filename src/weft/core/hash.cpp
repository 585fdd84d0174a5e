#include "weft/core/hash.h"

#include <fmt/format.h>

namespace weft {

std::string Hash::text() const { return fmt::format("{:016x}", value_); }

}  // namespace weft
