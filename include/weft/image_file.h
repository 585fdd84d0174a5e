#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "weft/geometry_image.h"

namespace weft {

/// Writes a geometry image by the ending of the name: .exr (float32, the same bits when read back)
/// or .png (16 bits a channel: positions are rounded to 1 / 65535 of the cube's side), or .weft
/// (compressed, in 4095 steps). Mates, world
/// map and source travel inside; EXR keeps colours, too, as half floats. @throws OutputError;
/// UsageError on another ending
void write_image(const std::filesystem::path& path, const GeometryImage& image);

/// The same files in memory.
std::string exr_bytes(const GeometryImage& image);
std::string png_bytes(const GeometryImage& image);

/// The finest steps of compressed images.
inline constexpr int largest_step_count = 65535;

/// An image whose positions are whole multiples of a step: the unit cube's side has so many. No
/// sample moves by more than half a step along each axis; mates stay equal.
/// @param steps  1 .. largest_step_count
GeometryImage quantised(const GeometryImage& image, int steps);
/// The number of steps that keeps every sample within a distance of its place.
/// @param error  [m]  @return nothing where largest_step_count does not do
std::optional<int> steps_for_error(const GeometryImage& image, double error);

/// Writes a compressed image (.weft): the samples of `quantised`, which reading gives back bit for
/// bit, and colours in 255 steps of sRGB. @throws OutputError; UsageError on another ending
void write_compressed_image(const std::filesystem::path& path, const GeometryImage& image,
                            int steps);
std::string compressed_bytes(const GeometryImage& image, int steps);

/// Reads a geometry image, whose format follows from the content. All of it is checked.
/// @throws InputError for what is not a geometry image, cut short, of a wrong size or version,
///         mates out of range or unequal, or not finite
GeometryImage read_image(const std::filesystem::path& path);

/// Reads a geometry image from memory; `where` is what errors call it.
GeometryImage parse_image(std::string_view bytes, std::string_view where);

/// A normal map as an 8-bit PNG (n * 127.5 + 127.5) or float EXR, by the ending of the name, for
/// other programs. @throws OutputError; UsageError on another ending
void write_normal_map(const std::filesystem::path& path, const NormalMap& normals);

/// Colours as an 8-bit sRGB PNG, for other programs. @param colours  linear RGB in [0, 1]
/// @throws OutputError
void write_colours(const std::filesystem::path& path, const Planes3& colours);

/// Texture coordinates as a float EXR, R = u, G = v, B = 0. @throws OutputError
void write_texture(const std::filesystem::path& path, const Planes3& texture);

}  // namespace weft
