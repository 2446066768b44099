// A strategy on so many nodes, as the parts of the bench render with it.
#pragma once

#include <cstdint>

#include "apps/run/strategy_options.h"

namespace dmpc::apps {

/// All else by default.
inline StrategyOptions on_nodes(Strategy strategy, std::uint32_t node_count) {
  StrategyOptions options;
  options.strategy = strategy;
  options.computer.node_count = node_count;
  return options;
}

}  // namespace dmpc::apps
