#pragma once

#include <string>
#include <vector>

namespace weft {

/// A rectangle of samples with named channels.
struct ImagePart {
  std::string name;
  int rows = 0, cols = 0;
  struct Channel {
    std::string name;
    std::vector<float> values;  ///< [rows x cols], row 0 first
  };
  std::vector<Channel> channels;
};

/// Rectangles of any sizes as one EXR file of as many parts: float32 channels, row 0 first,
/// compressed without loss. @pre no name is there twice
std::string encode_exr_parts(const std::vector<ImagePart>& parts);

/// The same as numpy's archive of arrays: NAME is [rows x cols x channels] float32, not compressed.
/// @pre as above  @throws OutputError where it is larger than 4 GB, or has
/// more arrays or longer names than its 16-bit fields can tell
std::string encode_npz_parts(const std::vector<ImagePart>& parts);

}  // namespace weft
