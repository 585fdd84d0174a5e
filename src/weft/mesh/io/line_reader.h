#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// The whole field as a number, correctly rounded and whatever the locale; nothing when it is not
/// one. Too large a number becomes infinite, too small a one zero. "nan" and "inf" are numbers
/// here.
std::optional<double> to_number(std::string_view field);

/// The whole field as a decimal integer; nothing when it is not one or does not fit.
std::optional<std::int64_t> to_integer(std::string_view field);

/// Describes the fault of a coordinate, or empty: it must be finite and at most 1e30 in size, so
/// that areas and volumes computed from it stay finite.
std::string_view coordinate_fault(double value);

/// Walks the lines of a text file and the blank-separated fields of a line, and throws InputErrors
/// that name FILE:LINE. Lines end in \n, \r\n or \r; a field that begins with # ends its line.
class LineReader {
 public:
  /// @param bytes  the file, kept as a view
  /// @param name   what errors call it, kept as a view
  LineReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  /// Goes to the next line; false after the last.
  bool next_line();
  /// Goes to the next line that has a field; false when there is none.
  bool next_filled_line();
  /// Whether the line has a further field.
  [[nodiscard]] bool has_field() const;
  /// The next field of the line; empty at its end.
  std::string_view next_field();
  /// The rest of the line as one name, its blanks between words made single.
  std::string rest_as_name();
  /// Everything behind the current line and its end.
  [[nodiscard]] std::string_view remaining() const { return bytes_.substr(position_); }

  /// The next field as a finite coordinate. @throws InputError
  double coordinate();
  /// The next field as an integer in [min, max]. @param what  names it in errors @throws
  /// InputError
  std::int64_t integer(std::string_view what, std::int64_t min, std::int64_t max);

  [[nodiscard]] int line_number() const { return number_; }
  /// @throws InputError at the current line
  [[noreturn]] void fail(std::string_view found, std::string_view wanted) const;

 private:
  std::string_view bytes_, name_;
  std::string_view line_;
  std::size_t position_ = 0;
  int number_ = 0;
};

/// A piece of a file as errors may show it: in quotes, short, only printable ASCII.
std::string in_quotes(std::string_view text);

/// Names as errors list them: each in quotes; of many the first twelve, and how many more there
/// are.
std::string quoted_list(const std::vector<std::string>& names);

/// A file's text without the byte-order mark that some programs put before it. UTF-16, which only
/// its mark tells from other bytes, becomes ASCII with a ? for every other character: such stand in
/// names and comments alone, which no reader of text keeps.
/// @param decoded  holds what was UTF-16; must live as long as the result, a view
std::string_view plain_text(std::string_view bytes, std::string& decoded);

}  // namespace weft
