#pragma once

#include <string>
#include <utility>
#include <vector>

#include <zlib.h>

namespace weft::test {

/// A number as it lies in a little-endian file, in any number of bytes.
inline std::string little_endian(std::uint64_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i, value >>= 8) bytes.push_back(static_cast<char>(value));
  return bytes;
}

/// An array in numpy's format. @param shape  as Python writes it, for example "(2, 1, 3)"
inline std::string npy(const std::string& type, const std::string& shape, const std::string& body,
                       bool fortran_order = false) {
  std::string header = "{'descr': '" + type +
                       "', 'fortran_order': " + (fortran_order ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 11, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01\0", 8) + little_endian(header.size(), 2) + header + body;
}

/// A raw deflate stream.
inline std::string deflated(const std::string& bytes) {
  std::string out(bytes.size() + 100, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

struct ZipOptions {
  bool deflate = false;
  bool wide = false;            ///< sizes in a 64-bit extra field, and the 64-bit end records
  std::uint64_t told_size = 0;  ///< in place of the true one, unless 0
  unsigned method = 0;          ///< in place of the true one, unless 0
  unsigned flags = 0;
};

/// A zip archive of files and their names.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files,
                       const ZipOptions& options = {}) {
  std::string archive, directory;
  for (const auto& [name, bytes] : files) {
    const std::string data = options.deflate ? deflated(bytes) : bytes;
    const std::uint64_t size = options.told_size ? options.told_size : bytes.size();
    const unsigned method = options.method ? options.method : options.deflate ? 8 : 0;
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
    const auto head = [&](bool wide) {
      return little_endian(options.flags, 2) + little_endian(method, 2) + little_endian(0, 4) +
             little_endian(sum, 4) + little_endian(wide ? 0xffffffff : data.size(), 4) +
             little_endian(wide ? 0xffffffff : size, 4) + little_endian(name.size(), 2);
    };
    std::string extra;
    if (options.wide)
      extra = little_endian(1, 2) + little_endian(16, 2) + little_endian(size, 8) +
              little_endian(data.size(), 8);
    directory += "PK\1\2" + little_endian(45, 4) + head(options.wide) +
                 little_endian(extra.size(), 2) + little_endian(0, 10) +
                 little_endian(archive.size(), 4) + name + extra;
    archive += "PK\3\4" + little_endian(45, 2) + head(false) + little_endian(0, 2) + name + data;
  }
  const std::size_t at = archive.size();
  archive += directory;
  const std::size_t wide_end = archive.size();
  if (options.wide)
    archive += "PK\6\6" + little_endian(44, 8) + little_endian(45, 4) + little_endian(0, 8) +
               little_endian(files.size(), 8) + little_endian(files.size(), 8) +
               little_endian(directory.size(), 8) + little_endian(at, 8) + "PK\6\7" +
               little_endian(0, 4) + little_endian(wide_end, 8) + little_endian(1, 4);
  return archive + "PK\5\6" + little_endian(0, 4) + little_endian(files.size(), 2) +
         little_endian(options.wide ? 0xffff : files.size(), 2) +
         little_endian(options.wide ? 0xffffffff : directory.size(), 4) +
         little_endian(options.wide ? 0xffffffff : at, 4) + little_endian(0, 2);
}

}  // namespace weft::test
