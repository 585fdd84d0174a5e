#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "weft/geometry_image.h"

namespace weft {

/// Key of the metadata in a file: an EXR string attribute, a PNG iTXt keyword.
inline constexpr const char* metadata_key = "weft";
/// What this library writes and reads: images of one chart have version 1, those of several 2.
inline constexpr int single_chart_version = 1, charts_version = 2;

/// All of a geometry image but its samples, as one line of JSON: version, size, mates as
/// [first, mate, count], of turned runs [first, mate, count, 1], of version 2 charts as
/// {name, row, col, rows, cols}, lower and scale (digits that give the same doubles back), source,
/// source_hash, and a checksum over these and over the samples as they are stored.
std::string metadata_text(const GeometryImage& image);

/// The samples as files hold them: those of no chart are black.
Planes3 stored_samples(const GeometryImage& image);

/// The mates that metadata tell. @throws InputError
BorderMates mates_in(std::string_view text, int size, std::string_view where);

/// Puts samples and metadata together again and checks all of it: size and version, world map,
/// mates in range and bit-equal, samples in [0, 1], the checksum where there is one (other programs
/// may leave it out).
/// @param where  what errors call the file
/// @throws InputError
GeometryImage assemble_image(Planes3 cube, std::string_view text, std::string_view where);

/// @throws InputError when a picture has no size that a geometry image may have
void require_image_size(std::int64_t width, std::int64_t height, std::string_view where);

/// Refuses a file too small to hold a picture of the size in its header, before memory is
/// allocated.
/// @throws InputError
void require_enough_bytes(int side, std::size_t bytes_per_sample, std::size_t file_size,
                          std::string_view where);

}  // namespace weft
