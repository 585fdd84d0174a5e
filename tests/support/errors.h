#pragma once

#include <string>

#include "weft/error.h"

namespace weft::test {

/// What an error of the wanted kind says; empty when there is none. Other errors pass through.
template <class Wanted, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Wanted& error) {
    return error.what();
  }
  return {};
}

}  // namespace weft::test
