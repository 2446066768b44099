#include "apps/picture/deflater.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <span>
#include <vector>

namespace dmpc::tests::deflater_test {

TEST_CASE("what is packed has room in the most that it can take, and is not packed where there is less room than it takes") {
  apps::Deflater deflater(4);
  for (const std::size_t count : {0, 1, 1000}) {
    CAPTURE(count);
    const std::vector<std::uint8_t> bytes(count, 7);
    std::vector<std::uint8_t> room(deflater.packed_bytes_max(count));
    const std::size_t size = deflater.pack(bytes, room);
    REQUIRE(size > 0);
    CHECK(deflater.pack(bytes, std::span(room).first(size - 1)) == 0);
  }
}

TEST_CASE("what was packed before leaves no trace") {
  apps::Deflater used(4), fresh(4);
  const std::vector<std::uint8_t> other(5000, 3), bytes{1, 2, 3, 1, 2, 3, 1, 2, 3};
  std::vector<std::uint8_t> room(6000), again(6000);
  used.pack(other, room);
  CHECK(used.pack(bytes, room) == fresh.pack(bytes, again));
  room.resize(20);
  again.resize(20);
  CHECK(room == again);
}

}  // namespace dmpc::tests::deflater_test
