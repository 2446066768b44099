// A program as a process of its own, whose memory is watched from outside.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

/// What became of it.
struct WatchedProcess {
  int status = 0;  ///< its exit status; below 0: the signal that ended it
  /// The most anonymous memory (RssAnon of Linux) that it was seen to have; nothing if it ended before it was seen with any.
  std::optional<std::size_t> peak_anonymous_bytes;
  std::string complaint;  ///< what it wrote to stderr
};

/// Runs `program` with `arguments`, with nothing to read, to its end, and looks at its memory each millisecond. It does not get
/// the terminal's Ctrl-C. Throws core::InputError if it cannot be started; Interrupted after a signal, when it has been ended
/// too.
WatchedProcess watch_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             const Interrupt& interrupt);

/// The memory of such a process. Throws core::InputError if it ended otherwise than with status 0, or was never seen, too.
std::size_t peak_anonymous_bytes(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const Interrupt& interrupt);

/// RssAnon in the text of a /proc/.../status; 0 if it has none.
std::size_t anonymous_bytes_in(std::string_view status);

}  // namespace dmpc::apps
