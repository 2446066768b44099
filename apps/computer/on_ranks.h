// A program on the ranks that MPI has started: each of them runs all of it, with the nodes that are there.
#pragma once

#include <cstddef>
#include <functional>

#include "apps/computer/options.h"
#include "apps/computer/program_main.h"
#include "apps/computer/rank_rounds.h"
#include "apps/frontend/ranks/compatibility.h"

namespace dmpc::apps {

/// What ranks need to know of a program before they talk to each other.
struct RankNeeds {
  std::size_t payload_bytes_max = 0;  ///< per packet
  Compatibility alike = {};           ///< what it must be on all of them, beside its words
};

/// Runs act() as one of the ranks, with as many nodes as there are processors for them where the options do not say it; returns
/// the exit status, rank 0's. `needs` is called when the options say how many nodes there are. Throws as run_as_rank() does.
int run_on_ranks(ProgramOptions& options, const ProgramCall& call, const std::function<RankNeeds()>& needs,
                 const std::function<int(RankRounds&)>& act);

}  // namespace dmpc::apps
