// A program as a process of its own, whose memory is watched from outside.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/interrupt.h"

namespace dmpc::apps {

/// Runs `program` with `arguments`, with nothing to read and nobody to write to, and returns the most anonymous memory (RssAnon
/// of Linux) that it was seen to have, looked at each millisecond. Throws core::InputError if it cannot be started, has ended
/// otherwise than with status 0, or was never seen; Interrupted after a signal, when it has been ended too.
std::size_t peak_anonymous_bytes(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const Interrupt& interrupt);

/// RssAnon in the text of a /proc/.../status; 0 if it has none.
std::size_t anonymous_bytes_in(std::string_view status);

}  // namespace dmpc::apps
