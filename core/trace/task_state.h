// How a task stands after a bounded time of work.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// `absent`: it needs a record that is not here.
enum class TaskState : std::uint8_t { finished, more, absent };

}  // namespace dmpc::core
