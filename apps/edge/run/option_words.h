// What a plan says of its fields, in the words of the command line.
#pragma once

#include <string>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {

/// "node_count=5: ..." as "--nodes=5: ...", for each field that an option sets.
std::string in_options(const std::string& message);

/// What `make` returns; a core::UsageError or core::RoomError that it throws, in_options().
template <class Make>
auto with_options_named(const Make& make) {
  try {
    return make();
  } catch (const core::UsageError& error) {
    throw core::UsageError(in_options(error.what()));
  } catch (const core::RoomError& error) {
    throw core::RoomError(in_options(error.what()));
  }
}

}  // namespace dmpc::apps
