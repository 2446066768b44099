// How the program ends where nothing can be allocated any more, or nobody is left to catch what was thrown.
#pragma once

#include <string_view>

namespace dmpc::apps {

/// Says that memory has run out, which takes none; returns the exit status.
int complain_of_memory();

/// From now on it says, too, who grants no more: `source` is a container or a shell, as a part of a sentence, or empty.
void name_memory_limit(std::string_view source, std::string_view bytes);

/// An allocation has failed since end_without_abort(): what seems to be a bug may come of that.
bool memory_has_run_out();

/// While one lives, std::terminate() comes of a library that wants threads or memory as it is loaded, where nothing can be
/// caught: the status is 4.
struct LoadsLibrary {
  LoadsLibrary();
  ~LoadsLibrary();
  LoadsLibrary(const LoadsLibrary&) = delete;
  LoadsLibrary& operator=(const LoadsLibrary&) = delete;
};

/// From now on std::terminate() removes the files under way, says why, and ends the process with the status of what was thrown,
/// rather than to abort it: libraries call it where memory runs out. So does a crash for want of memory; any other stays a crash.
void end_without_abort();

}  // namespace dmpc::apps
