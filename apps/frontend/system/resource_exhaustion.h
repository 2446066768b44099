// Errors for exhausted resources of this computer.
#pragma once

#include <string>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {

/// A resource of this computer is exhausted: memory, processes, threads or open files. The input is valid.
struct ComputerCapacityError : core::CapacityError {
  using core::CapacityError::CapacityError;
};

/// Throws ComputerCapacityError "WHAT: ..." if the errno `error` means that a resource is exhausted.
void throw_if_short(int error, const std::string& what);

/// Throws it if a program that failed to start reports so, in the words of the dynamic loader and libraries.
void throw_if_short(std::string_view complaint, const std::string& what);

}  // namespace dmpc::apps
