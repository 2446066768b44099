// A reader's main loop: it gets ready, shuts itself in, and does what it is asked for.
#pragma once

#include <functional>

#include "apps/reader/line.h"

namespace dmpc::apps {

/// Takes the line that dmpc has left open, and calls `serve` for each request until dmpc hangs up; what that throws is sent.
/// Libraries have to be ready before, since nothing can be opened any more. Never returns.
[[noreturn]] void serve_requests(const std::function<void(const Message&, Line&)>& serve);

}  // namespace dmpc::apps
