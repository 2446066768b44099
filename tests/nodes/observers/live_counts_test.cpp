#include "nodes/observers/live_counts.h"

#include <doctest/doctest.h>

#include <thread>

#include "nodes/program.h"

namespace dmpc::nodes::watch_live_counts_test {

namespace {

std::size_t kind_of(const Span& span) {
  return span.activity == Activity::send ? 4 : span.activity == Activity::take_over ? 5 : 0;
}

}  // namespace

TEST_CASE("what each node has done can be read while it does, and never goes back") {
  LiveCounts counts(3, kind_of);
  IdleProgram program;
  std::jthread node([&] {
    for (std::uint64_t i = 1; i <= 10'000; ++i) {
      counts.sent({.node = NodeId{1}, .peer = NodeId{2}});
      counts.ended({.node = NodeId{1},
                    .activity = i % 2 == 0 ? Activity::work : Activity::send,
                    .end_ns = i,
                    .own_ns = 3,
                    .received_ns = 2},
                   program);
    }
  });
  std::uint64_t last = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t now = counts.read().at(1).now_ns;
    CHECK(now >= last);
    last = now;
  }
  node.join();
  const std::vector<LiveNode> nodes = counts.read();
  REQUIRE(nodes.size() == 3);
  CHECK(nodes[1].now_ns == 10'000);
  CHECK(nodes[1].packets_sent == 10'000);
  CHECK(nodes[1].busy_ns[0] == 15'000);
  CHECK(nodes[1].busy_ns[4] == 15'000);
  CHECK(nodes[1].busy_ns[5] == 20'000);
  CHECK(nodes[0].packets_sent == 0);
}

}  // namespace dmpc::nodes::watch_live_counts_test
