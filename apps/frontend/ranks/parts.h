// The parts that ranks have in a command: rank 0 leads it, and alone speaks to the user; others follow.
#pragma once

#include <functional>

#include "nodes/ranks/rank_links.h"

namespace dmpc::apps {

/// Rank 0's: what work() returns, or throws, when the others know that all is over, and with which status.
int lead(nodes::RankLinks& links, const std::function<int()>& work);

/// Another rank's: what fails in work() rank 0 is told of. Returns the status with which rank 0 ends the command. Throws LostRank
/// when rank 0 had time to say it.
int follow(nodes::RankLinks& links, const std::function<void()>& work);

}  // namespace dmpc::apps
