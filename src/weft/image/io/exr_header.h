#pragma once

#include <string_view>

namespace weft {

/// Checks the header of an EXR file before OpenEXR reads it, because OpenEXR allocates memory for
/// any sizes in a header: the file must be a plain scan-line picture without loss, each attribute
/// must lie inside the file and have the size of its type, and the data window must be a geometry
/// image's.
/// @param bytes  the whole file
/// @param where  what errors call it
/// @throws InputError
void check_exr_header(std::string_view bytes, std::string_view where);

}  // namespace weft
