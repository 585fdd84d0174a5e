#include <cstdint>
#include <ostream>

#include "weft/files.h"
#include "weft/run/export/bytes_out.h"
#include "weft/run/export/motion_files.h"

namespace weft {

void write_mdd(const std::filesystem::path& path, const FinishedMotion& motion) {
  write_file(path, [&](std::ostream& out) {
    std::string bytes;
    append_big_endian(bytes, std::int32_t{motion.frames});
    append_big_endian(bytes, std::int32_t{motion.surface->vertices()});
    for (int frame = 0; frame < motion.frames; ++frame)
      append_big_endian(bytes, static_cast<float>(frame / motion.frame_rate));
    for (int frame = 0; frame < motion.frames; ++frame) {
      for (const Vec3f p : motion.points(frame))
        for (const float x : {p.x, p.y, p.z}) append_big_endian(bytes, x);
      out << bytes;
      bytes.clear();
    }
  });
}

}  // namespace weft
