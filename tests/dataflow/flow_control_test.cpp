#include "dataflow/flow_control.h"

#include <doctest/doctest.h>

namespace dmpc::tests::flow_control_test {

using dataflow::NodeState;
using dataflow::Task;
using dataflow::Way;

TEST_CASE("a node sends what waits, goes on, treats received rays, starts its own and flushes, in this order") {
  NodeState state{true, true, true, true, true, true, true, true, true};
  CHECK(next_task(state) == Task::send_waiting);
  state.packet_waits = false;
  CHECK(next_task(state) == Task::go_on);
  state.is_tracing = false;
  CHECK(next_task(state) == Task::take_received);
  state.has_backlog = false;
  CHECK(next_task(state) == Task::start_primary);
  state.admits_primaries = false;
  CHECK(next_task(state) == Task::flush);
  state.can_flush = false;
  CHECK(next_task(state) == Task::rest);
}

TEST_CASE("a node is passive only when it has nothing at all") {
  CHECK(dataflow::is_passive({}));
  CHECK_FALSE(dataflow::is_passive({.packet_waits = true}));
  CHECK_FALSE(dataflow::is_passive({.is_tracing = true}));
  CHECK_FALSE(dataflow::is_passive({.has_backlog = true}));
  CHECK_FALSE(dataflow::is_passive({.has_primaries = true}));
  CHECK_FALSE(dataflow::is_passive({.has_gathered = true}));
}

TEST_CASE("a node rests with rays that wait for a credit, and with primary rays that it holds back") {
  CHECK(dataflow::next_task({.has_primaries = true}) == Task::rest);
  CHECK(dataflow::next_task({.has_gathered = true}) == Task::rest);
}

TEST_CASE("primary rays are held back only while the node's queue is nearly full and the host buffers enough rays") {
  constexpr std::uint64_t enough = dataflow::host_rays_wanted_max;
  CHECK(dataflow::admits_primaries(479, 512, enough));
  CHECK_FALSE(dataflow::admits_primaries(480, 512, enough));
  CHECK_FALSE(dataflow::admits_primaries(512, 512, enough + 1));
  CHECK(dataflow::admits_primaries(512, 512, enough - 1));
  CHECK(dataflow::admits_primaries(0, 1, enough));
  CHECK_FALSE(dataflow::admits_primaries(1, 1, enough));
}

TEST_CASE("without a queue, or without backpressure, nothing is held back") {
  CHECK(dataflow::admits_primaries(0, 0, dataflow::host_rays_wanted_max));
}

TEST_CASE("a packet goes to its owner, else into the queue, else to the host, else waits") {
  CHECK(dataflow::way_of(true, true, true) == Way::to_owner);
  CHECK(dataflow::way_of(true, false, false) == Way::to_owner);
  CHECK(dataflow::way_of(false, true, true) == Way::to_queue);
  CHECK(dataflow::way_of(false, true, false) == Way::to_queue);
  CHECK(dataflow::way_of(false, false, true) == Way::to_host);
  CHECK(dataflow::way_of(false, false, false) == Way::wait);
}

TEST_CASE("a busy node returns credits by the batch, a resting one all of them") {
  CHECK_FALSE(dataflow::returns_credits(0, 1, true));
  CHECK_FALSE(dataflow::returns_credits(1, 2, false));
  CHECK(dataflow::returns_credits(2, 2, false));
  CHECK(dataflow::returns_credits(1, 2, true));
  CHECK(dataflow::return_batch(1) == 1);
  CHECK(dataflow::return_batch(8) == 4);
}

TEST_CASE("the host is passive while it buffers no ray") {
  CHECK(dataflow::host_is_passive(0));
  CHECK_FALSE(dataflow::host_is_passive(1));
}

}  // namespace dmpc::tests::flow_control_test
