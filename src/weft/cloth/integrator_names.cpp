// Apart from the integrators, so that reading a scene does not bring them along.
#include "weft/cloth/integrator.h"

namespace weft {
namespace {

struct NameOf {
  std::string_view operator()(const ImplicitOptions&) const { return "implicit"; }
  std::string_view operator()(const ExplicitOptions&) const { return "explicit"; }
  std::string_view operator()(const DesbrunOptions&) const { return "desbrun"; }
  std::string_view operator()(const TwoLevelOptions&) const { return "two_level"; }
  std::string_view operator()(const NewtonOptions&) const { return "newton"; }
  std::string_view operator()(const MultigridOptions&) const { return "multigrid"; }
};

}  // namespace

bool has_limiter(const IntegratorOptions& options) {
  return !std::holds_alternative<NewtonOptions>(options) &&
         !std::holds_alternative<ImplicitOptions>(options);
}

std::string_view name_of(const IntegratorOptions& options) { return std::visit(NameOf{}, options); }

}  // namespace weft
