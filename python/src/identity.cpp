#include "python/src/identity.h"

#include <functional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "python/src/arrays.h"

namespace weft::python {
namespace {

/// Text that grows by a line for each array.
class Lines {
 public:
  explicit Lines(std::string text) : text_(std::move(text)) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const std::vector<T>& values) {
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                 values.size() * sizeof(T));
    text_ += '\n' + std::to_string(values.size()) + ' ' +
             std::to_string(std::hash<std::string_view>{}(bytes));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Which samples are one point.
void add_classes(const BorderMates& mates, Lines& lines) {
  std::vector<int> classes;
  const int samples = mates.size() * mates.size();
  classes.reserve(static_cast<std::size_t>(samples));
  for (int s = 0; s < samples; ++s)
    classes.push_back(mates.is_hole(s) ? -1 : mates.representative(s));
  lines.add(classes);
}

void add_mesh(const SourceMesh& mesh, Lines& lines) {
  lines.add(mesh.positions);
  lines.add(mesh.faces.sizes);
  lines.add(mesh.faces.corners);
  lines.add(mesh.faces.texture);
  lines.add(mesh.faces.texture_corners);
}

void add_cloth(const SimulatedCloth& cloth, Lines& lines) {
  add_classes(cloth.image.mates, lines);
  if (cloth.source) add_mesh(*cloth.source, lines);
  if (!cloth.garment) return;
  add_classes(cloth.garment->sewn, lines);
  lines.add(samples_of(cloth.garment->texture));
}

void add_motion(const SceneBody& body, Lines& lines) {
  if (!body.animation.in_memory()) return;  // the scene names it
  lines.add(body.animation.points->times);
  lines.add(body.animation.points->positions);
  lines.add(std::vector{body.wait, body.lead_in});
}

}  // namespace

std::string identity_of(const std::string& json, const Scene& scene, const Simulation& simulation) {
  Lines lines(json + '\n' + simulation.state_hash());
  for (const SimulatedCloth& cloth : simulation.cloths()) add_cloth(cloth, lines);
  for (const PlacedBody& body : simulation.bodies()) {
    lines.add(samples_of(body.positions));
    add_classes(body.image.mates, lines);
  }
  for (const SceneBody& body : scene.bodies) add_motion(body, lines);
  return lines.text();
}

}  // namespace weft::python
