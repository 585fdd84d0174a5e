// Turns a mesh into a geometry image and back: convert MESH IMAGE.exr
#include "weft/convert.h"

#include <cstdio>
#include <exception>

#include "weft/geometry_image.h"
#include "weft/image_file.h"

namespace {

void run(const char* mesh, const char* image) {
  weft::ConvertOptions options;
  options.size = 33;
  const weft::Conversion made = weft::convert_mesh(weft::load_mesh(mesh), mesh, options);
  std::printf("converted: %.1f dB, Euler number %d, stretch %.3f\n", made.quality.psnr_db,
              made.quality.euler, made.map_quality.stretch_l2);
  weft::write_image(image, made.image);
  const weft::RebuiltMesh again = weft::rebuild_mesh(weft::read_image(image));
  std::printf("rebuilt: %zu vertices, %zu triangles\n", again.mesh.positions.size(),
              again.mesh.triangles.size());
}

}  // namespace

int main(int argc, char** argv) try {
  run(argc > 1 ? argv[1] : "builtin:tshirt", argc > 2 ? argv[2] : "shirt.exr");
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
