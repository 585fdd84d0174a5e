#include "weft/run/sealed_bytes.h"

#include <span>

#include <fmt/format.h>

#include "weft/core/hash.h"
#include "weft/error.h"
#include "weft/run/bytes.h"

namespace weft {
namespace {

constexpr std::string_view weft_version = WEFT_VERSION;

std::uint64_t hash_of(std::string_view bytes) {
  Hash hash;
  hash.add(std::span<const char>(bytes));
  return hash.value();
}

}  // namespace

void refuse(const Seal& kind, const std::string& where, std::string_view found) {
  throw InputError(where, found, kind.wanted);
}

std::string seal(const Seal& kind, std::string fields) {
  ByteWriter writer;
  writer.add_text(weft_version);
  const std::string version = writer.take();
  Hash hash;
  hash.add(std::span<const char>(version));
  hash.add(std::span<const char>(fields));
  writer.add_bytes(kind.magic);
  writer.add(kind.version);
  writer.add(static_cast<std::uint64_t>(version.size() + fields.size()));
  writer.add(hash.value());
  writer.add_bytes(version);
  fields.insert(0, writer.take());  // they may be long: no copy beside them
  return fields;
}

std::string_view unseal(const Seal& kind, std::string_view bytes, const std::string& where) {
  if (!bytes.starts_with(kind.magic)) refuse(kind, where, fmt::format("is no {}", kind.kind));
  ByteReader header(bytes.substr(kind.magic.size()));
  const auto version = header.next<std::uint32_t>();
  if (header.whole() && version != kind.version)
    refuse(kind, where,
           fmt::format("has {} format {} instead of {}", kind.kind, version, kind.version));
  const auto size = header.next<std::uint64_t>();
  const auto hash = header.next<std::uint64_t>();
  if (!header.whole() || size != header.left())
    refuse(kind, where,
           fmt::format("is damaged: {} bytes instead of {}", bytes.size(),
                       bytes.size() - header.left() + size));
  const std::string_view payload = bytes.substr(bytes.size() - size);
  if (hash != hash_of(payload)) refuse(kind, where, "is damaged: its bytes do not give its hash");
  ByteReader fields(payload);
  const std::string_view writer = fields.next_text();
  if (writer != weft_version)
    refuse(kind, where, fmt::format("was written by weft {}, this is {}", writer, weft_version));
  return payload.substr(payload.size() - fields.left());
}

}  // namespace weft
