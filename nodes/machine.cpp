#include "nodes/machine.h"

#include "core/base/sampling.h"

namespace dmpc::nodes {

std::uint64_t Machine::digest() const {
  std::uint64_t digest = 0;
  const auto take = [&digest](std::uint64_t figure) { digest = core::mix((digest + 0x9e3779b97f4a7c15ULL) ^ figure); };
  take(static_cast<std::uint64_t>(topology));
  take(uplinks);
  take(static_cast<std::uint64_t>(switching));
  take(short_bytes_max);
  for (const MessageCost& cost : {short_message, long_message}) {
    for (const std::uint64_t figure : {cost.send_ns, cost.latency_ns, cost.receive_ns, cost.byte_ps}) {
      take(figure);
    }
  }
  take(hop_ns);
  take(service_ns);
  for (const std::uint64_t ps : cost_ps) {
    take(ps);
  }
  take(has_contention ? 1 : 0);
  take(has_memory_port ? 1 : 0);
  return digest;
}

}  // namespace dmpc::nodes
