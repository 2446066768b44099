// The main loop of a process that reads or writes files for dmpc: it gets ready, shuts itself in, and does what it is asked for.
#pragma once

#include <cstdint>
#include <functional>

#include "apps/reader/line.h"

namespace dmpc::apps {

/// What requests hold.
enum class Matter : std::uint8_t {
  foreign,  ///< the process shuts itself in
  own       ///< dmpc's: it does not
};

/// Takes the line that dmpc has left open, and calls `serve` for each request until dmpc hangs up; what that throws is sent.
/// Libraries have to be ready before, since with foreign matter nothing can be opened any more. Never returns.
[[noreturn]] void serve_requests(const std::function<void(const Message&, Line&)>& serve, Matter matter = Matter::foreign);

}  // namespace dmpc::apps
