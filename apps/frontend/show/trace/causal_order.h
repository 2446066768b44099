// The order of simultaneous events, for readers that take events in file order.
#pragma once

#include <cstdint>
#include <span>

namespace dmpc::apps {

/// Kinds of events, in the order in which they happen at one time in one call of one node.
enum class TraceMoment : std::uint8_t { span_end, received, span_begin, sent, wait_begin, wait_end, level };

struct TraceItem {
  std::uint64_t time_ns = 0;
  std::uint32_t node = 0;
  std::uint64_t call = 0;
  TraceMoment moment = TraceMoment::span_begin;
  std::uint32_t index = 0;  ///< index of the node's span or level, the message or the wait
};

/// Moves the beginning of each message before its end. Requires items ordered by time, then by node, and no message that is
/// received before it is sent; the order within each node stays.
void order_causally(std::span<TraceItem> items);

}  // namespace dmpc::apps
