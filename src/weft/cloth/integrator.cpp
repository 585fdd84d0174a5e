#include "weft/cloth/integrator.h"

#include "weft/cloth/proposal.h"
#include "weft/core/overloaded.h"

namespace weft {

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, const Cloth& cloth,
                                            const StepInput& typical, ThreadTeam& team) {
  return std::visit(
      Overloaded{[&](const ImplicitOptions& chosen) { return make_implicit(chosen, cloth, team); },
                 [&](const ExplicitOptions&) { return make_explicit(cloth, typical, team); },
                 [&](const DesbrunOptions&) { return make_desbrun(cloth, typical, team); },
                 [&](const TwoLevelOptions& chosen) {
                   return make_two_level(chosen, cloth, typical, team);
                 },
                 [&](const NewtonOptions& chosen) { return make_newton(chosen, cloth, team); },
                 [&](const MultigridOptions& chosen) {
                   return make_multigrid(chosen, cloth, typical, team);
                 }},
      options);
}

}  // namespace weft
