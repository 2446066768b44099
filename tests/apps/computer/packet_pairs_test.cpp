#include "apps/computer/packet_pairs.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "nodes/packet.h"

namespace dmpc::apps::packet_pairs_test {

namespace {

void send(PairObserver& observer, std::uint32_t from, std::uint32_t to, std::size_t payload_bytes) {
  const std::array<std::byte, 64> payload{};
  observer.sent(
      {.node = nodes::NodeId{from}, .peer = nodes::NodeId{to}, .payload = std::span(payload).first(payload_bytes), .times = {}});
}

}  // namespace

TEST_CASE("packets and bytes are counted from node to node, with their heads") {
  PairObserver observer(2);
  CHECK(observer.pairs().packets == std::vector<std::uint64_t>{0, 0, 0, 0});
  send(observer, 0, 1, 0);
  send(observer, 0, 1, 10);
  send(observer, 1, 1, 64);
  constexpr std::uint64_t head = sizeof(nodes::PacketHeader);
  CHECK(observer.pairs().packets == std::vector<std::uint64_t>{0, 2, 0, 1});
  CHECK(observer.pairs().bytes == std::vector<std::uint64_t>{0, 2 * head + 10, 0, head + 64});
}

TEST_CASE("what another rank has counted is added") {
  PairObserver here(2), there(2);
  send(here, 0, 1, 8);
  send(there, 1, 0, 16);
  send(there, 0, 1, 0);
  here.add(there.bytes());
  CHECK(here.pairs().packets == std::vector<std::uint64_t>{0, 2, 1, 0});
  CHECK(here.pairs().bytes[2] == sizeof(nodes::PacketHeader) + 16);
}

}  // namespace dmpc::apps::packet_pairs_test
