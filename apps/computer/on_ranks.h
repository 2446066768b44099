// Runs a program on ranks started by MPI. Each rank executes the whole program, with its own nodes.
#pragma once

#include <cstddef>
#include <functional>

#include "apps/computer/options.h"
#include "apps/computer/program_main.h"
#include "apps/computer/rank_rounds.h"
#include "apps/frontend/ranks/compatibility.h"

namespace dmpc::apps {

/// The requirements that ranks must know before they communicate.
struct RankNeeds {
  std::size_t payload_bytes_max = 0;  ///< per packet
  Compatibility alike = {};           ///< what must be equal on all ranks, besides the program's words
};

/// Runs act() as one of the ranks. By default there are as many nodes as processors. Returns rank 0's exit status. `needs` is
/// called once the number of nodes is known. Throws as run_as_rank() does.
int run_on_ranks(ProgramOptions& options, const ProgramCall& call, const std::function<RankNeeds()>& needs,
                 const std::function<int(RankRounds&)>& act);

}  // namespace dmpc::apps
