#include <cmath>

#include "fuzz/properties.h"
#include "weft/scene_file.h"

namespace weft::fuzz {
namespace {

void require_sound(const Scene& scene) {
  require(!scene.cloths.empty(), "a scene has a cloth");
  require(std::isfinite(scene.frame_rate) && scene.frame_rate > 0, "the frame rate is positive");
  require(scene.substeps >= 1 && scene.frames >= 0, "steps and frames are counted");
  for (const SceneCloth& cloth : scene.cloths) {
    require(!cloth.name.empty() && cloth.name.find('/') == cloth.name.npos, "names are file names");
    require(cloth.size >= min_image_size && cloth.size <= largest_image_size, "sizes are in range");
    require(std::isfinite(cloth.friction) && std::isfinite(cloth.material.stretch.warp),
            "numbers are finite");
  }
}

}  // namespace
}  // namespace weft::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace weft;
  using namespace weft::fuzz;
  const auto scene =
      read_or_refuse([&] { return parse_scene(as_text(data, size), file_name, "/folder"); });
  if (!scene) return 0;
  require_sound(*scene);
  const std::string text = scene_text(*scene, "/folder/scene.json");
  const Scene again = parse_scene(text, "text", "/folder");
  require(text == scene_text(again, "/folder/scene.json"), "what is written reads back as it was");
  return 0;
}
