// What a rank brings to a run that rank 0 leads.
#pragma once

#include <functional>

#include "nodes/ranks/rank_memory.h"

namespace dmpc::nodes {

struct Following {
  /// Called when the plan is known, before anything of it is set aside; throws if this rank has no room.
  std::function<void(const RankMemory&)> check_room = [](const RankMemory&) {};
};

}  // namespace dmpc::nodes
