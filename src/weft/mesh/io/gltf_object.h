#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace weft {

/// An object of a glTF file's JSON with its path in the file. A value of a wrong type or out of
/// range throws an InputError with that path: ignoring it could lose a part of a mesh unnoticed.
class GltfObject {
 public:
  /// @param name   what errors call the file, kept as a view
  /// @param place  such as nodes[3]; empty for the whole
  /// @throws InputError when the value is no object
  GltfObject(const nlohmann::json& value, std::string_view name, std::string place);

  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  /// A whole number in [least, most]; nothing when the key is absent.
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, std::int64_t least,
                                                    std::int64_t most) const;
  /// A whole number in [least, most] under a required key.
  [[nodiscard]] std::int64_t wanted(std::string_view key, std::int64_t least,
                                    std::int64_t most) const;
  /// An index into one of the file's lists, of `count` elements; nothing when the key is absent.
  [[nodiscard]] std::optional<int> index(std::string_view key, std::size_t count) const;
  [[nodiscard]] bool boolean(std::string_view key) const;  ///< false when absent
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
  /// A finite number; nothing when the key is absent.
  [[nodiscard]] std::optional<double> number(std::string_view key) const;
  /// Finite numbers, `count` of them; empty when the key is absent.
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t count) const;
  /// Indices into another list, of `count` elements; empty when the key is absent.
  [[nodiscard]] std::vector<int> indices(std::string_view key, std::size_t count) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
  /// An object under a key; nothing when it is absent.
  [[nodiscard]] std::optional<GltfObject> object(std::string_view key) const;
  /// How many elements the list under a key has; 0 when it is absent.
  [[nodiscard]] std::size_t count(std::string_view key) const;
  /// @pre index < count(key)
  [[nodiscard]] GltfObject element(std::string_view key, std::size_t index) const;

  [[noreturn]] void fail(std::string_view found, std::string_view wanted) const;

 private:
  [[nodiscard]] const nlohmann::json* find(std::string_view key) const;
  [[nodiscard]] const nlohmann::json* list(std::string_view key) const;
  [[nodiscard]] std::string place_of(std::string_view key) const;
  [[noreturn]] void fail_at(std::string_view key, std::string_view wanted) const;

  const nlohmann::json* value_;
  std::string_view name_;
  std::string place_;
};

}  // namespace weft
