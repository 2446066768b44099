// What is said of what is refused.
#pragma once

#include <string>

#include "core/base/expect.h"

namespace dmpc::tests {

/// The message of the Error with which `act` ends; empty if it ends well. Other exceptions pass.
template <class Error = core::InputError, class Act>
std::string complaint_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace dmpc::tests
