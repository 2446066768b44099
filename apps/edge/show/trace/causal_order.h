// The order of what happens at one time, for readers that take events as they come.
#pragma once

#include <span>
#include <vector>

#include "apps/edge/show/trace/view.h"

namespace dmpc::apps {

/// Moves the beginning of each message before its end. Requires items in order of time, those of one time in order of node, and
/// no message that is received before it is sent; each node's stay in their order.
void order_causally(std::span<TraceItem> items);

}  // namespace dmpc::apps
