#include "weft/cloth/integrator.h"

namespace weft {

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, const Cloth& cloth,
                                            const StepInput& typical, ThreadTeam& team) {
  return std::visit(
      [&](const auto& chosen) { return make_integrator_of(chosen, cloth, typical, team); },
      options);
}

}  // namespace weft
