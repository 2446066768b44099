// The state of a task after a bounded amount of work.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// `absent`: it needs a record that is not present.
enum class TaskState : std::uint8_t { finished, more, absent };

}  // namespace dmpc::core
