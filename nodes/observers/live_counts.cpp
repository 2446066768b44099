#include "nodes/observers/live_counts.h"

#include <atomic>
#include <utility>

#include "nodes/atomics.h"

namespace dmpc::nodes {

namespace {

/// Written by one thread at a time, so adding needs no atomic exchange.
class Number {
 public:
  void set(std::uint64_t value) { value_.store(value, std::memory_order_relaxed); }
  void add(std::uint64_t more) { set(get() + more); }
  std::uint64_t get() const { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> value_ = 0;
};

}  // namespace

/// On separate cache lines.
struct alignas(cache_line_bytes) LiveCounts::Node {
  Number now_ns, packets_sent, bytes_sent;
  std::array<Number, work_count> busy_ns;
};

LiveCounts::LiveCounts(std::uint32_t peer_count, WorkOf work_of) : work_of_(std::move(work_of)), nodes_(peer_count) {}

LiveCounts::~LiveCounts() = default;

void LiveCounts::ended(const Span& span, const Program& /*program*/) {
  Node& node = nodes_[index_of(span.node)];
  node.now_ns.set(span.end_ns);
  node.busy_ns[work_of_(span)].add(span.own_ns);
  if (span.received_ns > 0) {
    node.busy_ns[work_of_(span.taking_packets())].add(span.received_ns);
  }
}

void LiveCounts::sent(const Passing& packet) {
  Node& node = nodes_[index_of(packet.node)];
  node.packets_sent.add(1);
  node.bytes_sent.add(packet.payload_bytes());
}

std::vector<LiveNode> LiveCounts::read() const {
  std::vector<LiveNode> all;
  for (const Node& node : nodes_) {
    LiveNode& made = all.emplace_back();
    made.now_ns = node.now_ns.get();
    made.packets_sent = node.packets_sent.get();
    made.bytes_sent = node.bytes_sent.get();
    for (std::size_t work = 0; work < work_count; ++work) {
      made.busy_ns[work] = node.busy_ns[work].get();
    }
  }
  return all;
}

void LiveCounts::clear() {
  for (Node& node : nodes_) {
    node.now_ns.set(0);
    node.packets_sent.set(0);
    node.bytes_sent.set(0);
    for (Number& busy : node.busy_ns) {
      busy.set(0);
    }
  }
}

}  // namespace dmpc::nodes
