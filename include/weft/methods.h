#pragma once

#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace weft {

// A method, an integrator or a collider, is a struct of its options, and all methods of a kind are
// the alternatives of a variant. A method has its name, its traits, and each of its options by
// the key that scene files have for it:
//
//   struct NewtonOptions {
//     double tolerance = 0.1;
//     static constexpr std::string_view name = "newton";
//     static constexpr IntegratorTraits traits{...};
//     template <class Visit>
//     static void visit_options(const Visit& visit) {
//       visit("tolerance", &NewtonOptions::tolerance, OptionRange{...});
//     }
//   };
//
// Code that lists, reads, writes or makes methods uses these members and names no method.

/// Range of an option's values.
struct OptionRange {
  double min = -HUGE_VAL, max = HUGE_VAL;
  bool above_min = false;  ///< min itself is excluded
  bool odd = false;
};

/// The methods of a variant.
template <class Variant>
struct Methods;
template <class... Options>
struct Methods<std::variant<Options...>> {
  using Variant = std::variant<Options...>;
  /// The names in the variant's order, the default first.
  static std::vector<std::string_view> names() { return {Options::name...}; }
  /// The method of that name, with default options; nothing for an unknown name.
  static std::optional<Variant> find(std::string_view name) {
    std::optional<Variant> found;
    ((Options::name == name ? void(found = Options{}) : void()), ...);
    return found;
  }
  static std::string_view name_of(const Variant& method) {
    return std::visit([](const auto& options) { return std::decay_t<decltype(options)>::name; },
                      method);
  }
  static auto traits_of(const Variant& method) {
    return std::visit([](const auto& options) { return std::decay_t<decltype(options)>::traits; },
                      method);
  }
};

}  // namespace weft
