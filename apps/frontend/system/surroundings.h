// Prepares the process before it opens files.
#pragma once

#include "core/base/expect.h"

namespace dmpc::apps {

/// This is called first. Writing to a closed pipe becomes an error instead of a signal that would end the process with
/// half-written files. A closed standard stream is replaced by an empty one, since otherwise the next opened file would get its
/// number and receive messages. The calling thread gets the default floating-point mode, whatever libraries were loaded.
/// OpenImageIO does not load plugins from folders named by the environment.
void settle_in();

/// Thrown if the standard output no longer has a reader.
struct BrokenPipe : core::InputError {
  using InputError::InputError;
};

/// Whether the standard output is a pipe without a reader.
bool is_pipe_broken();

/// Ends the process by the signal that settle_in() suppresses.
[[noreturn]] void end_by_broken_pipe();

}  // namespace dmpc::apps
