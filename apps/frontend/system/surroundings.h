// What a process needs around it before it opens anything.
#pragma once

#include "core/base/expect.h"

namespace dmpc::apps {

/// To be called first. What nobody reads or takes any more becomes an error of the write, where a signal would have ended the
/// process with its files half written; and a standard stream that is closed is one that gives and takes nothing, since the next
/// file opened would get its number, and what is said would go into that. Whatever libraries were loaded, the calling thread has
/// the usual arithmetic. From folders that the environment names OpenImageIO loads no plugins.
void settle_in();

/// Thrown where it was the standard output that nobody reads any more.
struct BrokenPipe : core::InputError {
  using InputError::InputError;
};

/// Whether the standard output is a pipe that nobody reads any more.
bool is_pipe_broken();

/// Ends the process as the signal would have that settle_in() keeps away.
[[noreturn]] void end_by_broken_pipe();

}  // namespace dmpc::apps
