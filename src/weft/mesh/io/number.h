#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace weft {

/// The whole field as a number, correctly rounded and whatever the locale; nothing when it is not
/// one. Too large a number becomes infinite, too small a one zero. "nan" and "inf" are numbers
/// here.
std::optional<double> to_number(std::string_view field);

/// The whole field as a decimal integer; nothing when it is not one or does not fit.
std::optional<std::int64_t> to_integer(std::string_view field);

/// What is wrong with a coordinate, in words, or empty: it must be finite and at most 1e30 in size,
/// so that areas and volumes computed from it stay finite.
std::string_view coordinate_fault(double value);

}  // namespace weft
