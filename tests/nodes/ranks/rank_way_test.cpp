#include "nodes/ranks/rank_way.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "tests/support/loopback_ranks.h"

namespace dmpc::tests::rank_way_test {
namespace {

using namespace nodes;

std::vector<std::byte> bytes_from(std::uint8_t first, std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) {
    bytes[i] = static_cast<std::byte>(first + i);
  }
  return bytes;
}

ItemHeader packet_of(const std::vector<std::byte>& bytes) {
  return {.target = 3, .packet = {.bytes = static_cast<std::uint32_t>(bytes.size()), .source = 4, .kind = 5}};
}

/// The packets of the next frame that rank 1 takes, by their bytes.
std::vector<std::vector<std::byte>> taken(Fabric& fabric) {
  std::vector<std::vector<std::byte>> packets;
  if (const auto arrival = fabric.take()) {
    CHECK(arrival->rank == 0);
    for_each_item(arrival->frame, [&](const ItemHeader& header, std::span<const std::byte> bytes) {
      CHECK(header.packet.bytes == bytes.size());
      packets.emplace_back(bytes.begin(), bytes.end());
    });
  }
  return packets;
}

TEST_CASE("packets and words come out of a frame as they went in") {
  Loopback loopback(2);
  RankWay way(loopback.rank(0), 1);
  const auto a = bytes_from(1, 7), none = bytes_from(0, 0), b = bytes_from(9, 300);
  CHECK(way.put(packet_of(a), a));
  CHECK(way.put(packet_of(none), none));
  way.say({.packet = {.bytes = 300}, .item = Item::text}, b);
  CHECK_FALSE(way.has_said_all());
  CHECK(way.flush());
  CHECK(way.has_said_all());
  CHECK_FALSE(way.flush());
  CHECK(taken(loopback.rank(1)) == std::vector{a, none, b});
  CHECK(taken(loopback.rank(1)).empty());
}

TEST_CASE("two frames are under way, a packet that finds them so is refused, and none is lost") {
  Loopback loopback(2);
  RankWay way(loopback.rank(0), 1);
  const auto packet = bytes_from(0, frame_bytes_min / 2);  // one fits
  std::size_t put = 0, got = 0;
  for (int round = 0; round < 5; ++round) {
    while (way.put(packet_of(packet), packet)) {
      ++put;
    }
    way.flush();
    CHECK(put - got == 2);
    for (int frame = 0; frame < 3; ++frame) {  // the third time there is none, and the second is given back
      got += taken(loopback.rank(1)).size();
    }
  }
}

TEST_CASE("frames are as long as the longest packet asks") {
  CHECK(frame_bytes_for(100) == frame_bytes_min);
  CHECK(frame_bytes_for(65536) == 65536 + sizeof(ItemHeader) + sizeof(FrameNumber));
}

TEST_CASE("a frame that is cut off is found out") {
  Loopback loopback(2);
  const auto room = loopback.rank(0).room(1);
  FrameWriter writer(room, 0);
  const auto bytes = bytes_from(0, 20);
  writer.add(packet_of(bytes), bytes);
  const auto ignore = [](const ItemHeader&, std::span<const std::byte>) {};
  for_each_item(room.first(writer.used_bytes()), ignore);
  CHECK_THROWS_AS(for_each_item(room.first(writer.used_bytes() - 1), ignore), core::InternalError);
  CHECK_THROWS_AS(for_each_item(room.first(sizeof(FrameNumber) + 3), ignore), core::InternalError);
  CHECK_THROWS_AS(static_cast<void>(number_of(room.first(3))), core::InternalError);
}

}  // namespace
}  // namespace dmpc::tests::rank_way_test
