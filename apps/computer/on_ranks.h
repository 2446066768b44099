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

/// Runs act() as one of the ranks, with as many nodes as there are processors for them where the options do not say it; returns
/// the exit status, rank 0's. `needs` is called when the options say how many nodes there are. Throws as run_as_rank() does.
int run_on_ranks(ProgramOptions& options, const ProgramCall& call, const std::function<RankNeeds()>& needs,
                 const std::function<int(RankRounds&)>& act);

}  // namespace dmpc::apps
