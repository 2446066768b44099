#include "apps/computer/packet_pairs.h"

#include <algorithm>
#include <functional>

#include "nodes/counters.h"

namespace dmpc::apps {

PairObserver::PairObserver(std::uint32_t node_count) : node_count_(node_count) {
  const std::size_t pair_count = std::size_t{node_count} * node_count;
  pairs_ = {.packets = std::vector<std::uint64_t>(pair_count), .bytes = std::vector<std::uint64_t>(pair_count)};
}

void PairObserver::sent(const nodes::Passing& packet) {
  const std::size_t pair = std::size_t{index_of(packet.node)} * node_count_ + index_of(packet.peer);
  nodes::Traffic one;
  one.add(packet.payload_bytes());
  pairs_.packets[pair] += one.packets;
  pairs_.bytes[pair] += one.bytes;
}

std::string PairObserver::bytes() const {
  nodes::FlatWriter flat;
  flat.put_all(pairs_.packets);
  flat.put_all(pairs_.bytes);
  return flat.take();
}

void PairObserver::add(std::string_view bytes) {
  nodes::FlatReader flat(bytes);
  for (std::vector<std::uint64_t>* const counts : {&pairs_.packets, &pairs_.bytes}) {
    const auto more = flat.take_all<std::uint64_t>();
    std::transform(more.begin(), more.end(), counts->begin(), counts->begin(), std::plus());
  }
}

}  // namespace dmpc::apps
