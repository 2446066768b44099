#include "apps/computer/packet_pairs.h"

#include <algorithm>
#include <functional>

#include "nodes/counters.h"

namespace dmpc::apps {

PairWatch::PairWatch(std::uint32_t node_count) : node_count_(node_count) {
  const std::size_t pair_count = std::size_t{node_count} * node_count;
  pairs_ = {.packets = std::vector<std::uint64_t>(pair_count), .bytes = std::vector<std::uint64_t>(pair_count)};
}

void PairWatch::sent(const nodes::Passing& packet) {
  const std::size_t pair = std::size_t{index_of(packet.node)} * node_count_ + index_of(packet.peer);
  nodes::Traffic one;
  one.add(packet.payload_bytes());
  pairs_.packets[pair] += one.packets;
  pairs_.bytes[pair] += one.bytes;
}

void PairWatch::put(nodes::FlatWriter& flat) const {
  flat.put_all(pairs_.packets);
  flat.put_all(pairs_.bytes);
}

void PairWatch::add(nodes::FlatReader& flat) {
  for (std::vector<std::uint64_t>* const counts : {&pairs_.packets, &pairs_.bytes}) {
    const std::vector<std::uint64_t> more = flat.take_all<std::uint64_t>();
    std::transform(counts->begin(), counts->end(), more.begin(), counts->begin(), std::plus<>());
  }
}

}  // namespace dmpc::apps
