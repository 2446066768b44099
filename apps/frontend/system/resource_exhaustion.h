// What this computer has run out of, and what to do about it.
#pragma once

#include <string>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {

/// The input would do on a computer that lets dmpc have more: memory, processes, threads, open files.
struct ComputerCapacityError : core::CapacityError {
  using core::CapacityError::CapacityError;
};

/// Throws ComputerCapacityError "WHAT: ..." if errno's value says that something has run out.
void throw_if_short(int error, const std::string& what);

/// Throws it if a program that did not get ready says so; as the dynamic loader and libraries put it.
void throw_if_short(std::string_view complaint, const std::string& what);

}  // namespace dmpc::apps
