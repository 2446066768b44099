#include "apps/frontend/show/trace/causal_order.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Where each node's items begin among some in order of node; the last first.
std::vector<std::size_t> beginnings(std::span<const TraceItem> items) {
  std::vector<std::size_t> found;
  for (std::size_t i = items.size(); i-- > 0;) {
    if (i == 0 || items[i - 1].node != items[i].node) {
      found.push_back(i);
    }
  }
  return found;
}

/// Orders items of one time by node: each node's stay in their order, but it stops before the end of a message until
/// another node has come to its beginning.
void order_one_time(std::span<TraceItem> items) {
  std::unordered_set<std::uint32_t> unsent;
  for (const TraceItem& item : items) {
    if (item.moment == TraceMoment::sent) {
      unsent.insert(item.index);
    }
  }
  if (unsent.empty()) {
    return;
  }
  const std::vector<TraceItem> all(items.begin(), items.end());
  std::vector<std::size_t> ready = beginnings(all);        // where nodes go on, the next last
  std::unordered_map<std::uint32_t, std::size_t> stopped;  // where one has, by message
  auto place = items.begin();
  while (!ready.empty()) {
    std::size_t at = ready.back();
    ready.pop_back();
    for (const std::uint32_t node = all[at].node; at < all.size() && all[at].node == node; ++at) {
      const TraceItem& item = all[at];
      if (item.moment == TraceMoment::received && unsent.contains(item.index)) {
        stopped[item.index] = at;
        break;
      }
      *place++ = item;
      if (item.moment == TraceMoment::sent && unsent.erase(item.index) > 0) {
        if (const auto waiting = stopped.extract(item.index)) {
          ready.push_back(waiting.mapped());
        }
      }
    }
  }
  core::expect(place == items.end(), "no message is received before it is sent");
}

}  // namespace

void order_causally(std::span<TraceItem> items) {
  for (auto begin = items.begin(); begin != items.end();) {
    const auto end = std::find_if(begin, items.end(), [&](const TraceItem& item) { return item.time_ns != begin->time_ns; });
    order_one_time({begin, end});
    begin = end;
  }
}

}  // namespace dmpc::apps
