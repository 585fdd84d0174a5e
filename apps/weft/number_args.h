#pragma once

#include <optional>
#include <string_view>

namespace CLI {
class Validator;
}

namespace weft::app {

// What options take that are no whole numbers. CLI11's own ranges let NaN through, and its check
// for positive numbers prints the largest one in 309 digits.

/// A number as it is written, all of the text; none for NaN and what is too large or too small.
std::optional<double> finite_number(std::string_view text);

/// Numbers within both bounds, which `--help` tells.
CLI::Validator number_between(double low, double high);
CLI::Validator number_above_zero();
CLI::Validator any_number();

}  // namespace weft::app
