#include "nodes/watch/done_watch.h"

#include "nodes/atomics.h"

namespace dmpc::nodes {

/// On cache lines of its own. It has no more items than one call works on.
struct alignas(cache_line_bytes) DoneWatch::Call {
  std::vector<std::uint32_t> items;
};

DoneWatch::DoneWatch(std::uint32_t peer_count, HeatMap& map) : map_(&map) {
  for (std::uint32_t i = 0; i < peer_count; ++i) {
    calls_.push_back(std::make_unique<Call>());
  }
}

DoneWatch::~DoneWatch() = default;

void DoneWatch::worked(const Worked& worked) { calls_[index_of(worked.node)]->items.push_back(worked.item); }

void DoneWatch::ended(const Span& span, const Program& /*program*/) {
  if (span.activity != Activity::work && span.activity != Activity::receive) {
    return;  // an interrupt within a call, which works on nothing, or no call at all
  }
  std::vector<std::uint32_t>& items = calls_[index_of(span.node)]->items;
  for (const std::uint32_t item : items) {
    map_->raise(map_->done(), item, span.end_ns);
  }
  items.clear();
}

}  // namespace dmpc::nodes
