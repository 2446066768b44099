// The end of a command on all ranks: rank 0, which alone communicates with the user, sets the status.
#pragma once

#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// Thrown where a rank waits for something else: rank 0 has ended the command, and has reported the reason if there is one.
struct Dismissed {
  int status = 0;  ///< the process's exit status
};

/// Sends the status to all others, on rank 0, as its termination message. Throws LostRank as RankLinks do.
void dismiss(RankLinks& links, int status);

/// Waits for it on another rank, ignoring everything else, and returns the status. Throws LostRank as RankLinks do.
int wait_for_dismissal(RankLinks& links);

/// If a rank is lost, on ranks other than 0: waits a moment, since rank 0, if it lives, finds out, too, reports it, and ends all.
void let_rank_0_speak();

}  // namespace dmpc::nodes
