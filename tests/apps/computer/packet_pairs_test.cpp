#include "apps/computer/packet_pairs.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "nodes/packet.h"

namespace dmpc::apps::packet_pairs_test {

namespace {

void send(PairWatch& watch, std::uint32_t from, std::uint32_t to, std::size_t payload_bytes) {
  const std::array<std::byte, 64> payload{};
  watch.sent(
      {.node = nodes::NodeId{from}, .peer = nodes::NodeId{to}, .payload = std::span(payload).first(payload_bytes), .times = {}});
}

}  // namespace

TEST_CASE("packets and bytes are counted from node to node, with their heads") {
  PairWatch watch(2);
  CHECK(watch.pairs().packets == std::vector<std::uint64_t>{0, 0, 0, 0});
  send(watch, 0, 1, 0);
  send(watch, 0, 1, 10);
  send(watch, 1, 1, 64);
  constexpr std::uint64_t head = sizeof(nodes::PacketHeader);
  CHECK(watch.pairs().packets == std::vector<std::uint64_t>{0, 2, 0, 1});
  CHECK(watch.pairs().bytes == std::vector<std::uint64_t>{0, 2 * head + 10, 0, head + 64});
}

TEST_CASE("what another rank has counted is added") {
  PairWatch here(2), there(2);
  send(here, 0, 1, 8);
  send(there, 1, 0, 16);
  send(there, 0, 1, 0);
  here.add(there.bytes());
  CHECK(here.pairs().packets == std::vector<std::uint64_t>{0, 2, 1, 0});
  CHECK(here.pairs().bytes[2] == sizeof(nodes::PacketHeader) + 16);
}

}  // namespace dmpc::apps::packet_pairs_test
