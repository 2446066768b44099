// The order of what happens at one time, for readers that take events as they come.
#pragma once

#include <cstdint>
#include <span>

namespace dmpc::apps {

/// What is said at a time; in the order in which it goes at one time in one call of one node.
enum class TraceMoment : std::uint8_t { span_end, received, span_begin, sent, wait_begin, wait_end, level };

struct TraceItem {
  std::uint64_t time_ns = 0;
  std::uint32_t node = 0;
  std::uint64_t call = 0;
  TraceMoment moment = TraceMoment::span_begin;
  std::uint32_t index = 0;  ///< index of the node's span or level, the message or the wait
};

/// Moves the beginning of each message before its end. Requires items in order of time, those of one time in order of node, and
/// no message that is received before it is sent; each node's stay in their order.
void order_causally(std::span<TraceItem> items);

}  // namespace dmpc::apps
