// Checks whether this computer has enough memory for a run.
#pragma once

#include <string>

#include "apps/frontend/system/available_memory.h"
#include "nodes/ranks/rank_memory.h"

namespace dmpc::apps {

/// Throws ComputerCapacityError unless there is space for `memory`, which is touched before a run begins.
void check_room(const nodes::RankMemory& memory, const AvailableMemory& room = available_memory());

/// "0.6 MB of network memory: outbox 0.1 MB, ...".
std::string network_text(const nodes::NetworkMemory& network);

}  // namespace dmpc::apps
