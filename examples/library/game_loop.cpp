// A game's loop around a cloth: frames at a time, a hand that pulls, a state to come back to, and
// loading that can be stopped.
#include <atomic>
#include <cstdio>
#include <exception>
#include <string_view>

#include "weft/error.h"
#include "weft/progress.h"
#include "weft/simulation.h"

namespace {

/// Told how far long work has come; throws where the player asked to stop.
class Loading final : public weft::Progress {
 public:
  void update(std::string_view /*stage*/, double /*fraction*/) override {
    if (stop) throw weft::Interrupted();
  }
  std::atomic<bool> stop = false;
};

weft::Scene flag() {
  weft::SceneCloth cloth;
  cloth.name = "flag";
  cloth.size = 33;
  cloth.pins = {weft::ImagePin{{0, 0}}, weft::ImagePin{{1, 0}}};
  weft::Scene scene;
  scene.ground.reset();
  scene.substeps = 2;
  scene.cloths = {cloth};
  return scene;
}

}  // namespace

int main() try {
  Loading loading;
  weft::Simulation simulation(flag(), "flag", 1, {&loading});
  for (int tick = 0; tick < 20; ++tick) simulation.advance();
  weft::SimulationState saved;
  simulation.save(saved);

  const auto hash_after_pull = [&] {
    const weft::Planes3& at = simulation.cloths()[0].state.position;
    const int middle = at.size() * at.size() / 2;
    simulation.grab(0, middle);
    for (int tick = 0; tick < 10; ++tick) {
      simulation.pull({0, 0.2, 0.02 * tick});
      simulation.advance();  // positions are simulation.cloths()[0].state.position, n x n
    }
    simulation.let_go();
    return simulation.state_hash();
  };
  const std::string first = hash_after_pull();
  simulation.restore(saved);
  const bool same = hash_after_pull() == first;
  std::printf("frame %d: played again %s\n", simulation.frame(), same ? "alike" : "otherwise");

  loading.stop = true;
  try {
    simulation.advance();
  } catch (const weft::Interrupted&) {
    std::printf("stopped\n");
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
