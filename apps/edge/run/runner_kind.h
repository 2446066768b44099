// What calls the nodes' programs.
#pragma once

#include <cstdint>
#include <string>

#include "nodes/computer_request.h"

namespace dmpc::apps {

/// By the wall clock a thread a node or a pool of threads for all, in one process, or threads of the ranks that MPI has started;
/// or the model of a machine, in virtual time.
enum class RunnerKind : std::uint8_t { threads, pool, virtual_time, mpi };

/// As the command line calls it.
constexpr const char* name_of(RunnerKind runner) {
  switch (runner) {
    case RunnerKind::threads:
      return "threads";
    case RunnerKind::pool:
      return "pool";
    case RunnerKind::virtual_time:
      return "virtual";
    case RunnerKind::mpi:
      return "mpi";
  }
  return "";
}

/// A pool has as many threads as there are processors, unless somebody has said how many.
void choose_pool(RunnerKind runner, nodes::ComputerRequest& computer);

/// The same for pages, with the machine that is modelled or what nodes have of threads. `where`: as " on 2 ranks", or nothing.
std::string runner_text(const nodes::ComputerRequest& computer, const std::string& where);

}  // namespace dmpc::apps
