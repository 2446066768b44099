#include "apps/edge/viewer/tev_packet.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"
#include "tests/support/loopback_viewer.h"

namespace dmpc::apps::tev_packet_test {

TEST_CASE("a packet that makes a picture has the documented bytes") {
  const std::string expected("\x23\0\0\0\4\1ab\0\x0a\0\0\0\x05\0\0\0\3\0\0\0R\0G\0B\0", 27);
  std::string sized = expected;
  sized[0] = 27;
  CHECK(create_packet("ab", 10, 5) == sized);
}

TEST_CASE("a packet that changes a part has its place, its channels side by side, and its values") {
  const std::string packet = update_packet("a", {7, 1, 1, 1, {0.5F, 0, 2}});
  const std::string head("\x61\0\0\0\6\0a\0\3\0\0\0R\0G\0B\0\7\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0", 34);
  CHECK(packet.size() == 34 + 6 * 8 + 3 * 4);
  std::string sized = head;
  sized[0] = static_cast<char>(packet.size());
  CHECK(packet.substr(0, 34) == sized);
  CHECK(packet.substr(34 + 24, 8) == std::string("\3\0\0\0\0\0\0\0", 8));
  CHECK(packet.substr(packet.size() - 12, 4) == std::string("\0\0\0\x3f", 4));
}

TEST_CASE("a name ends where it has a zero byte") {
  CHECK(tests::ShownPicture(create_packet(std::string("a\0b", 3), 1, 1)).name == "a");
}

TEST_CASE("a tile without pixels or with too few values is refused") {
  CHECK_THROWS_AS(update_packet("a", {0, 0, 0, 0, {}}), core::InternalError);
  CHECK_THROWS_AS(update_packet("a", {0, 0, 2, 1, {1, 2, 3}}), core::InternalError);
}

}  // namespace dmpc::apps::tev_packet_test
