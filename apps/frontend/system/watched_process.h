// Runs a program as a child process and observes its memory from outside.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

struct WatchedProcess {
  int status = 0;  ///< its exit status; below 0: the signal that ended it
  /// The largest anonymous memory (RssAnon of Linux) observed; nothing if the process ended before the first sample.
  std::optional<std::size_t> peak_anonymous_bytes;
  std::string complaint;  ///< its output to stderr
};

/// Runs `program` with `arguments` and without input to its end, and samples its memory every millisecond. It does not get the
/// terminal's Ctrl-C. Throws core::InputError if it cannot be started, and Interrupted after a signal, once the program has
/// ended, too.
WatchedProcess watch_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             const Interrupt& interrupt);

/// Returns the peak memory of such a process. Also throws core::InputError if its status is not 0, or if no memory was observed.
std::size_t peak_anonymous_bytes(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const Interrupt& interrupt);

/// Returns RssAnon in the text of a /proc/.../status; 0 if it has none.
std::size_t anonymous_bytes_in(std::string_view status);

}  // namespace dmpc::apps
