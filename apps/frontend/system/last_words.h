// The end of the program where memory is exhausted, or an exception is not caught.
#pragma once

#include <string_view>

namespace dmpc::apps {

/// Prints, without allocations, that memory is exhausted; returns the exit status.
int complain_of_memory();

/// Adds the cause to that message: `source` is a container or a shell, as a part of a sentence, or empty.
void name_memory_limit(std::string_view source, std::string_view bytes);

/// Whether an allocation has failed since end_without_abort(): an apparent bug may be its consequence.
bool memory_has_run_out();

/// During its lifetime, std::terminate() is attributed to a library that needs threads or memory while it is loaded, where
/// nothing can be caught: the status is 4.
struct LoadsLibrary {
  LoadsLibrary();
  ~LoadsLibrary();
  LoadsLibrary(const LoadsLibrary&) = delete;
  LoadsLibrary& operator=(const LoadsLibrary&) = delete;
};

/// From now on std::terminate() removes temporary files, prints the cause, and ends the process with the exception's status
/// instead of abort(): libraries call it when memory is exhausted. A crash for lack of memory does the same; any other stays a
/// crash.
void end_without_abort();

}  // namespace dmpc::apps
