// How a command ends on all ranks: rank 0, which alone speaks to the user, says with which status.
#pragma once

#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// Thrown where a rank waits for something else: rank 0 has ended the command, and has said why if there is something to say.
struct Dismissed {
  int status = 0;  ///< of the process
};

/// Tells all others, on rank 0, as its last word. Throws LostRank as RankLinks do.
void dismiss(RankLinks& links, int status);

/// Waits for that on another rank, whatever else comes, and returns the status. Throws LostRank as RankLinks do.
int wait_for_dismissal(RankLinks& links);

/// Where a rank is lost, for the others but rank 0: waits a moment, since rank 0, if it lives, finds it out, too, says so, and
/// ends all.
void let_rank_0_speak();

}  // namespace dmpc::nodes
