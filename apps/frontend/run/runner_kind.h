// The ways to run the nodes' programs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "nodes/computer_request.h"

namespace dmpc::apps {

/// In wall-clock time a thread per node or a pool of threads for all, in one process, or threads of the ranks that MPI has
/// started; or the model of a machine, in virtual time.
enum class RunnerKind : std::uint8_t { threads, pool, virtual_time, mpi };

/// Name on the command line.
constexpr const char* name_of(RunnerKind runner) {
  constexpr std::array names = {"threads", "pool", "virtual", "mpi"};
  return names.at(static_cast<std::size_t>(runner));
}

/// A pool has as many threads as there are processors, unless an option says how many.
void choose_pool(RunnerKind runner, nodes::ComputerRequest& computer);

/// As above for pages, with the modelled machine or the nodes' threads. `where`: as " on 2 ranks", or nothing.
std::string runner_text(const nodes::ComputerRequest& computer, const std::string& where);

}  // namespace dmpc::apps
