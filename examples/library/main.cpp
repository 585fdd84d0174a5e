// Turns a mesh into a geometry image, hangs it up by two corners, and tells where its lowest point
// goes.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "weft/convert/convert.h"
#include "weft/convert/load_surface.h"
#include "weft/image/io/image_file.h"
#include "weft/sim/simulation.h"

namespace {

double lowest(const weft::Planes3& positions) {
  double y = HUGE_VAL;
  for (int row = 0; row < positions.size(); ++row)
    for (int col = 0; col < positions.size(); ++col)
      y = std::min<double>(y, positions.at(row, col).y);
  return y;
}

void run(const char* mesh) {
  weft::ConvertOptions options;
  options.size = 33;
  const weft::Conversion made = weft::convert_mesh(weft::load_mesh(mesh), mesh, options);
  std::printf("converted: %.1f dB, Euler number %d\n", made.quality.psnr_db, made.quality.euler);
  weft::write_image("shirt.exr", made.image);

  weft::SceneCloth shirt;
  shirt.surface = "shirt.exr";
  shirt.pins = {weft::ImagePin{{0, 0}}, weft::ImagePin{{1, 1}}};
  weft::Scene scene;
  scene.ground.reset();
  scene.cloths = {shirt};
  weft::Simulation simulation(scene, "example", 2);
  for (int frame = 0; frame < 10; ++frame) simulation.advance();
  std::printf("frame %d: lowest point at %.4f m\n", simulation.frame(),
              lowest(simulation.cloths().front().state.position));
}

}  // namespace

int main(int argc, char** argv) try {
  run(argc > 1 ? argv[1] : "builtin:tshirt");
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
