#include "nodes/counters.h"

#include <doctest/doctest.h>

#include "core/base/counts.h"

namespace dmpc::nodes::counters_test {

TEST_CASE("traffic is packets, and bytes with their headers, summed kind by kind") {
  TrafficByKind sum{}, more{};
  sum[1].add(8);
  more[1].add(100);
  more[packet_kind_count - 1].add(0);
  core::add_counts(sum, more);
  CHECK(sum[0].packets == 0);
  CHECK(sum[1].packets == 2);
  CHECK(sum[1].bytes == 2 * sizeof(PacketHeader) + 108);
  CHECK(sum[packet_kind_count - 1].bytes == sizeof(PacketHeader));
  CHECK(total(sum).packets == 3);
  CHECK(total(sum).bytes == 3 * sizeof(PacketHeader) + 108);
}

}  // namespace dmpc::nodes::counters_test
