// The end of the program when memory is exhausted or an exception is not caught.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace dmpc::apps {

/// Prints, without allocations, that memory is exhausted; returns the exit status.
int complain_of_memory();

/// Adds the cause to that message: `source` names a container or a shell, as a part of a sentence, or is empty.
void name_memory_limit(std::string_view source, std::string_view bytes);

/// Returns whether an allocation has failed since end_without_abort(): an apparent bug may be its consequence.
bool memory_has_run_out();

/// During its lifetime, std::terminate() is attributed to a library that needs threads or memory while it is loaded, where no
/// exception can be caught: the status is 4.
struct LoadsLibrary {
  LoadsLibrary();
  ~LoadsLibrary();
  LoadsLibrary(const LoadsLibrary&) = delete;
  LoadsLibrary& operator=(const LoadsLibrary&) = delete;
};

/// During its lifetime, a fault in these bytes, which are mapped from a file, is attributed to whoever has cut that meanwhile:
/// the status is 1. Of several at a time the last one counts. Not thread-safe.
class MappedBytes {
 public:
  MappedBytes(std::span<const std::byte> bytes, std::string_view path);
  ~MappedBytes();
  MappedBytes(const MappedBytes&) = delete;
  MappedBytes& operator=(const MappedBytes&) = delete;

 private:
  const std::byte* first_;
};

/// From now on std::terminate(), which libraries call when memory is exhausted, removes temporary files, prints the cause, and
/// ends the process with the exception's status instead of abort(). A crash for lack of memory does the same; any other crash
/// stays one.
void end_without_abort();

}  // namespace dmpc::apps
