#include "weft/state_bytes.h"

#include <optional>
#include <utility>

#include "weft/run/bytes.h"
#include "weft/run/sealed_bytes.h"
#include "weft/run/state_fields.h"

namespace weft {
namespace {

constexpr Seal seal_of_states{"WEFTSTAT", 1, "state of a simulation",
                              "one that was saved by this version is wanted"};

}  // namespace

std::string encode_state(const SimulationState& state) {
  ByteWriter out;
  add_state(state, out);
  return seal(seal_of_states, out.take());
}

SimulationState decode_state(std::string_view bytes, const std::string& where) {
  ByteReader in(unseal(seal_of_states, bytes, where));
  std::optional<SimulationState> state = next_state(in);
  if (!state || in.left() != 0)
    refuse(seal_of_states, where, "is damaged: its parts do not fit together");
  return std::move(*state);
}

}  // namespace weft
