// What a rank brings to a run that rank 0 leads.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "nodes/ranks/rank_memory.h"
#include "nodes/watch/watching.h"

namespace dmpc::nodes {

struct Following {
  /// Called when the plan is known, before anything of it is set aside; throws if this rank has no room.
  std::function<void(const RankMemory&)> check_room = [](const RankMemory&) {};
  /// Called next, if rank 0 wants the nodes looked at, with what it orders: who looks on here.
  std::function<Watching(std::string_view order)> watch = [](std::string_view) { return Watching(); };
  /// Called before each run but the first, where several follow each other on the same nodes: what was seen is forgotten.
  std::function<void()> watch_again = [] {};
  /// Called then, when the run is over: what was seen here, as WatchingElsewhere::add() of rank 0 understands it.
  std::function<std::string()> seen = [] { return std::string(); };
};

}  // namespace dmpc::nodes
