#pragma once

#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "weft/material.h"
#include "weft/vec.h"

namespace weft {

/// Values that a number may take.
struct NumberRange {
  double min = -HUGE_VAL;
  double max = HUGE_VAL;
  bool min_excluded = false;
};
inline constexpr NumberRange positive{0, HUGE_VAL, true};
inline constexpr NumberRange not_negative{0, HUGE_VAL, false};

/// Location of a value, for errors: file and key path such as cloths[0].material.
struct JsonPlace {
  std::string file, path;
  [[nodiscard]] JsonPlace key(std::string_view name) const;
  [[nodiscard]] JsonPlace element(std::size_t index) const;
  /// @throws SceneError FILE:PATH: found; wanted
  [[noreturn]] void fail(std::string_view found, std::string_view wanted) const;
};

/// An object of a scene file, read key by key. Every reader throws SceneError with the full key
/// path for a wrong type or a value out of range, and returns the fallback when the key is absent.
class JsonObject {
 public:
  /// @throws SceneError when the value is no object, or has a key that is not in `keys` (naming the
  /// nearest)
  JsonObject(const nlohmann::json& value, JsonPlace place, std::span<const std::string_view> keys);

  [[nodiscard]] const JsonPlace& place() const { return place_; }
  /// Null when absent.
  [[nodiscard]] const nlohmann::json* find(std::string_view key) const;
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  [[nodiscard]] double number(std::string_view key, double fallback, NumberRange range = {}) const;
  [[nodiscard]] int integer(std::string_view key, int fallback, int min, int max) const;
  [[nodiscard]] bool boolean(std::string_view key, bool fallback) const;
  [[nodiscard]] std::string text(std::string_view key, std::string_view fallback) const;
  [[nodiscard]] Vec3d vector(std::string_view key, Vec3d fallback) const;
  /// One number >= 0 for warp and weft, or a list of both.
  [[nodiscard]] WarpWeft warp_weft(std::string_view key, WarpWeft fallback) const;

 private:
  const nlohmann::json& value_;
  JsonPlace place_;
};

/// `count` finite numbers. @throws SceneError
std::vector<double> numbers_of(const nlohmann::json& value, const JsonPlace& place,
                               std::size_t count);

}  // namespace weft
