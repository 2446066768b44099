// What calls the nodes' programs.
#pragma once

#include <cstdint>

namespace dmpc::apps {

/// Threads, by the wall clock, of one process or of the ranks that MPI has started, or the model of a machine, in virtual time.
enum class RunnerKind : std::uint8_t { threads, virtual_time, mpi };

/// As the command line calls it.
constexpr const char* name_of(RunnerKind runner) {
  return runner == RunnerKind::threads ? "threads" : runner == RunnerKind::virtual_time ? "virtual" : "mpi";
}

}  // namespace dmpc::apps
