#include "apps/frontend/run/computer_capacity.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::apps::computer_capacity_test {

namespace {

constexpr nodes::RankMemory small_rank{.node_count = 2, .has_host = true, .nodes_bytes = 600};
const AvailableMemory room{1000, "this computer's memory"};

}  // namespace

TEST_CASE("what fits to the last byte has room") {
  nodes::RankMemory memory = small_rank;
  memory.network.outbox_bytes = 400;
  CHECK_NOTHROW(check_room(memory, room));
  memory.network.stream_bytes = 1;
  CHECK_THROWS_AS(check_room(memory, room), core::CapacityError);
}

TEST_CASE("what has no room is named: nodes, the host where it is, and what lies between ranks") {
  const AvailableMemory none{10, "this computer's memory"};
  CHECK_THROWS_WITH_AS(check_room(small_rank, none),
                       "this computer has no room for 2 nodes and the host: they take 600 B of memory together, and this "
                       "computer's memory is 10 B; ask for fewer nodes (--nodes) or less memory a node (--node-memory)",
                       core::CapacityError);
  CHECK_THROWS_WITH_AS(check_room({.node_count = 1, .nodes_bytes = 600, .network = {.sent_bytes = 40}}, none),
                       "this computer has no room for 1 node, with what lies between ranks: they take 640 B of memory "
                       "together, and this computer's memory is 10 B; ask for fewer nodes (--nodes) or less memory a node "
                       "(--node-memory)",
                       core::CapacityError);
}

TEST_CASE("network memory is told with what it is for") {
  CHECK(network_text({}) == "0 B of network memory");
  CHECK(network_text({.outbox_bytes = 1, .arrived_bytes = 2}) == "3 B of network memory: outbox 1 B, frames that have come 2 B");
}

}  // namespace dmpc::apps::computer_capacity_test
