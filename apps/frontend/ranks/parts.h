// The roles of ranks in a command: rank 0 coordinates and alone talks to the user; the others are workers.
#pragma once

#include <functional>

#include "nodes/ranks/rank_links.h"

namespace dmpc::apps {

/// On rank 0: returns or throws what work() does, once the other ranks know that the run is over, and with which status.
int lead(nodes::RankLinks& links, const std::function<int()>& work);

/// On other ranks: errors in work() are reported to rank 0. Returns the status with which rank 0 ends the command. Throws
/// LostRank once rank 0 has had time to print it.
int follow(nodes::RankLinks& links, const std::function<void()>& work);

}  // namespace dmpc::apps
