#include "weft/error.h"

namespace weft {
namespace {

std::string one_line(std::string_view where, std::string_view found, std::string_view wanted) {
  std::string line;
  if (!where.empty()) line.append(where).append(": ");
  line.append(found);
  if (!wanted.empty()) line.append("; ").append(wanted);
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  return line;
}

}  // namespace

Error::Error(ExitCode code, std::string_view where, std::string_view found, std::string_view wanted)
    : std::runtime_error(one_line(where, found, wanted)),
      code_(code),
      parts_(std::make_shared<const Parts>(
          Parts{std::string(where), std::string(found), std::string(wanted)})) {}

}  // namespace weft
